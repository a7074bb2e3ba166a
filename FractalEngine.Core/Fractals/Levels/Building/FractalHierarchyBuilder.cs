using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Geometry.Triangles;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>Builds the sub-fractals of a <see cref="FractalHierarchy"/>, from the base mesh upwards.</summary>
/// <remarks>
/// The identity is not a child like the others. Where all levels below have it, the base mesh belongs to the level itself, and a child may
/// skip levels that have it. Each chain of the other maps is then reached by one path, on its earliest levels (docs/colliders.md).
/// </remarks>
internal sealed partial class FractalHierarchyBuilder
{
    /// <summary>Stands for infinitely many rounds: no search descends so many levels.</summary>
    public const long EndlessRounds = 1L << 40;

    // More mean that the bounds grow or shrink too slowly to converge.
    private const int MaxSubFractals = 4000;

    private readonly HierarchyDescription _description;
    private readonly bool _doublesPowers;

    // A set without maps on any level leaves nothing, however often it is repeated.
    private readonly bool _isEmpty;
    private readonly LevelUnion _union;
    private readonly SubFractalFactory _subFractalFactory;
    private readonly Dictionary<TransformationSet, MapSet> _sets = new(ReferenceEqualityComparer.Instance);
    private long _childCount;
    private readonly ChildInstanceBuilder _childBuilder;
    private readonly RecursiveLevels _recursives;
    private int _baseIndex;

    /// <summary>Begins with the base meshes, which have no remaining levels.</summary>
    /// <param name="description">What the hierarchy is built from.</param>
    /// <param name="doublesPowers">
    /// True to double the levels of one map, see <see cref="MapPowers"/>; false for one level for each set, whose path colours need.
    /// </param>
    private FractalHierarchyBuilder(HierarchyDescription description, bool doublesPowers)
    {
        _description = description;
        _doublesPowers = doublesPowers;
        _isEmpty = FractalSteps.CountUpTo(description.Steps, 1).IsZero;
        _recursives = new(description.Recursives);
        _childBuilder = new(_recursives.Period);
        // A search by similarities computes in the units of base meshes.
        HasOnlySimilarities = description.Steps.All(HasOnlySimilarMaps) && _recursives.HaveOnlySimilarities
            && !description.Recursives.Any(static recursive => QueryScale.IsNeeded(QueryScale.Magnitude(recursive.BaseMesh)));
        _union = new(Built, new(description));
        _subFractalFactory = new([.. description.Recursives.Select(static recursive => recursive.BaseMesh)], HasOnlySimilarities);
        for (var i = 0; i < _recursives.Period; i++)
        {
            var volume = _subFractalFactory.BaseVolumes[i];
            Built.Add(volume, new(null, volume.Box, [], static () => [], _subFractalFactory.CreateBase(i)));
        }
    }

    private BuiltLevels Built { get; } = new();

    private bool HasOnlySimilarities { get; }

    private bool HasDoubledPowers { get; set; }

    /// <summary>Builds the hierarchy of recursives and steps.</summary>
    /// <param name="description">The recursives and the steps.</param>
    /// <param name="doublesPowers">False for one level for each set, see <see cref="MapPowers"/>.</param>
    /// <param name="keepsAllLevels">True to keep levels that no search from the whole fractal visits.</param>
    /// <exception cref="FractalLimitException">Bounds overflow a double, or don't converge; the message names the level.</exception>
    public static FractalHierarchy Build(HierarchyDescription description, bool doublesPowers = true, bool keepsAllLevels = false) =>
        new FractalHierarchyBuilder(description, doublesPowers).Build(keepsAllLevels);

    /// <summary>Adds the levels of the recursives, and those of all steps, the innermost first.</summary>
    private FractalHierarchy Build(bool keepsAllLevels)
    {
        RequireAllowedChildren(_description.Steps.Sum(CountWideChildren));
        AddRecursives();
        var recursiveTop = Built.Top;
        _baseIndex = _recursives.BaseIndexAt(recursiveTop);
        foreach (var step in _description.Steps.Reverse())
        {
            AddStep(step);
        }

        var levels = Built.ToTable();
        if (!keepsAllLevels)
        {
            ReachableLevels.RemoveOthers(levels, Built.Top);
        }

        return new(
            [.. _description.Recursives.Select(static recursive => recursive.BaseMesh)], levels, Built.Top, _description.Root, recursiveTop)
        {
            HasOnlySimilarities = HasOnlySimilarities,
            HasDoubledPowers = HasDoubledPowers,
        };
    }

    /// <summary>
    /// Counts the children that the levels of wide sets have at least: too many are refused before a level is built. Two rounds of a
    /// repetition are built in any case.
    /// </summary>
    private long CountWideChildren(FractalStep step) => step switch
    {
        TransformationSet { Maps.Length: > SubFractal.MaxUngroupedChildren } set => set.Maps.Length,
        Repetition repetition when !_doublesPowers || MapPowers.TryCreate(repetition) is null =>
            Math.Min(repetition.Count ?? 2, 2) * repetition.Round.Sum(CountWideChildren),
        _ => 0,
    };

    private static void RequireAllowedChildren(long count)
    {
        if (count > FractalLimits.MaxHierarchyChildren)
        {
            throw new FractalLimitException(
                $"exact search needs more than the limit of {FractalLimits.MaxHierarchyChildren} transformations on all levels together");
        }
    }

    private void AddStep(FractalStep step)
    {
        var repetition = step as Repetition ?? new([step], 1);
        if (_doublesPowers && MapPowers.TryCreate(repetition) is { } powers)
        {
            HasDoubledPowers = true;
            powers.AddLevels(Built.Top, AddLevel);
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
                var bound = CreatePeriodicBound(period, round, ChildInstanceBuilder.MaxExpandedLevels);
                if (TryRepeatRound(bound, level => EdgesOfRepetition(bound, level, levelsBelowRepetition), remainingRounds * period))
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
        RequireAllowedLevel(set.Maps.Length);
        if (!_sets.TryGetValue(set, out var mapSet))
        {
            mapSet = new(set);
            _sets[set] = mapSet;
        }

        var edges = ChildInstanceBuilder.EdgesAt(Built.Top + 1, levelsBelowRepetition, period, mapSet, Built.MapSetAt);
        AddLevel(_childBuilder.Share(edges), mapSet);
    }

    /// <summary>Adds one level with given edges to the chain.</summary>
    private void AddLevel(ChildEdge[] edges, MapSet mapSet)
    {
        var level = Built.Top + 1;
        var volume = _union.Compute(edges, level);
        var children = _childBuilder.ExpandChildren(level, edges, Built.EdgesAt);
        var childVolumes = new BoundingVolume[children.Length];
        for (var i = 0; i < children.Length; i++)
        {
            childVolumes[i] = Built.VolumeAt(children[i].RemainingLevels(level));
        }

        var subFractal = _subFractalFactory.Create(mapSet, children, childVolumes, volume, _baseIndex);
        Built.Add(volume, new(mapSet, volume.Box, edges, EdgeBoxesOf(edges, level, Built.VolumeAt), subFractal));
    }

    /// <summary>Refuses a level on top of those before, if they or their children are too many.</summary>
    private void RequireAllowedLevel(int childCount)
    {
        if (Built.Count > MaxSubFractals)
        {
            throw new FractalLimitException(
                "exact search needs transformations that shrink, or less depth: "
                + $"{Built.Top} levels above the base the fractal's bounds still change");
        }

        _childCount += childCount;
        RequireAllowedChildren(_childCount);
    }

    private PeriodicBound CreatePeriodicBound(int period, long round, int maxRoundsDown, bool arePhasesAlike = true) =>
        new(Built.Top, period, Built.VolumeAt, Built.EdgesAt, Math.Max(1, 0.125 * round), maxRoundsDown, arePhasesAlike);

    /// <summary>The edges of a level of a repetition, built or above the last round.</summary>
    private ChildEdge[] EdgesOfRepetition(PeriodicBound bound, long level, long levelsBelowRepetition) => ChildInstanceBuilder.EdgesAt(
        level,
        levelsBelowRepetition,
        bound.Period,
        Built.MapSetAt(bound.EquivalentLevel(level)),
        lower => Built.MapSetAt(bound.EquivalentLevel(lower)));

    /// <summary>Replaces all remaining rounds by one that is inflated a little, if it can be proved to contain them.</summary>
    /// <param name="periodicBound">Proves that.</param>
    /// <param name="edgesAt">Gives the edges of levels above the last round.</param>
    /// <param name="levelCount">Number of levels in the remaining rounds.</param>
    private bool TryRepeatRound(PeriodicBound periodicBound, Func<long, ChildEdge[]> edgesAt, long levelCount)
    {
        if (!periodicBound.HasConverged())
        {
            return false;
        }

        // The children must be the same in rounds so far up that theirs lie in rounds like the last one, and in those between.
        ChildInstance[] ChildrenAt(long level) =>
            _childBuilder.ExpandChildren(level, edgesAt(level), lower => Built.EdgesAt(periodicBound.EquivalentLevel(lower)));

        var period = periodicBound.Period;
        var children = Enumerable.Range(0, period).Select(phase => ChildrenAt(periodicBound.InductionLevel + phase)).ToArray();
        for (var level = Built.Top + 1; level < periodicBound.InductionLevel; level++)
        {
            if (!ChildrenAt(level).SequenceEqual(children[periodicBound.PhaseOf(level)]))
            {
                return false;
            }
        }

        if (periodicBound.TryProveInvariant(children) is not { } volumes)
        {
            return false;
        }

        var round = new BuiltLevels.Entry[period];
        for (var phase = 0; phase < period; phase++)
        {
            var level = periodicBound.FirstLevel + phase;
            var parentLevels = periodicBound.InductionLevel + phase;
            BoundingVolume RepeatedVolumeAt(long remainingLevels) => periodicBound.VolumeAt(volumes, remainingLevels);
            var childVolumes = children[phase].Select(child => RepeatedVolumeAt(child.RemainingLevels(parentLevels))).ToArray();
            var set = Built.MapSetAt(level);
            var edges = Built.EdgesAt(level);
            var edgeBoxes = EdgeBoxesOf(edges, parentLevels, RepeatedVolumeAt);
            var subFractal = _subFractalFactory.Create(set, children[phase], childVolumes, volumes[phase], Built.BaseIndexAt(level));
            round[phase] = new(volumes[phase], new(set, volumes[phase].Box, edges, edgeBoxes, subFractal));
        }

        Built.Add(levelCount, round);
        return true;
    }
}
