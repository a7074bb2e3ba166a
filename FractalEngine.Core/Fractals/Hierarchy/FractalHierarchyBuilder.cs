using FractalEngine.Core.Collision;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Hierarchy;

/// <summary>Builds the sub-fractals of a <see cref="FractalHierarchy"/>, from the base mesh upwards.</summary>
/// <remarks>
/// The identity is not a child like the others. Where all levels below have it, the base mesh belongs to the level itself, and a child may
/// skip levels that have it. Each chain of the other maps is then reached by one path, on its earliest levels (docs/colliders.md).
/// </remarks>
internal sealed class FractalHierarchyBuilder
{
    /// <summary>Stands for infinitely many rounds: no search descends so many levels.</summary>
    public const long EndlessRounds = 1L << 40;

    // More mean that the bounds grow or shrink too slowly to converge.
    private const int MaxSubFractals = 4000;

    private readonly Fractal _fractal;
    private readonly bool _doublesPowers;

    // A set without maps on any level leaves nothing, however often it is repeated.
    private readonly bool _isEmpty;
    private readonly LevelUnion _union;
    private readonly SubFractalFactory _subFractalFactory;
    private readonly Dictionary<TransformationSet, MapSet> _sets = new(ReferenceEqualityComparer.Instance);
    private long _childCount;
    private readonly ChildInstanceBuilder _childBuilder = new();

    /// <summary>Begins with the base mesh, which has no remaining levels.</summary>
    /// <param name="fractal">Fractal in affine composition.</param>
    /// <param name="doublesPowers">
    /// True to double the levels of one map, see <see cref="MapPowers"/>; false for one level for each set, whose path colours need.
    /// </param>
    public FractalHierarchyBuilder(Fractal fractal, bool doublesPowers)
    {
        _fractal = fractal;
        _doublesPowers = doublesPowers;
        _isEmpty = FractalSteps.CountUpTo(fractal.Description.Steps, 1).IsZero;
        HasOnlySimilarities = fractal.Description.Steps.All(HasOnlySimilarMaps);
        _union = new(Built, new(fractal));
        _subFractalFactory = new(fractal.BaseMesh, HasOnlySimilarities);
        var volume = _subFractalFactory.BaseVolume;
        Built.Add(_subFractalFactory.CreateBase(), volume, new(null, volume.Box, [], static () => []));
    }

    /// <summary>The levels that were built.</summary>
    public BuiltLevels Built { get; } = new();

    /// <summary>True when all maps are similarities.</summary>
    public bool HasOnlySimilarities { get; }

    /// <summary>True when levels stand for doubled powers of one map.</summary>
    public bool HasDoubledPowers { get; private set; }

    /// <summary>Adds the levels of all steps, the innermost first.</summary>
    /// <exception cref="FractalLimitException">Bounds overflow a double, or don't converge; the message names the level.</exception>
    public void AddAllSteps()
    {
        RequireAllowedChildren(_fractal.Description.Steps.Sum(CountWideChildren));
        foreach (var step in _fractal.Description.Steps.Reverse())
        {
            AddStep(step);
        }
    }

    private static bool HasOnlySimilarMaps(FractalStep step) => step switch
    {
        Repetition repetition => repetition.Body.All(HasOnlySimilarMaps),
        TransformationSet set => HasOnlySimilarMaps(set.Maps.AsSpan()),
        _ => throw new ArgumentException($"{step.GetType().Name} is no step of a fractal", nameof(step)),
    };

    private static bool HasOnlySimilarMaps(ReadOnlySpan<AffineMap> maps)
    {
        foreach (ref readonly var map in maps)
        {
            if (!Similarity.IsSimilarity(map.Linear))
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>
    /// Counts the children that the levels of wide sets have at least: too many are refused before a level is built. Two rounds of a
    /// repetition are built in any case.
    /// </summary>
    private long CountWideChildren(FractalStep step) => step switch
    {
        TransformationSet { Maps.Length: > ChildGroups.MaxUngroupedChildren } set => set.Maps.Length,
        Repetition repetition when !_doublesPowers || MapPowers.TryCreate(repetition) is null =>
            Math.Min(repetition.Count ?? 2, 2) * repetition.Body.Sum(CountWideChildren),
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

        var hasOnlySets = repetition.Body.All(inner => inner is TransformationSet);
        var levelsBelowRepetition = Built.Top;
        var period = hasOnlySets ? repetition.Body.Length : int.MaxValue;
        // Two rounds are built in any case: children may skip a round of levels, and must meet the same sets there.
        var nextAttempt = 2;
        for (var round = 0; round < (repetition.Count ?? (_isEmpty ? 1 : int.MaxValue)); round++)
        {
            if (hasOnlySets && round >= nextAttempt)
            {
                var remainingRounds = repetition.Count - round ?? EndlessRounds;
                if (TryRepeatRound(levelsBelowRepetition, period, remainingRounds * period, Math.Max(1, 0.125 * round)))
                {
                    return;
                }

                nextAttempt = round + 1 + (round / 8);
            }

            foreach (var inner in repetition.Body.Reverse())
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
        if (Built.Levels.Count > MaxSubFractals)
        {
            throw new FractalLimitException(
                "exact search needs transformations that shrink, or less depth: "
                + $"{Built.Top} levels above the base the fractal's bounds still change");
        }

        _childCount += set.Maps.Length;
        RequireAllowedChildren(_childCount);
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

        var subFractal = _subFractalFactory.Create(mapSet, children, childVolumes, volume);
        Built.Add(subFractal, volume, new(mapSet, volume.Box, edges, EdgeBoxesOf(edges, level, Built.VolumeAt)));
    }

    /// <summary>Replaces all remaining rounds by one that is inflated a little, if it can be proved to contain them.</summary>
    /// <param name="levelsBelowRepetition">Remaining levels below the repetition.</param>
    /// <param name="period">Number of levels in a round.</param>
    /// <param name="levelCount">Number of levels in the remaining rounds.</param>
    /// <param name="toleranceFactor">See <see cref="PeriodicBound"/>.</param>
    private bool TryRepeatRound(long levelsBelowRepetition, int period, long levelCount, double toleranceFactor)
    {
        var periodicBound = new PeriodicBound(Built.Top, period, Built.VolumeAt, Built.EdgesAt, toleranceFactor);
        if (!periodicBound.HasConverged())
        {
            return false;
        }

        // The children must be the same in rounds so far up that theirs lie in rounds like the last one, and in those between.
        ChildInstance[] ChildrenAt(long level)
        {
            var edges = ChildInstanceBuilder.EdgesAt(
                level,
                levelsBelowRepetition,
                period,
                Built.MapSetAt(periodicBound.EquivalentLevel(level)),
                lower => Built.MapSetAt(periodicBound.EquivalentLevel(lower)));
            return _childBuilder.ExpandChildren(level, edges, lower => Built.EdgesAt(periodicBound.EquivalentLevel(lower)));
        }

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
            round[phase] = new(
                _subFractalFactory.Create(set, children[phase], childVolumes, volumes[phase]),
                volumes[phase],
                new(set, volumes[phase].Box, edges, edgeBoxes));
        }

        Built.Add(levelCount, round);
        return true;
    }

    /// <summary>
    /// Makes the boxes of edges. Those of wide levels are computed at their use: they take much memory, and only drawing needs them.
    /// </summary>
    private static Func<BoundingBox[]> EdgeBoxesOf(ChildEdge[] edges, long level, Func<long, BoundingVolume> volumeAt)
    {
        if (edges.Length > ChildGroups.MaxUngroupedChildren)
        {
            return () => ComputeEdgeBoxes(edges, level, volumeAt);
        }

        var boxes = ComputeEdgeBoxes(edges, level, volumeAt);
        return () => boxes;
    }

    private static BoundingBox[] ComputeEdgeBoxes(ChildEdge[] edges, long level, Func<long, BoundingVolume> volumeAt)
    {
        var boxes = new BoundingBox[edges.Length];
        for (var i = 0; i < boxes.Length; i++)
        {
            var volume = volumeAt(edges[i].RemainingLevels(level));
            boxes[i] = volume.Box.IsEmpty ? BoundingBox.Empty : volume.TransformedBox(edges[i].Map, edges[i].OperatorNormBound);
        }

        return boxes;
    }
}
