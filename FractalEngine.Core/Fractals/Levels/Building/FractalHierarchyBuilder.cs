using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>Builds the sub-fractals of a <see cref="FractalHierarchy"/>, from the base mesh upwards.</summary>
/// <remarks>
/// The identity is not a child like the others. Where all levels below have it, the base mesh belongs to the level itself, and a child may
/// skip levels that have it. Each chain of the other maps is then reached by one path, on its earliest levels (docs/colliders.md).
/// </remarks>
/// <param name="description">What the hierarchy is built from.</param>
/// <param name="doublesPowers">
/// True to double the levels of one map, see <see cref="MapPowers"/>; false for one level for each set, whose path colours need.
/// </param>
internal sealed class FractalHierarchyBuilder(HierarchyDescription description, bool doublesPowers)
{
    /// <summary>Stands for infinitely many rounds: no search descends so many levels.</summary>
    public const long EndlessRounds = 1L << 40;

    // More are not compared, though a cycle of calls may take as many.
    private const int MaxPeriodInRounds = 16;

    // A set without maps on any level leaves nothing, however often it is repeated.
    private readonly bool _isEmpty = FractalSteps.CountUpTo(description.Steps, 1).IsZero;
    private readonly Dictionary<TransformationSet, MapSet> _sets = new(ReferenceEqualityComparer.Instance);
    private readonly RecursiveLevels _recursives = new(description.Recursives);
    private readonly LevelBuilder _levels = new(description);

    private BuiltLevels Built => _levels.Built;

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
        LevelBuilder.RequireAllowedChildren(description.Steps.Sum(CountWideChildren));
        AddRecursives();
        var baseIndex = _recursives.BaseIndexAt(Built.Top);
        foreach (var step in description.Steps.Reverse())
        {
            AddStep(step, baseIndex);
        }

        var levels = Built.ToTable();
        if (!keepsAllLevels)
        {
            ReachableLevels.RemoveOthers(levels, Built.Top);
        }

        return new(_levels.BaseMeshes, levels, Built.Top)
        {
            HasOnlySimilarities = description.HasOnlySimilarities,
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
        Repetition repetition when !doublesPowers || MapPowers.TryCreate(repetition) is null =>
            Math.Min(repetition.Count ?? 2, 2) * repetition.Round.Sum(CountWideChildren),
        _ => 0,
    };

    private void AddStep(FractalStep step, int baseIndex)
    {
        var repetition = step as Repetition ?? new([step], 1);
        if (doublesPowers && MapPowers.TryCreate(repetition) is { } powers)
        {
            HasDoubledPowers = true;
            powers.AddLevels(Built.Top, (edges, set) => _levels.Add(edges, set, baseIndex));
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
                    AddLevel(levelsBelowRepetition, period, set, baseIndex);
                }
                else
                {
                    AddStep(inner, baseIndex);
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
    /// <param name="baseIndex">Index of the base mesh.</param>
    private void AddLevel(long levelsBelowRepetition, int period, TransformationSet set, int baseIndex)
    {
        _levels.RequireAllowedLevel(set.Maps.Length);
        if (!_sets.TryGetValue(set, out var mapSet))
        {
            mapSet = new(set);
            _sets[set] = mapSet;
        }

        var edges = ChildInstanceBuilder.EdgesAt(Built.Top + 1, levelsBelowRepetition, period, mapSet, Built.MapSetAt);
        _levels.Add(edges, mapSet, baseIndex);
    }

    /// <summary>The edges of a level of a repetition, built or above the last round.</summary>
    private ChildEdge[] EdgesOfRepetition(PeriodicBound bound, long level, long levelsBelowRepetition) => ChildInstanceBuilder.EdgesAt(
        level,
        levelsBelowRepetition,
        bound.Period,
        Built.MapSetAt(bound.EquivalentLevel(level)),
        lower => Built.MapSetAt(bound.EquivalentLevel(lower)));

    /// <summary>Adds the levels of the recursives in turns, up to that of the one that the steps are applied to.</summary>
    private void AddRecursives()
    {
        var period = _recursives.Period;
        var nextAttempt = 0L;
        for (var round = 0L; round < (description.Levels ?? EndlessRounds); round++)
        {
            // The last round ends with the turn of the root.
            var levelCount = ((description.Levels - 1 - round ?? EndlessRounds) * period) + description.Root + 1;
            if (round >= nextAttempt)
            {
                // Recursives that call only each other alternate: they may have faces only as often as a cycle of calls comes round.
                var maxPeriod = Math.Min(period * Math.Max(1, _recursives.MaxRoundsDown), MaxPeriodInRounds);
                for (var rounds = 1; rounds <= maxPeriod; rounds++)
                {
                    if (TryRepeatRounds(rounds, round, levelCount))
                    {
                        return;
                    }
                }

                nextAttempt = round + 1 + (round / 8);
            }

            for (var turn = 0; turn < Math.Min(levelCount, period); turn++)
            {
                var level = Built.Top + 1;
                var set = _recursives.SetAt(level);
                _levels.RequireAllowedLevel(set.Maps.Length);
                _levels.Add(_recursives.EdgesAt(level), set, _recursives.BaseIndexAt(level));
            }
        }
    }

    /// <summary>Replaces all remaining levels of the recursives by rounds that are inflated a little, if that can be proved.</summary>
    /// <param name="rounds">After so many rounds the bounds recur.</param>
    /// <param name="builtRounds">Number of rounds that were built.</param>
    /// <param name="levelCount">Number of the remaining levels.</param>
    private bool TryRepeatRounds(int rounds, long builtRounds, long levelCount)
    {
        var period = rounds * _recursives.Period;
        // Two periods are compared, and in the last one calls lead down by as many levels as further up.
        return builtRounds >= Math.Max(2 * rounds, _recursives.MaxRoundsDown + rounds) && levelCount >= period
            && _levels.TryRepeatRound(
                _levels.CreatePeriodicBound(period, builtRounds, _recursives.MaxExpandedRounds, arePhasesAlike: false),
                _recursives.EdgesAt,
                levelCount);
    }
}
