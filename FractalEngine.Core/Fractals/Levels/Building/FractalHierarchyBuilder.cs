using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Graphs;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>Builds the sub-fractals of a <see cref="FractalHierarchy"/>, from the base meshes upwards.</summary>
/// <remarks>
/// The identity is not a child like the others. Where all levels below have it, the base mesh belongs to the level itself, and a child may
/// skip levels that have it. Each chain of the other maps is then reached by one path, on its earliest levels (docs/colliders.md).
/// </remarks>
/// <param name="graph">What the hierarchy is built from.</param>
/// <param name="doublesPowers">
/// True to double the levels of one map, see <see cref="MapPowers"/>; false for one level for each set, whose path colours need.
/// </param>
/// <param name="knownLimits">
/// <see cref="FractalHierarchy.SizeLimits"/> of the whole that this is a part of, whose meshes decide; null for a whole.
/// </param>
internal sealed class FractalHierarchyBuilder(
    FractalGraph graph, bool doublesPowers, IReadOnlyDictionary<int, ImmutableArray<long>>? knownLimits)
{
    /// <summary>Stands for infinitely many rounds: no search descends so many levels.</summary>
    public const long EndlessRounds = 1L << 40;

    // More are not compared, though a cycle of calls may take as many.
    private const int MaxPeriodInRounds = 16;

    // By parts: the level where each of those built is the whole.
    private readonly List<long> _tops = [.. Enumerable.Range(0, graph.BaseMeshes.Length)];

    private readonly Dictionary<int, ImmutableArray<long>> _sizeLimits = [];

    // By parts: whether places decide what stands there.
    private readonly List<bool> _hasPicks = [.. Enumerable.Repeat(false, graph.BaseMeshes.Length)];
    private readonly Dictionary<TransformationSet, MapSet> _sets = new(ReferenceEqualityComparer.Instance);
    private readonly LevelBuilder _levels = new(graph);
    private readonly Lazy<EndingRounds> _endingRounds = new(() => new(graph));

    // A set without maps on any level leaves nothing, however often it is repeated.
    private bool _isEmpty;

    private BuiltLevels Built => _levels.Built;

    private bool HasDoubledPowers { get; set; }

    /// <summary>Builds the hierarchy of a graph.</summary>
    /// <param name="graph">The graph.</param>
    /// <param name="doublesPowers">False for one level for each set, see <see cref="MapPowers"/>.</param>
    /// <param name="keepsAllLevels">True to keep levels that no search from the whole fractal visits.</param>
    /// <param name="knownLimits">Sizes at which recursives end; null to find them.</param>
    /// <exception cref="FractalLimitException">Bounds overflow a double, or don't converge; the message names the level.</exception>
    public static FractalHierarchy Build(
        FractalGraph graph, bool doublesPowers = true, bool keepsAllLevels = false,
        IReadOnlyDictionary<int, ImmutableArray<long>>? knownLimits = null) =>
        new FractalHierarchyBuilder(graph, doublesPowers, knownLimits).Build(keepsAllLevels);

    /// <summary>Adds the levels of all parts, each on top of those before.</summary>
    private FractalHierarchy Build(bool keepsAllLevels)
    {
        LevelBuilder.RequireAllowedChildren(graph.Parts.OfType<SteppedPart>().Sum(part => part.Steps.Sum(CountWideChildren)));
        foreach (var part in graph.Parts)
        {
            _hasPicks.Add(part is RecursivePart { HasPicks: true } || part.References.Any(index => _hasPicks[index]));
            _levels.BeginPart();
            _tops.Add(part switch
            {
                SteppedPart stepped => AddSteps(stepped.Steps, _tops[stepped.Inner]),
                RecursivePart recursive => AddRecursives(recursive),
                _ => throw new ArgumentException($"{part.GetType().Name} is no part of a fractal"),
            });
        }

        var levels = Built.ToTable();
        if (!keepsAllLevels)
        {
            ReachableLevels.RemoveOthers(levels, _tops[^1]);
        }

        return new([.. graph.BaseMeshes], levels, _tops[^1])
        {
            HasOnlySimilarities = graph.HasOnlySimilarities,
            HasDoubledPowers = HasDoubledPowers,
            HasPicks = _hasPicks[^1],
            SizeLimits = _sizeLimits,
        };
    }

    /// <summary>Adds the levels of steps, the innermost first.</summary>
    /// <param name="steps">The steps.</param>
    /// <param name="inner">The level that they are applied to.</param>
    /// <returns>The level of the whole.</returns>
    private long AddSteps(ImmutableArray<FractalStep> steps, long inner)
    {
        if (FractalSteps.LevelCount(steps) == 0)
        {
            return inner;
        }

        _levels.BeginPart();
        if (inner != Built.Top)
        {
            _levels.Add([new(MapSet.Link, 0, LevelStep.To(inner))], MapSet.Link);
        }

        _isEmpty = FractalSteps.CountUpTo(steps, 1).IsZero;
        foreach (var step in steps.Reverse())
        {
            AddStep(step);
        }

        return Built.Top;
    }

    /// <summary>
    /// Adds what a recursive is that calls nothing but itself, always with as many levels less, and constants. Its chains are those of a
    /// repetition, and what identities make many times is known there.
    /// </summary>
    /// <remarks>With maps M, constants C and base b, n rounds are the union of ({1} ∪ M)ⁿ⁻¹·C and Mⁿ·b.</remarks>
    private long AddLinear(FractalRecursive recursive, int levelsLess, int? levels)
    {
        var constants = recursive.Calls.Where(static call => call.IsConstant).Select(call => (call.Map, _tops[call.Target])).ToArray();
        AffineMap[] maps = [.. recursive.Calls.Where(static call => !call.IsConstant).Select(static call => call.Map)];
        // The base takes the place of a round that is begun.
        var rounds = 1 + ((levels - 1) / levelsLess);
        var ends = AddSteps(Repeated(maps, rounds), _tops[recursive.BasePart]);
        return constants.Length == 0 ? ends : AddUnion(
            (AffineMap.Identity, AddSteps(Repeated([AffineMap.Identity, .. maps], rounds - 1), AddUnion(constants))),
            (AffineMap.Identity, ends));

        static ImmutableArray<FractalStep> Repeated(AffineMap[] maps, int? rounds) =>
            [new Repetition([new TransformationSet(ImmutableArray.Create(maps))], rounds)];
    }

    /// <summary>Adds the union of levels, each under a map.</summary>
    private long AddUnion(params (AffineMap Map, long Level)[] terms)
    {
        MapSet set = new(Array.ConvertAll(terms, static term => term.Map)) { IsOfCalls = true };
        _levels.RequireAllowedLevel(terms.Length);
        _levels.Add([.. terms.Select((term, i) => new ChildEdge(set, i, LevelStep.To(term.Level)))], set);
        return Built.Top;
    }

    /// <summary>
    /// Counts the children that the levels of wide sets have at least: too many are refused before a level is built. Two rounds of a
    /// repetition are built in any case.
    /// </summary>
    private long CountWideChildren(FractalStep step) => step switch
    {
        TransformationSet { Maps.Length: > SubFractal.MaxUngroupedChildren } set => set.Maps.Length,
        Repetition repetition when !doublesPowers || MapPowers.TryCreate(repetition) is null =>
            Math.Min(repetition.Count ?? 2, 2) * repetition.Round.Sum(CountWideChildren),
        _ => 0,
    };

    private void AddStep(FractalStep step)
    {
        var repetition = step as Repetition ?? new([step], 1);
        if (doublesPowers && !_hasPicks[^1] && MapPowers.TryCreate(repetition) is { } powers)
        {
            HasDoubledPowers = true;
            powers.AddLevels(Built.Top, _levels.Add);
            return;
        }

        var hasOnlySets = repetition.Round.All(inner => inner is TransformationSet);
        var levelsBelowRepetition = Built.Top;
        var period = hasOnlySets ? repetition.Round.Length : int.MaxValue;
        // Two rounds are built in any case: children may skip a round of levels, and must meet the same sets there.
        var nextAttempt = 2;
        for (var round = 0; round < (repetition.Count ?? (_isEmpty ? 1 : int.MaxValue)); round++)
        {
            if (hasOnlySets && round >= nextAttempt)
            {
                var remainingRounds = repetition.Count - round ?? EndlessRounds;
                var bound = _levels.CreatePeriodicBound(period, round, ChildInstanceBuilder.MaxExpandedLevels);
                if (_levels.TryRepeatRound(
                    bound, level => EdgesOfRepetition(bound, level, levelsBelowRepetition), remainingRounds * period))
                {
                    return;
                }

                nextAttempt = round + 1 + (round / 8);
            }

            foreach (var inner in repetition.Round.Reverse())
            {
                if (inner is TransformationSet set)
                {
                    AddLevel(levelsBelowRepetition, period, set);
                }
                else
                {
                    AddStep(inner);
                    levelsBelowRepetition = Built.Top;
                }
            }

            levelsBelowRepetition = hasOnlySets ? levelsBelowRepetition : Built.Top;
        }
    }

    /// <summary>Adds one level to the chain.</summary>
    /// <param name="levelsBelowRepetition">Remaining levels below the repetition that the level belongs to.</param>
    /// <param name="period">Number of levels after which the sets of the repetition recur.</param>
    /// <param name="set">The set of the level.</param>
    private void AddLevel(long levelsBelowRepetition, int period, TransformationSet set)
    {
        _levels.RequireAllowedLevel(set.Maps.Length);
        ref var mapSet = ref CollectionsMarshal.GetValueRefOrAddDefault(_sets, set, out _);
        mapSet ??= new(set);
        _levels.Add(EdgesAt(Built.Top + 1, levelsBelowRepetition, period, mapSet, Built.MapSetAt), mapSet);
    }

    /// <summary>The edges of a level of steps, one for each map where places decide what stands below.</summary>
    private ChildEdge[] EdgesAt(long level, long levelsBelowRepetition, int period, MapSet set, Func<long, MapSet> setAt) => _hasPicks[^1]
        ? [.. set.Maps.Select((_, index) => new ChildEdge(set, index, LevelStep.Down(1)))]
        : ChildInstanceBuilder.EdgesAt(level, levelsBelowRepetition, period, set, setAt);

    /// <summary>The edges of a level of a repetition, built or above the last round.</summary>
    private ChildEdge[] EdgesOfRepetition(PeriodicBound bound, long level, long levelsBelowRepetition) => EdgesAt(
        level,
        levelsBelowRepetition,
        bound.Period,
        Built.MapSetAt(bound.EquivalentLevel(level)),
        lower => Built.MapSetAt(bound.EquivalentLevel(lower)));

    /// <summary>
    /// The largest numbers of sizes that recursives have levels at, by the diagonals of their bases; none where size ends none of them.
    /// </summary>
    private ImmutableArray<long> SizeLimitsOf(RecursivePart part)
    {
        if (part.Until is { } until)
        {
            var limits = knownLimits?[_tops.Count] ?? [.. part.Recursives.Select(
                recursive => StretchSize.LimitOf(Built.VolumeAt(_tops[recursive.BasePart]).Box.Diagonal, until))];
            _sizeLimits.Add(_tops.Count, limits);
            return limits;
        }

        return [];
    }

    /// <summary>Adds the levels of recursives in turns, up to that of the root.</summary>
    /// <returns>The level of the whole.</returns>
    private long AddRecursives(RecursivePart part)
    {
        if (part.Levels == 0)
        {
            return _tops[part.Recursives[part.Root].BasePart];
        }

        if (part.LevelsLessOfLinear is { } levelsLess && !_hasPicks[^1])
        {
            return AddLinear(part.Recursives[0], levelsLess, part.Levels);
        }

        var limits = SizeLimitsOf(part);
        if (!limits.IsEmpty
            && _endingRounds.Value.CountOf(_tops.Count, part, limits, LevelBuilder.MaxSubFractals / (2 * limits.Length)) is { } rounds)
        {
            part = (RecursivePart)part.WithMaxDepth(rounds);
        }

        var recursives = RecursiveLevels.Create(part, Built.Top + 1, index => _tops[index], _hasPicks[^1], limits);
        part = recursives.Part;
        var period = recursives.Period;
        var nextAttempt = 0L;
        for (var round = 0L; round < (part.Levels ?? EndlessRounds); round++)
        {
            // The last round ends with the turn of the root.
            var levelCount = ((part.Levels - 1 - round ?? EndlessRounds) * period) + part.Order.IndexOf(part.Root) + 1;
            if (round >= nextAttempt)
            {
                // Recursives that call only each other alternate: they may have faces only as often as a cycle of calls comes round.
                var maxPeriod = Math.Min(period * Math.Max(1, part.MaxLevelsLess), MaxPeriodInRounds);
                for (var count = 1; count <= maxPeriod; count++)
                {
                    // Two periods are compared, and in the last one calls lead down by as many levels as further up.
                    if (round >= Math.Max(2 * count, part.MaxLevelsLess + count) && levelCount >= count * period
                        && _levels.TryRepeatRound(
                            _levels.CreatePeriodicBound(count * period, round, recursives.MaxExpandedRounds, arePhasesAlike: false),
                            recursives.EdgesAt,
                            levelCount))
                    {
                        return recursives.EndAt(Built.Top);
                    }
                }

                nextAttempt = round + 1 + (round / 8);
            }

            for (var turn = 0; turn < Math.Min(levelCount, period); turn++)
            {
                var level = Built.Top + 1;
                var set = recursives.SetAt(level);
                _levels.RequireAllowedLevel(set.Maps.Length);
                _levels.Add(recursives.EdgesAt(level), set);
            }
        }

        return recursives.EndAt(Built.Top);
    }
}
