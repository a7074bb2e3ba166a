using System.Runtime.InteropServices;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>Builds the sub-fractals of a <see cref="SubFractalTable"/>, from the base mesh upwards.</summary>
/// <remarks>
/// The identity is not a copy like the others: where all levels below have it, the base mesh stands at the level itself, and a copy may
/// pass over levels that have it. Each chain of the other maps is then reached in one way, on its earliest levels (docs/colliders.md).
/// </remarks>
internal sealed class SubFractalBuilder
{
    // More mean that the bounds grow or shrink too slowly to settle.
    private const int MaxSubFractals = 4000;

    // A hull that fills its box bounds no better than the box.
    private const double MaxHullFillRatio = 0.95;

    private readonly Fractal _fractal;
    private readonly Dictionary<TransformationSet, MapSet> _sets = new(ReferenceEqualityComparer.Instance);
    private readonly List<SubFractal> _subFractals = [];
    private readonly List<BoundingVolume> _volumes = [];
    private readonly List<ChildEdge[]> _edges = [];
    private readonly ChildInstanceBuilder _childBuilder = new();
    private readonly List<LevelRegion> _regions = [];

    public SubFractalBuilder(Fractal fractal)
    {
        _fractal = fractal;
        HasOnlySimilarities = fractal.Description.Steps.All(HasOnlySimilarMaps);
        var volume = BoundingVolume.Of(fractal.BaseMesh);
        Append(1, new BuiltLevel(new(null, [], [], volume, volume.Box, CreateHullBound(volume), null), volume, []));
    }

    public IReadOnlyList<SubFractal> SubFractals => _subFractals;

    public IReadOnlyList<LevelRegion> Regions => _regions;

    /// <summary>True when all maps are multiples of rotations and mirrors.</summary>
    public bool HasOnlySimilarities { get; }

    /// <summary>Of what has been added.</summary>
    public long Levels { get; private set; } = -1;

    /// <summary>Adds the levels of all steps, the innermost first.</summary>
    public void AddAllSteps()
    {
        foreach (var step in _fractal.Description.Steps.Reverse())
        {
            AddStep(step);
        }
    }

    private static bool HasOnlySimilarMaps(FractalStep step) => step switch
    {
        Repetition repetition => repetition.Body.All(HasOnlySimilarMaps),
        TransformationSet set => set.Maps.All(map => Similarity.IsSimilarity(map.Linear)),
        _ => throw new ArgumentException($"{step.GetType().Name} is no step of a fractal", nameof(step)),
    };

    private int FindIndex(long levels) => LevelRegion.FindIndex(CollectionsMarshal.AsSpan(_regions), levels);

    private SubFractal At(long levels) => _subFractals[FindIndex(levels)];

    /// <summary>What holds the sub-fractal with so many levels left.</summary>
    public BoundingVolume VolumeAt(long levels) => _volumes[FindIndex(levels)];

    /// <summary>The steps by which it is made of sub-fractals further down, see <see cref="ChildInstanceBuilder.EdgesAt"/>.</summary>
    public ChildEdge[] EdgesAt(long levels) => _edges[FindIndex(levels)];

    private void Append(long count, params ReadOnlySpan<BuiltLevel> builtLevels)
    {
        // States that don't repeat are joined to the region before, so that most fractals have one or two.
        if (count == builtLevels.Length && _regions is [.., var last] && last.LevelCount == last.Period)
        {
            _regions[^1] = last with { LevelCount = last.LevelCount + count, Period = last.Period + builtLevels.Length };
        }
        else
        {
            _regions.Add(new(Levels + 1, count, _subFractals.Count, builtLevels.Length));
        }

        foreach (var (subFractal, volume, edges) in builtLevels)
        {
            _subFractals.Add(subFractal);
            _volumes.Add(volume);
            _edges.Add(edges);
        }

        Levels += count;
    }

    private void AddStep(FractalStep step)
    {
        var repetition = step as Repetition ?? new([step], 1);
        var hasOnlySets = repetition.Body.All(inner => inner is TransformationSet);
        var levelsBelowRepetition = Levels;
        var period = hasOnlySets ? repetition.Body.Length : int.MaxValue;
        // Two rounds are written out in any case: copies may pass over a round of levels, and must meet the same sets there.
        var nextAttempt = 2;
        for (var round = 0; round < (repetition.Count ?? int.MaxValue); round++)
        {
            if (hasOnlySets && round >= nextAttempt)
            {
                if (TryRepeatRound(levelsBelowRepetition, repetition.Body.Length, (repetition.Count - round) * repetition.LevelsPerRound,
                    Math.Max(1, 0.125 * round)))
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
                    levelsBelowRepetition = Levels;
                }
            }

            levelsBelowRepetition = hasOnlySets ? levelsBelowRepetition : Levels;
        }
    }

    /// <param name="levelsBelowRepetition">The levels below the repetition that the level belongs to.</param>
    /// <param name="period">After so many levels their sets are the same again.</param>
    /// <param name="set">The level's.</param>
    private void AddLevel(long levelsBelowRepetition, int period, TransformationSet set)
    {
        if (_subFractals.Count > MaxSubFractals)
        {
            throw new FractalLimitException(
                $"exact search needs transformations that shrink, or less depth: {Levels} levels above the base the fractal's bounds still change");
        }

        if (!_sets.TryGetValue(set, out var mapSet))
        {
            _sets[set] = mapSet = new(set);
        }

        var level = Levels + 1;
        var edges = ChildInstanceBuilder.EdgesAt(level, levelsBelowRepetition, period, mapSet, below => At(below).Set!);
        var collapsedEdges = edges.Select(edge => CollapsedEdge.Collapse(edge, level, EdgesAt))
            .Where(collapsedEdge => !VolumeAt(collapsedEdge.RemainingLevels).Box.IsEmpty).ToArray();
        if (collapsedEdges.Any(
            collapsedEdge => !(VolumeAt(collapsedEdge.RemainingLevels)
            .TransformedBox(collapsedEdge.Map, collapsedEdge.OperatorNormBound) is var box && box.Minimum.IsFinite()
            && box.Size.IsFinite())))
        {
            throw new FractalLimitException($"the bounds of the fractal are beyond the range of a double {level} levels above its base");
        }

        var volume = VolumeOf(collapsedEdges);
        var children = _childBuilder.ExpandChildren(level, edges, EdgesAt);
        Append(1,
            new BuiltLevel(CreateSubFractal(mapSet, children, children.Select(child => VolumeAt(child.RemainingLevels(level))), volume),
            volume, edges));
    }

    /// <summary>Lets one round, widened a little, stand for all rounds that are left, if it can be shown to hold them.</summary>
    /// <param name="levelsBelowRepetition">The levels below the repetition.</param>
    /// <param name="period">Levels of a round.</param>
    /// <param name="remainingLevels">How many levels are left; null for infinitely many.</param>
    /// <param name="toleranceFactor">See <see cref="PeriodicBound"/>.</param>
    private bool TryRepeatRound(long levelsBelowRepetition, int period, long? remainingLevels, double toleranceFactor)
    {
        var periodicBound = new PeriodicBound(Levels, period, VolumeAt, EdgesAt, toleranceFactor);
        if (!periodicBound.HasConverged())
        {
            return false;
        }

        // In rounds so far up that their copies are of levels in rounds like the last one, and in those between, the copies must be the
        // same.
        ChildInstance[] ChildrenAt(long level) => _childBuilder.ExpandChildren(
            level,
            ChildInstanceBuilder.EdgesAt(level, levelsBelowRepetition, period, At(periodicBound.EquivalentLevel(level)).Set!,
            below => At(periodicBound.EquivalentLevel(below)).Set!),
            below => EdgesAt(periodicBound.EquivalentLevel(below)));
        var children = Enumerable.Range(0, period).Select(i => ChildrenAt(periodicBound.InductionLevel + i)).ToArray();
        for (var level = Levels + 1; level < periodicBound.InductionLevel; level++)
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

        // No search goes down 10¹² levels.
        Append(remainingLevels ?? (period << 20) * (1L << 20), [.. volumes.Select((volume, i) => new BuiltLevel(
            CreateSubFractal(At(periodicBound.FirstLevel + i).Set!, children[i],
            children[i].Select(child => periodicBound.VolumeAt(volumes, child.RemainingLevels(periodicBound.InductionLevel + i))), volume),
            volume,
            EdgesAt(periodicBound.FirstLevel + i)))]);
        return true;
    }

    /// <summary>The outline of some parts, none of them empty.</summary>
    private BoundingVolume VolumeOf(CollapsedEdge[] collapsedEdges)
    {
        if (collapsedEdges is [] or [_])
        {
            return collapsedEdges is [var only]
                ? BoundingVolume.Create(VolumeAt(only.RemainingLevels), only.Map, only.OperatorNormBound)
                : BoundingVolume.Empty;
        }

        var volumes = collapsedEdges.Select(collapsedEdge => VolumeAt(collapsedEdge.RemainingLevels)).ToArray();
        var box =
            collapsedEdges.Zip(volumes,
            (collapsedEdge, volume) => volume.TransformedBox(collapsedEdge.Map, collapsedEdge.OperatorNormBound))
            .Aggregate(BoundingBox.Union);
        var vertices = volumes.All(volume => volume.Hull is not null)
            ? collapsedEdges.Zip(volumes).SelectMany(pair => pair.Second.Hull!.Vertices.Select(vertex => pair.First.Map * vertex)).ToArray()
            : null;
        return BoundingVolume.Create(box, vertices,
            collapsedEdges.Zip(volumes, (collapsedEdge, volume) => collapsedEdge.OperatorNormBound * volume.Margin).Max());
    }

    private SubFractal CreateSubFractal(MapSet set, ChildInstance[] children, IEnumerable<BoundingVolume> volumes, BoundingVolume volume)
    {
        BoundingVolume[] childVolumes = [.. volumes];
        var boxes = children.Zip(childVolumes, (child, childVolume) => childVolume.TransformedBox(child.Map, child.OperatorNormBound))
            .ToArray();
        return new(set, children, boxes, volume, _volumes[0].Box, CreateHullBound(volume), childVolumes.Length > 0
            ? CreateHullBound(childVolumes[0])
            : null);
    }

    private HullBound? CreateHullBound(BoundingVolume volume)
    {
        var (x, y, z) = volume.Box.Size;
        return volume.Hull is null || volume.Hull.Volume() > MaxHullFillRatio * x * y * z
            ? null
            : new(volume.Hull, volume.Box, volume.Margin, includeAxisPlanes: !HasOnlySimilarities);
    }

    private readonly record struct BuiltLevel(SubFractal SubFractal, BoundingVolume Volume, ChildEdge[] Edges);
}
