using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Regions;

/// <summary>
/// Finds the closest points of two shapes by branch and bound on pairs of nodes. It always opens the pair with the lowest bound, and the
/// larger node of the two.
/// </summary>
/// <remarks>
/// Now and then it descends from the best pair to a pair of leaves, always into the closest child: at first, then after twice as many pairs
/// each time. So it has a good result early, also where many bounds are nearly equal, as between parallel walls of deep fractals. It ends
/// when it has met the limit of work, and says what it left open.
/// </remarks>
internal sealed class ClosestPairSearch
{
    // About a second of work, and at most 100 MB of nodes.
    private const int MaxBoundTests = 1_000_000;
    private const int MaxNodes = 400_000;

    private readonly ShapeNodes _nodes1;
    private readonly ShapeNodes _nodes2;
    private readonly QueryStatistics _statistics;
    private readonly double _tolerance;
    private readonly PriorityQueue<NodePair, (double BoundSquared, int NegativeDepth)> _queue = new();
    private readonly List<NodePair> _children = [];
    private TrianglePair _best = new(default, default, double.PositiveInfinity);
    private (int Leaf, int Face) _bestPlace1;
    private (int Leaf, int Face) _bestPlace2;
    private double _cutoffSquared = double.PositiveInfinity;
    private long _work;

    private ClosestPairSearch(ShapeTree tree1, in AffineMap map1, ShapeTree tree2, in AffineMap map2, QueryStatistics statistics)
    {
        _nodes1 = new(tree1, in map1);
        _nodes2 = new(tree2, in map2);
        _statistics = statistics;
        _tolerance = RoundingErrors.Coordinate * Math.Max(
            _nodes1[0].Box.MaxAbsCoordinate(), _nodes2[0].Box.MaxAbsCoordinate());
    }

    /// <summary>Finds the closest points of two shapes.</summary>
    /// <param name="tree1">The first shape.</param>
    /// <param name="map1">From its frame to that of the query.</param>
    /// <param name="tree2">The second shape.</param>
    /// <param name="map2">From its frame to that of the query.</param>
    /// <param name="statistics">Receives the cost.</param>
    /// <exception cref="InvalidOperationException">A shape has no faces.</exception>
    /// <exception cref="FractalLimitException">The distance is beyond the range of a double.</exception>
    public static ClosestPair Run(ShapeTree tree1, in AffineMap map1, ShapeTree tree2, in AffineMap map2, QueryStatistics statistics)
    {
        if (tree1.IsEmpty || tree2.IsEmpty)
        {
            throw new InvalidOperationException("a shape has no faces, so no points of the two are closest");
        }

        var scale = QueryScale.Of(Math.Max(
            tree1.Box.Transform(map1).MaxAbsCoordinate(), tree2.Box.Transform(map2).MaxAbsCoordinate()));
        var toUnits = QueryScale.Scaling(scale);
        var pair = RunScaled(tree1, toUnits * map1, tree2, toUnits * map2, statistics);
        return scale == 1 ? pair : pair with
        {
            Distance = pair.Distance / scale,
            Point = pair.Point / scale,
            OtherPoint = pair.OtherPoint / scale,
            ErrorBound = pair.ErrorBound / scale,
        };
    }

    private static ClosestPair RunScaled(
        ShapeTree tree1, in AffineMap map1, ShapeTree tree2, in AffineMap map2, QueryStatistics statistics)
    {
        var search = new ClosestPairSearch(tree1.WithHierarchy(), in map1, tree2.WithHierarchy(), in map2, statistics);
        var openBoundSquared = search.Run();
        statistics.BoundTests += search._work;
        return search.CreateResult(openBoundSquared);
    }

    /// <summary>Searches until nothing closer is possible, or the limit is met.</summary>
    /// <returns>Lower bound of the squared distance of what was left open; infinite when nothing was.</returns>
    private double Run()
    {
        Enqueue(new(0, 0, 0, 0, IsRefined: false));
        var nextDescent = 1L;
        for (var visits = 1L; _queue.TryDequeue(out var pair, out _); visits++)
        {
            if (Excludes(pair.BoundSquared))
            {
                break;
            }

            if (_work >= MaxBoundTests || _nodes1.Count + _nodes2.Count >= MaxNodes)
            {
                return pair.BoundSquared;
            }

            if (visits == nextDescent)
            {
                nextDescent *= 2;
                Descend(pair);
            }
            else if (pair.IsRefined)
            {
                Open(pair);
                _children.ForEach(Enqueue);
            }
            else
            {
                Enqueue(Refine(pair));
            }
        }

        return double.PositiveInfinity;
    }

    /// <summary>Opens a pair, its closest child and so on down to a pair of leaves. The other children are queued.</summary>
    private void Descend(NodePair pair)
    {
        while (true)
        {
            Open(pair);
            if (_children.Count == 0)
            {
                return;
            }

            var closest = 0;
            var closestKey = (double.PositiveInfinity, double.PositiveInfinity);
            for (var i = 0; i < _children.Count; i++)
            {
                // Among several at the same distance, such as 0, the one whose middles are closest is taken.
                var key = (_children[i].BoundSquared, MiddlesDistanceSquared(_children[i]));
                if (key.CompareTo(closestKey) < 0)
                {
                    closest = i;
                    closestKey = key;
                }
            }

            pair = _children[closest];
            for (var i = 0; i < _children.Count; i++)
            {
                if (i != closest)
                {
                    Enqueue(_children[i]);
                }
            }
        }
    }

    /// <summary>Lists the pairs of the larger node's children with the other node, or tests the triangles of two leaves.</summary>
    private void Open(in NodePair pair)
    {
        _children.Clear();
        var isLeaf1 = _nodes1.IsLeaf(pair.Node1);
        if (isLeaf1 && _nodes2.IsLeaf(pair.Node2))
        {
            TestTriangles(in pair);
            return;
        }

        var opensFirst = !isLeaf1 && (_nodes2.IsLeaf(pair.Node2) || _nodes1[pair.Node1].Box.Diagonal >= _nodes2[pair.Node2].Box.Diagonal);
        var children = opensFirst ? _nodes1.Children(pair.Node1) : _nodes2.Children(pair.Node2);
        for (var child = children.Start.Value; child < children.End.Value; child++)
        {
            var (node1, node2) = opensFirst ? (child, pair.Node2) : (pair.Node1, child);
            // A bound of the parents holds for the children.
            var boundSquared = Math.Max(pair.BoundSquared, DistanceSquared(_nodes1[node1].Box, _nodes2[node2].Box));
            _work++;
            if (!Excludes(boundSquared))
            {
                _children.Add(new(node1, node2, boundSquared, pair.Depth + 1, IsRefined: false));
            }
        }
    }

    private NodePair Refine(in NodePair pair)
    {
        _work++;
        var boundSquared = ConvexPairDistance.LowerBoundSquared(_nodes1[pair.Node1], _nodes2[pair.Node2], _cutoffSquared);
        return pair with { BoundSquared = Math.Max(pair.BoundSquared, boundSquared), IsRefined = true };
    }

    private void TestTriangles(in NodePair pair)
    {
        var triangles2 = _nodes2.Triangles(pair.Node2);
        var box2 = _nodes2[pair.Node2].Box;
        foreach (ref readonly var triangle1 in _nodes1.Triangles(pair.Node1))
        {
            _work++;
            if (Excludes(DistanceSquared(triangle1.Box, box2)))
            {
                continue;
            }

            foreach (ref readonly var triangle2 in triangles2)
            {
                _work++;
                if (!Excludes(DistanceSquared(triangle1.Box, triangle2.Box)))
                {
                    TestTriangles(in pair, in triangle1, in triangle2);
                }
            }
        }
    }

    private void TestTriangles(in NodePair pair, in ShapeNodes.Triangle triangle1, in ShapeNodes.Triangle triangle2)
    {
        _statistics.FaceTests++;
        var closest = TrianglePairKernel.Closest(triangle1.Corners, triangle2.Corners);
        if (closest.DistanceSquared < _best.DistanceSquared)
        {
            _best = closest;
            _bestPlace1 = (pair.Node1, triangle1.Face);
            _bestPlace2 = (pair.Node2, triangle2.Face);
            // Distances that differ by no more than rounding count as equal.
            var cutoff = Math.Max(0, Math.Sqrt(closest.DistanceSquared) - _tolerance);
            _cutoffSquared = cutoff * cutoff;
        }
    }

    private void Enqueue(NodePair pair)
    {
        if (!Excludes(pair.BoundSquared))
        {
            _queue.Enqueue(pair, (pair.BoundSquared, -pair.Depth));
        }
    }

    private bool Excludes(double boundSquared) => boundSquared >= _cutoffSquared;

    private double MiddlesDistanceSquared(in NodePair pair) =>
        (_nodes1[pair.Node1].Box.Centre - _nodes2[pair.Node2].Box.Centre).LengthSquared();

    private static double DistanceSquared(BoundingBox box1, BoundingBox box2)
    {
        var gap = Vector.Max(box1.Minimum - box2.Maximum, box2.Minimum - box1.Maximum);
        return Vector.Max(gap, Vector.Zero).LengthSquared();
    }

    private ClosestPair CreateResult(double openBoundSquared)
    {
        if (!double.IsFinite(_best.DistanceSquared))
        {
            throw new FractalLimitException("the distance of the shapes is beyond the range of a double");
        }

        var distance = Math.Sqrt(_best.DistanceSquared);
        var rounding = _tolerance + _nodes1[_bestPlace1.Leaf].Slack + _nodes2[_bestPlace2.Leaf].Slack;
        var error = Math.Max(0, distance - Math.Sqrt(openBoundSquared)) + rounding + _nodes1.Precision + _nodes2.Precision;
        return new(
            distance, _best.Point1, _best.Point2, _bestPlace1.Face, _bestPlace2.Face, [.. _nodes1.InstancePath(_bestPlace1.Leaf)],
            [.. _nodes2.InstancePath(_bestPlace2.Leaf)], Math.Min(distance, error));
    }
}
