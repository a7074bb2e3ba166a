using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>What a <see cref="FarthestPointSearch"/> makes as large as possible.</summary>
internal interface IPointMeasure
{
    /// <summary>Computes an upper bound over all points of a sub-fractal's image under a map.</summary>
    double UpperBound(SubFractal subFractal, in AffineMap map);

    /// <summary>Computes the largest value over the vertices of a mesh's image under a map.</summary>
    double MaxOverVertices(Mesh mesh, in AffineMap map);

    /// <summary>What of a map the values depend on: maps with equal keys have equal values. Null where that is unknown.</summary>
    (Vector Direction, double Offset)? Key(in AffineMap map);
}

/// <summary>Finds the largest value of a measure over the points of a fractal, such as how far it reaches in a direction.</summary>
/// <param name="hierarchy">The sub-fractals.</param>
/// <remarks>Its memory serves one search after the other: 40 bytes for each sub-fractal that waits, some megabytes at most.</remarks>
internal sealed class FarthestPointSearch(FractalHierarchy hierarchy)
{
    // Beyond so many, the worst of what waits is given up: its bounds alone are kept.
    private const int MaxWaiting = 1 << 17;
    private const int MaxKept = 1 << 15;

    private readonly List<Opened> _opened = [];

    // A forest's trees stand on one plane and are turned about its normal: to the eye of a direction they are the same.
    // Groups of children have the levels and the map of their parent, so the sub-fractal itself tells them apart.
    private readonly HashSet<(SubFractal SubFractal, LevelState State, (Vector Direction, double Offset) Key)> _seen = [];

    // What may still be opened. Its place follows from that of its parent, which saves most of the memory.
    private readonly PriorityQueue<(int Parent, ChildInstance Child, double Bound), (double, int)> _open = new();

    // The best priority and the largest bound of all that was given up.
    private (double, int) _givenUpPriority;
    private double _givenUpBound;

    /// <summary>Searches the sub-fractals best first.</summary>
    /// <typeparam name="TMeasure">The measure; a struct, so that the search is compiled for it.</typeparam>
    /// <param name="map">From the frame of the fractal to that of the measure.</param>
    /// <param name="measure">The measure.</param>
    /// <param name="relativeTolerance">Values that differ by no more than this part of the largest count as equal.</param>
    /// <param name="maxNodes">Number of sub-fractals after which the search gives up.</param>
    /// <returns>
    /// The largest value of all points to the tolerance; more where the search gave up; negative infinity for a fractal without points.
    /// </returns>
    public double Run<TMeasure>(AffineMap map, TMeasure measure, double relativeTolerance, int maxNodes)
        where TMeasure : struct, IPointMeasure
    {
        if (hierarchy.Root.Box.IsEmpty)
        {
            return double.NegativeInfinity;
        }

        if (hierarchy.Root.Children.Length == 0)
        {
            return measure.MaxOverVertices(hierarchy.BaseMeshes[hierarchy.Root.BaseIndex], in map);
        }

        _open.Clear();
        _givenUpPriority = (double.PositiveInfinity, 0);
        _givenUpBound = double.NegativeInfinity;
        _opened.Clear();
        _seen.Clear();
        // That of the fractal's own box: its radius holds the base mesh too, which maps may make as small as they like.
        var scale = Math.Max(
            Math.Abs(measure.UpperBound(hierarchy.Root, in map)), 0.5 * hierarchy.Root.Box.Diagonal * map.Linear.MaxAbsEntry());
        var tolerance = relativeTolerance * scale;
        // Only the first instance of the base mesh in the order of the queue counts: its bound is the value itself.
        var leaf = (Priority: (double.PositiveInfinity, 0), Value: double.NegativeInfinity);
        var largestLeaf = double.NegativeInfinity;
        var node = (Parent: -1, Child: default(ChildInstance), Bound: double.PositiveInfinity);
        var opened = new Opened(hierarchy.Root, hierarchy.Start, map, 0);
        for (var nodes = 0; ; nodes++)
        {
            if (nodes == maxNodes || (opened.Depth > 0 && opened.SubFractal.Radius * opened.Map.Linear.MaxAbsEntry() <= tolerance))
            {
                return _open.UnorderedItems.Select(item => item.Element.Bound)
                    .Append(node.Bound).Append(largestLeaf).Append(_givenUpBound).Max();
            }

            _opened.Add(opened);
            foreach (var child in opened.SubFractal.Children)
            {
                var levels = hierarchy.Enter(child, opened.State).Level;
                var subFractal = hierarchy.At(child, levels);
                if (subFractal.Box.IsEmpty)
                {
                    continue;
                }

                var childMap = opened.Map * child.Map;
                var bound = hierarchy.IsBase(levels)
                    ? measure.MaxOverVertices(hierarchy.BaseMeshes[subFractal.BaseIndex], in childMap)
                    : Math.Min(node.Bound, measure.UpperBound(subFractal, in childMap));
                // Ties are common in symmetric fractals: of bounds that are equal to the tolerance the deepest is taken first.
                var priority = (tolerance > 0 ? -Math.Round(bound / tolerance) : -bound, -(opened.Depth + 1));
                if (subFractal.Children.Length > 0)
                {
                    // The search ends before it takes what is no better than a leaf. Wide sets would leave megabytes of it.
                    if (leaf.Priority.CompareTo(priority) <= 0 && bound <= largestLeaf)
                    {
                        continue;
                    }

                    _open.Enqueue((_opened.Count - 1, child, bound), priority);
                    continue;
                }

                largestLeaf = Math.Max(largestLeaf, bound);
                if (priority.CompareTo(leaf.Priority) < 0)
                {
                    leaf = (priority, bound);
                }
            }

            if (_open.Count > MaxWaiting)
            {
                GiveUpWorse();
            }

            do
            {
                if (!_open.TryDequeue(out var next, out var nextPriority) || leaf.Priority.CompareTo(nextPriority) <= 0)
                {
                    return _givenUpPriority.CompareTo(leaf.Priority) < 0 ? Math.Max(leaf.Value, _givenUpBound) : leaf.Value;
                }

                node = next;
                opened = Open(next.Parent, next.Child);
            }
            while (measure.Key(opened.Map) is { } key && !_seen.Add((opened.SubFractal, opened.State, key)));
        }
    }

    private void GiveUpWorse()
    {
        var priorities = new double[_open.Count];
        var count = 0;
        foreach (var (_, priority) in _open.UnorderedItems)
        {
            priorities[count++] = priority.Item1;
        }

        Array.Sort(priorities);
        var threshold = priorities[MaxKept];
        var kept = new List<((int Parent, ChildInstance Child, double Bound), (double, int))>(MaxKept);
        var room = MaxKept - Array.FindIndex(priorities, priority => priority.Equals(threshold));
        foreach (var (node, priority) in _open.UnorderedItems)
        {
            if (priority.Item1 < threshold || (priority.Item1.Equals(threshold) && room-- > 0))
            {
                kept.Add((node, priority));
                continue;
            }

            _givenUpPriority = priority.CompareTo(_givenUpPriority) < 0 ? priority : _givenUpPriority;
            _givenUpBound = Math.Max(_givenUpBound, node.Bound);
        }

        _open.Clear();
        _open.EnqueueRange(kept);
    }

    private Opened Open(int parentIndex, ChildInstance child)
    {
        var parent = _opened[parentIndex];
        var state = hierarchy.Enter(child, parent.State);
        return new(hierarchy.At(child, state.Level), state, parent.Map * child.Map, parent.Depth + 1);
    }

    /// <summary>A sub-fractal whose children were measured.</summary>
    private readonly record struct Opened(SubFractal SubFractal, LevelState State, AffineMap Map, int Depth);
}
