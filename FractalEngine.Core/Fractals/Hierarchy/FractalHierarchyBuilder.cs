using System.Runtime.InteropServices;
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
    // More mean that the bounds grow or shrink too slowly to converge.
    private const int MaxSubFractals = 4000;

    // A hull that fills its box bounds no better than the box.
    private const double MaxHullFillRatio = 0.95;

    // Stands for infinitely many rounds: no search descends so many levels.
    private const long EndlessRounds = 1L << 40;

    // A map whose translation or scale is so many times the median of its set throws instances far away from the others.
    private const double OutlierFactor = 30;

    private readonly Fractal _fractal;
    private readonly bool _hasOutliers;
    private readonly bool _doublesPowers;
    private readonly Dictionary<TransformationSet, MapSet> _sets = new(ReferenceEqualityComparer.Instance);
    private readonly List<SubFractal> _subFractals = [];
    private readonly List<BoundingVolume> _volumes = [];
    private readonly List<ChildEdge[]> _edges = [];
    private readonly ChildInstanceBuilder _childBuilder = new();
    private readonly List<LevelRegion> _regions = [];

    /// <summary>Begins with the base mesh, which has no remaining levels.</summary>
    /// <param name="fractal">Fractal in affine composition.</param>
    /// <param name="doublesPowers">
    /// True to double the levels of one map, see <see cref="MapPowers"/>; false for one level for each set, whose path colours need.
    /// </param>
    public FractalHierarchyBuilder(Fractal fractal, bool doublesPowers)
    {
        _fractal = fractal;
        _doublesPowers = doublesPowers;
        HasOnlySimilarities = fractal.Description.Steps.All(HasOnlySimilarMaps);
        _hasOutliers = fractal.Description.Steps.Any(step => HasOutliers(step, fractal.BaseMesh.Bounds.Diagonal));
        var volume = BoundingVolume.FromMesh(fractal.BaseMesh);
        var baseSubFractal = new SubFractal(null, [], [], volume.Box, volume.Box, CreateHullBound(volume), null, CreateSolid(volume), null);
        AppendLevels(1, new BuiltLevel(baseSubFractal, volume, []));
    }

    /// <summary>The sub-fractals that were built, in the order of <see cref="Regions"/>.</summary>
    public IReadOnlyList<SubFractal> SubFractals => _subFractals;

    /// <summary>The runs of levels that were built, the lowest first.</summary>
    public IReadOnlyList<LevelRegion> Regions => _regions;

    /// <summary>True when all maps are similarities.</summary>
    public bool HasOnlySimilarities { get; }

    /// <summary>Number of levels that were built.</summary>
    public long Levels { get; private set; } = -1;

    /// <summary>Adds the levels of all steps, the innermost first.</summary>
    /// <exception cref="FractalLimitException">Bounds overflow a double, or don't converge; the message names the level.</exception>
    public void AddAllSteps()
    {
        foreach (var step in _fractal.Description.Steps.Reverse())
        {
            AddStep(step);
        }
    }

    /// <summary>The bounds of the sub-fractal with a number of remaining levels.</summary>
    public BoundingVolume VolumeAt(long remainingLevels) => _volumes[FindIndex(remainingLevels)];

    /// <summary>
    /// The edges of the sub-fractal with a number of remaining levels, see <see cref="ChildInstanceBuilder.EdgesAt"/>.
    /// </summary>
    public ChildEdge[] EdgesAt(long remainingLevels) => _edges[FindIndex(remainingLevels)];

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

    private static bool HasOutliers(FractalStep step, double baseDiagonal)
    {
        if (step is Repetition repetition)
        {
            return repetition.Body.Any(inner => HasOutliers(inner, baseDiagonal));
        }

        var maps = ((TransformationSet)step).Maps;
        if (maps.Length < 2)
        {
            return false;
        }

        var reaches = new double[maps.Length];
        for (var i = 0; i < maps.Length; i++)
        {
            reaches[i] = MapReach(maps[i], baseDiagonal);
        }

        Array.Sort(reaches);
        return reaches[^1] > OutlierFactor * reaches[(maps.Length - 1) / 2];
    }

    private static double MapReach(AffineMap map, double baseDiagonal) =>
        map.Translation.MaxAbsComponent() + (map.Linear.MaxAbsEntry() * baseDiagonal);

    private int FindIndex(long remainingLevels) => LevelRegion.FindIndex(CollectionsMarshal.AsSpan(_regions), remainingLevels);

    private MapSet MapSetAt(long remainingLevels) => _subFractals[FindIndex(remainingLevels)].Set!;

    /// <summary>Appends a run of levels that recur with the period of those given.</summary>
    private void AppendLevels(long count, params ReadOnlySpan<BuiltLevel> builtLevels)
    {
        // Levels that don't recur join the run before, so that most fractals have one or two runs.
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
        if (_doublesPowers && MapPowers.TryCreate(repetition) is { } powers)
        {
            powers.AddLevels(Levels, AddLevel);
            return;
        }

        var hasOnlySets = repetition.Body.All(inner => inner is TransformationSet);
        var levelsBelowRepetition = Levels;
        var period = hasOnlySets ? repetition.Body.Length : int.MaxValue;
        // Two rounds are built in any case: children may skip a round of levels, and must meet the same sets there.
        var nextAttempt = 2;
        for (var round = 0; round < (repetition.Count ?? int.MaxValue); round++)
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
                    levelsBelowRepetition = Levels;
                }
            }

            levelsBelowRepetition = hasOnlySets ? levelsBelowRepetition : Levels;
        }
    }

    /// <summary>Adds one level to the chain.</summary>
    /// <param name="levelsBelowRepetition">Remaining levels below the repetition that the level belongs to.</param>
    /// <param name="period">Number of levels after which the sets of the repetition recur.</param>
    /// <param name="set">The set of the level.</param>
    private void AddLevel(long levelsBelowRepetition, int period, TransformationSet set)
    {
        if (_subFractals.Count > MaxSubFractals)
        {
            throw new FractalLimitException(
                "exact search needs transformations that shrink, or less depth: "
                + $"{Levels} levels above the base the fractal's bounds still change");
        }

        if (!_sets.TryGetValue(set, out var mapSet))
        {
            mapSet = new(set);
            _sets[set] = mapSet;
        }

        AddLevel(ChildInstanceBuilder.EdgesAt(Levels + 1, levelsBelowRepetition, period, mapSet, MapSetAt), mapSet);
    }

    /// <summary>Adds one level with given edges to the chain.</summary>
    private void AddLevel(ChildEdge[] edges, MapSet mapSet)
    {
        var level = Levels + 1;
        var collapsedEdges = new List<CollapsedEdge>(edges.Length);
        foreach (var edge in edges)
        {
            var collapsed = CollapsedEdge.Collapse(edge, level, EdgesAt);
            if (!VolumeAt(collapsed.RemainingLevels).Box.IsEmpty)
            {
                collapsedEdges.Add(collapsed);
            }
        }

        var volume = ComputeUnion(collapsedEdges.ToArray(), level);
        var children = _childBuilder.ExpandChildren(level, edges, EdgesAt);
        var childVolumes = new BoundingVolume[children.Length];
        for (var i = 0; i < children.Length; i++)
        {
            childVolumes[i] = VolumeAt(children[i].RemainingLevels(level));
        }

        AppendLevels(1, new BuiltLevel(CreateSubFractal(mapSet, children, childVolumes, volume), volume, edges));
    }

    /// <summary>Replaces all remaining rounds by one that is inflated a little, if it can be proved to contain them.</summary>
    /// <param name="levelsBelowRepetition">Remaining levels below the repetition.</param>
    /// <param name="period">Number of levels in a round.</param>
    /// <param name="levelCount">Number of levels in the remaining rounds.</param>
    /// <param name="toleranceFactor">See <see cref="PeriodicBound"/>.</param>
    private bool TryRepeatRound(long levelsBelowRepetition, int period, long levelCount, double toleranceFactor)
    {
        var periodicBound = new PeriodicBound(Levels, period, VolumeAt, EdgesAt, toleranceFactor);
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
                MapSetAt(periodicBound.EquivalentLevel(level)),
                lower => MapSetAt(periodicBound.EquivalentLevel(lower)));
            return _childBuilder.ExpandChildren(level, edges, lower => EdgesAt(periodicBound.EquivalentLevel(lower)));
        }

        var children = Enumerable.Range(0, period).Select(phase => ChildrenAt(periodicBound.InductionLevel + phase)).ToArray();
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

        var builtLevels = new BuiltLevel[period];
        for (var phase = 0; phase < period; phase++)
        {
            var level = periodicBound.FirstLevel + phase;
            var parentLevels = periodicBound.InductionLevel + phase;
            var childVolumes = children[phase].Select(child => periodicBound.VolumeAt(volumes, child.RemainingLevels(parentLevels)));
            var subFractal = CreateSubFractal(MapSetAt(level), children[phase], childVolumes.ToArray(), volumes[phase]);
            builtLevels[phase] = new(subFractal, volumes[phase], EdgesAt(level));
        }

        AppendLevels(levelCount, builtLevels);
        return true;
    }

    /// <summary>Computes the bounds of the union of some parts, none of them empty.</summary>
    /// <param name="edges">The parts.</param>
    /// <param name="level">Remaining levels of the union.</param>
    private BoundingVolume ComputeUnion(CollapsedEdge[] edges, long level)
    {
        if (edges is [])
        {
            return BoundingVolume.Empty;
        }

        var box = BoundingBox.Empty;
        foreach (var edge in edges)
        {
            var part = VolumeAt(edge.RemainingLevels).TransformedBox(edge.Map, edge.OperatorNormBound);
            if (!part.Minimum.IsFinite() || !part.Size.IsFinite())
            {
                throw new FractalLimitException(
                    $"the bounds of the fractal are beyond the range of a double {level} levels above its base");
            }

            box = BoundingBox.Union(box, part);
        }

        var clusters = ComputeClusters(edges);
        if (edges is [var only])
        {
            return VolumeAt(only.RemainingLevels).Transform(only.Map, only.OperatorNormBound) with { Clusters = clusters };
        }

        var hasHulls = true;
        var vertexCount = 0;
        var margin = 0.0;
        foreach (var edge in edges)
        {
            var volume = VolumeAt(edge.RemainingLevels);
            hasHulls &= volume.Hull is not null;
            vertexCount += volume.Hull?.Vertices.Length ?? 0;
            margin = Math.Max(margin, edge.OperatorNormBound * volume.Margin);
        }

        if (!hasHulls)
        {
            return BoundingVolume.FromVertices(box, null, margin) with { Clusters = clusters };
        }

        var vertices = new Vector[vertexCount];
        var next = 0;
        foreach (var edge in edges)
        {
            foreach (var vertex in VolumeAt(edge.RemainingLevels).Hull!.Vertices)
            {
                vertices[next++] = edge.Map * vertex;
            }
        }

        return BoundingVolume.FromVertices(box, vertices, margin) with { Clusters = clusters };
    }

    /// <summary>Computes the clusters of the union of some parts: the bulk, then what outliers throw away, the farthest first.</summary>
    /// <remarks>
    /// Outliers of the parts surround the parts in the same arrangement, so those of one rank form one cluster. The nearest join the bulk
    /// when there are too many.
    /// </remarks>
    private BoundingBox[] ComputeClusters(CollapsedEdge[] edges)
    {
        if (!_hasOutliers || edges is [])
        {
            return [];
        }

        var reaches = edges.Select(edge => MapReach(edge.Map, _volumes[0].Box.Diagonal)).ToArray();
        var maxReach = OutlierFactor * reaches.Order().ElementAt((reaches.Length - 1) / 2);
        List<BoundingBox> clusters = [BoundingBox.Empty];
        clusters.AddRange(edges.Where((_, i) => reaches[i] > maxReach)
            .Select(edge => VolumeAt(edge.RemainingLevels).Box.Transform(edge.Map)));
        var outlierCount = clusters.Count - 1;
        foreach (var edge in edges.Where((_, i) => reaches[i] <= maxReach))
        {
            foreach (var (rank, box) in VolumeAt(edge.RemainingLevels).TransformedClusters(edge.Map).Index())
            {
                var target = rank == 0 ? 0 : rank + outlierCount;
                if (target == clusters.Count)
                {
                    clusters.Add(BoundingBox.Empty);
                }

                clusters[target] = BoundingBox.Union(clusters[target], box);
            }
        }

        while (clusters.Count > ClusterBounds.MaxBoxes)
        {
            clusters[0] = BoundingBox.Union(clusters[0], clusters[^1]);
            clusters.RemoveAt(clusters.Count - 1);
        }

        return [.. clusters.Where(cluster => !cluster.IsEmpty)];
    }

    private SubFractal CreateSubFractal(MapSet set, ChildInstance[] children, BoundingVolume[] childVolumes, BoundingVolume volume)
    {
        var childBoxes = new BoundingBox[children.Length];
        for (var i = 0; i < children.Length; i++)
        {
            childBoxes[i] = childVolumes[i].TransformedBox(children[i].Map, children[i].OperatorNormBound);
        }

        var childHull = childVolumes.Length > 0 ? CreateHullBound(childVolumes[0]) : null;
        if (children.Length > ChildGroups.MaxUngroupedChildren)
        {
            var parentBox = BoundingBox.Union(volume.Box, _volumes[0].Box);
            (children, childBoxes) = ChildGroups.Create(set, children, childBoxes, parentBox, childHull);
            childHull = null;
        }

        var hull = CreateHullBound(volume);
        return new(set, children, childBoxes, volume.Box, _volumes[0].Box, hull, childHull, CreateSolid(volume), CreateClusters(volume));
    }

    private static ClusterBounds? CreateClusters(BoundingVolume volume) => volume.Clusters.Length > 1 ? new(volume.Clusters) : null;

    private static ConvexSolid? CreateSolid(BoundingVolume volume) => volume switch
    {
        { Box.IsEmpty: true } => null,
        { Hull: { } hull } => new(hull.Vertices.AsSpan(), volume.Margin),
        _ => ConvexSolid.FromBox(volume.Box),
    };

    private HullBound? CreateHullBound(BoundingVolume volume)
    {
        var (x, y, z) = volume.Box.Size;
        return volume.Hull is null || volume.Hull.Volume() > MaxHullFillRatio * x * y * z
            ? null
            : new(volume.Hull, volume.Box, volume.Margin, includeAxisPlanes: !HasOnlySimilarities);
    }

    private readonly record struct BuiltLevel(SubFractal SubFractal, BoundingVolume Volume, ChildEdge[] Edges);
}
