using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Graphs;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>
/// Adds levels on top of those that were built, and replaces the rounds of a repetition by one that is proved to contain them.
/// </summary>
internal sealed class LevelBuilder
{
    /// <summary>Most levels of a part whose bounds change: more mean that they grow or shrink too slowly to converge.</summary>
    public const int MaxSubFractals = 4000;

    private readonly ChildInstanceBuilder _childBuilder;
    private readonly LevelUnion _union;
    private readonly SubFractalFactory _subFractalFactory;
    private long _childCount;
    private int _firstOfPart;

    /// <summary>Begins with the base meshes, which have no remaining levels.</summary>
    /// <param name="graph">What the levels are of.</param>
    public LevelBuilder(FractalGraph graph)
    {
        _childBuilder = new(graph.BaseMeshes.Length);
        _union = new(Built, new(graph));
        _subFractalFactory = new([.. graph.BaseMeshes], graph.HasOnlySimilarities);
        for (var i = 0; i < graph.BaseMeshes.Length; i++)
        {
            var volume = _subFractalFactory.BaseVolumes[i];
            Built.Add(volume, new(null, volume.Box, [], static () => [], _subFractalFactory.CreateBase(i)), AreasOfBase(graph, i));
        }
    }

    /// <summary>The levels that were built so far.</summary>
    public BuiltLevels Built { get; } = new();

    /// <summary>Refuses more children on all levels together than the limit.</summary>
    public static void RequireAllowedChildren(long count)
    {
        var limit = FractalLimits.HierarchyChildren.Value;
        if (count > limit)
        {
            throw new FractalLimitException(
                $"exact search needs more than the limit of {limit} transformations on all levels together");
        }
    }

    /// <summary>Begins the levels of another part, whose bounds may change on as many levels as those of the first.</summary>
    public void BeginPart() => _firstOfPart = Built.Count - 1;

    /// <summary>Refuses a level on top of those before, if they or their children are too many.</summary>
    public void RequireAllowedLevel(int childCount)
    {
        if (Built.Count - _firstOfPart > MaxSubFractals)
        {
            throw new FractalLimitException(
                "exact search needs transformations that shrink, or less depth: "
                + $"{Built.Top} levels above the base the fractal's bounds still change");
        }

        _childCount += childCount;
        RequireAllowedChildren(_childCount);
    }

    /// <summary>Adds one level on top of those before.</summary>
    /// <param name="edges">Its edges to lower levels.</param>
    /// <param name="mapSet">Its set.</param>
    public void Add(ChildEdge[] edges, MapSet mapSet)
    {
        edges = _childBuilder.Share(edges);
        var level = Built.Top + 1;
        var volume = _union.Compute(edges, level);
        var children = _childBuilder.ExpandChildren(level, edges, Built.EdgesAt);
        var childVolumes = Array.ConvertAll(children, child => Built.VolumeAt(child.RemainingLevels(level)));
        var areas = AreasOf(edges, level);
        var subFractal = _subFractalFactory.Create(mapSet, children, childVolumes, volume, BaseIndexOf(areas, edges, level));
        Built.Add(volume, new(mapSet, volume.Box, edges, EdgeBoxesOf(edges, level, Built.VolumeAt), subFractal), areas);
    }

    /// <summary>Begins a proof that the rounds of a repetition can be replaced by the last one.</summary>
    /// <param name="period">Number of levels of a round.</param>
    /// <param name="round">Number of rounds that were built.</param>
    /// <param name="maxRoundsDown">Largest number of rounds between a sub-fractal and its children.</param>
    /// <param name="arePhasesAlike">Whether the levels of a round may be compared with each other.</param>
    public PeriodicBound CreatePeriodicBound(int period, long round, int maxRoundsDown, bool arePhasesAlike = true) =>
        new(Built.Top, period, Built.VolumeAt, Built.EdgesAt, Math.Max(1, 0.125 * round), maxRoundsDown, arePhasesAlike);

    /// <summary>Replaces all remaining rounds by one that is inflated a little, if it can be proved to contain them.</summary>
    /// <param name="periodicBound">Proves that.</param>
    /// <param name="edgesAt">Gives the edges of levels above the last round.</param>
    /// <param name="levelCount">Number of levels in the remaining rounds.</param>
    public bool TryRepeatRound(PeriodicBound periodicBound, Func<long, ChildEdge[]> edgesAt, long levelCount)
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
            round[phase] = new(volumes[phase], new(set, volumes[phase].Box, edges, edgeBoxes, subFractal), Built.AreasAt(level));
        }

        Built.Add(levelCount, round);
        return true;
    }

    /// <summary>The area of a base mesh, for itself; nothing where it is the only one.</summary>
    private static double[] AreasOfBase(FractalGraph graph, int index)
    {
        if (graph.BaseMeshes is not [_, _, ..])
        {
            return [];
        }

        var areas = new double[graph.BaseMeshes.Length];
        areas[index] = graph.BaseMeshes[index].SurfaceArea();
        return areas;
    }

    /// <summary>Estimates the area that a level shows of each base mesh; nothing where there is only one.</summary>
    private double[] AreasOf(ChildEdge[] edges, long level)
    {
        if (Built.AreasAt(0).Length == 0)
        {
            return [];
        }

        var areas = new double[Built.AreasAt(0).Length];
        foreach (var edge in edges)
        {
            var scale = Math.Pow(Math.Abs(edge.Map.Linear.Determinant()), 2 / 3.0);
            var below = Built.AreasAt(edge.RemainingLevels(level));
            for (var i = 0; i < areas.Length; i++)
            {
                areas[i] += scale * below[i];
            }
        }

        return areas;
    }

    /// <summary>
    /// Finds the base mesh that replaces a level where it is too small: the one that most is seen of, or one with faces, if there is any.
    /// </summary>
    private int BaseIndexOf(double[] areas, ChildEdge[] edges, long level) => areas.Any(static area => area > 0)
        ? areas.IndexOf(areas.Max())
        : edges.Select(edge => edge.RemainingLevels(level)).Where(target => !Built.VolumeAt(target).Box.IsEmpty)
            .Select(Built.BaseIndexAt).FirstOrDefault();

    /// <summary>
    /// Makes the boxes of edges. Those of wide levels are computed at their use: they take much memory, and only drawing needs them.
    /// </summary>
    private static Func<BoundingBox[]> EdgeBoxesOf(ChildEdge[] edges, long level, Func<long, BoundingVolume> volumeAt)
    {
        if (edges.Length > SubFractal.MaxUngroupedChildren)
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
