using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// Finds for how long two moving surfaces stay apart: conservative advancement of pairs of parts, those first that may meet first.
/// </summary>
internal sealed class PairSweep : PairSearch
{
    // Relative to the least distance: what is so near has met.
    private const double TouchFactor = 1.25;

    // Advances of a pair of triangles; where they do not suffice, it stops there.
    private const int MaxAdvances = 200;

    // Advances of a pair of boxes before its parts are looked at.
    private const int MaxBoxAdvances = 20;

    // Boxes that advance by less of the time that is left are opened.
    private const double MinAdvance = 0.02;

    // Triangles that advance by less of the time that is left are tested along more axes.
    private const double MinEdgeAdvance = 0.01;

    // Pairs of parts that are opened; where they do not suffice, the motion ends where the next one may meet.
    private const int MaxPairs = 5_000;

    // Relative to the distance: triangles that are closer from the beginning count as crossing, as rounding may have it.
    private const double MinGap = 1e-7;

    // The same for those that may come half as close; closer ones only by a thousandth, again and again.
    private const double MinHalvedGap = 0.05;
    private const double KeptFraction = 0.999;

    private readonly List<(int First, int Second, double Time)> _open = [];
    private readonly List<SurfaceTriangle> _near1 = [];
    private readonly List<SurfaceTriangle> _near2 = [];
    private double _distance;
    private double _end;

    /// <summary>What the last motion was stopped by, if it was: in the frame of the motions, when it stopped.</summary>
    public ContactPoint? Hit { get; private set; }

    /// <summary>Finds the time up to which two surfaces stay farther apart than a distance.</summary>
    /// <param name="first">The first surface.</param>
    /// <param name="motion1">Its motion.</param>
    /// <param name="second">The second surface.</param>
    /// <param name="motion2">Its motion, in the same frame and unit of time.</param>
    /// <param name="distance">Scene units, positive. Triangles that are closer from the beginning may get half as close.</param>
    /// <param name="end">The time at which the motion ends.</param>
    /// <param name="near">All that may come near; null where that is not known.</param>
    /// <param name="maxGap">What was farther apart than that when it was listed cannot come near.</param>
    /// <returns>The end, or an earlier time at which some triangles are within 1.25 times the distance.</returns>
    /// <remarks>Triangles that cross from the beginning are not looked at.</remarks>
    public double FindImpact(
        SurfaceNodes first, in SurfaceMotion motion1, SurfaceNodes second, in SurfaceMotion motion2, double distance, double end,
        List<NearPair>? near = null, double maxGap = double.PositiveInfinity)
    {
        SetPair(first, in motion1, second, in motion2);
        _distance = distance;
        _end = end;
        Hit = null;
        _open.Clear();
        Push(0, 0, 0);
        // Where the boxes around the whole surfaces do not stay apart, what is near tells more.
        if (_open.Count > 0 && near is not null)
        {
            _open.Clear();
            TestNear(near, maxGap);
        }

        for (var opened = 0; _open.Count > 0; opened++)
        {
            if (opened == MaxPairs)
            {
                _open.ForEach(pair => _end = Math.Min(_end, pair.Time));
                break;
            }

            var (node1, node2, time) = _open[^1];
            _open.RemoveAt(_open.Count - 1);
            if (time < _end)
            {
                Open(node1, node2, time);
            }
        }

        return _end;
    }

    /// <summary>Tests the triangles of two leaves, or pushes the parts of the larger node, those last that may meet first.</summary>
    private void Open(int node1, int node2, double time)
    {
        if (First.IsLeaf(node1) && Second.IsLeaf(node2))
        {
            TestLeaves(node1, node2, time);
            return;
        }

        var firstPushed = _open.Count;
        var children = OpenLarger(node1, node2, out var opensFirst);
        for (var child = children.Start.Value; child < children.End.Value; child++)
        {
            Push(opensFirst ? child : node1, opensFirst ? node2 : child, time);
        }

        CollectionsMarshal.AsSpan(_open)[firstPushed..].Sort(static (pair1, pair2) => pair2.Time.CompareTo(pair1.Time));
    }

    private void TestNear(List<NearPair> near, double maxGap)
    {
        foreach (ref readonly var pair in CollectionsMarshal.AsSpan(near))
        {
            if (pair.Gap > maxGap)
            {
                continue;
            }

            if (pair.Triangle1 < 0)
            {
                Push(pair.Node1, pair.Node2, 0);
                continue;
            }

            ref readonly var local1 = ref First.Leaf(pair.Node1).Triangles[pair.Triangle1];
            ref readonly var local2 = ref Second.Leaf(pair.Node2).Triangles[pair.Triangle2];
            var triangle1 = local1.Place(in Motion1);
            var triangle2 = local2.Place(in Motion2);
            var test = new SeparationTest(
                in Motion1, in Motion2, triangle1.Centre, triangle1.Radius, triangle2.Centre, triangle2.Radius, out var relative);
            if (test.SafeTime(pair.Axis, in triangle1, in triangle2, _distance) < _end)
            {
                TestTriangles(in local1, in local2, 0);
            }
        }
    }

    /// <summary>Advances a pair of boxes to where they may meet, and pushes it if that is before the end.</summary>
    private void Push(int node1, int node2, double time)
    {
        for (var advances = 0; advances < MaxBoxAdvances && time < _end; advances++)
        {
            BoundTests++;
            var from1 = Motion1.From(time);
            var from2 = Motion2.From(time);
            var box1 = First[node1].Place(in from1);
            var box2 = Second[node2].Place(in from2);
            var test = new SeparationTest(in from1, in from2, box1.Centre, box1.Radius, box2.Centre, box2.Radius, out var relative);
            var safe = test.SafeTime(in box1, in box2, _distance, _end - time);
            var isAhead = safe >= MinAdvance * (_end - time);
            time += safe;
            if (!isAhead)
            {
                break;
            }
        }

        if (time < _end)
        {
            _open.Add((node1, node2, time));
        }
    }

    private void TestLeaves(int leaf1, int leaf2, double time)
    {
        var from1 = Motion1.From(time);
        var from2 = Motion2.From(time);
        var box1 = First[leaf1].Place(in from1);
        var box2 = Second[leaf2].Place(in from2);
        CollectNear(First.Leaf(leaf1).Triangles, in from1, in from2, in box2, isFirst: true, time, _near1);
        CollectNear(Second.Leaf(leaf2).Triangles, in from1, in from2, in box1, isFirst: false, time, _near2);
        foreach (var local1 in _near1)
        {
            foreach (var local2 in _near2)
            {
                TestTriangles(in local1, in local2, time);
            }
        }
    }

    /// <summary>Collects the triangles of a leaf that may come near the box of the other leaf.</summary>
    private void CollectNear(
        SurfaceTriangle[] triangles, in SurfaceMotion from1, in SurfaceMotion from2, in SurfaceBox otherBox, bool isFirst, double time,
        List<SurfaceTriangle> near)
    {
        near.Clear();
        foreach (ref readonly var local in triangles.AsSpan())
        {
            var triangle = isFirst ? local.Place(in from1) : local.Place(in from2);
            var test = isFirst
                ? new SeparationTest(
                    in from1, in from2, triangle.Centre, triangle.Radius, otherBox.Centre, otherBox.Radius, out var relative)
                : new SeparationTest(
                    in from1, in from2, otherBox.Centre, otherBox.Radius, triangle.Centre, triangle.Radius, out relative);
            if (test.SafeTime(in triangle, in otherBox, isFirst, _distance, _end - time) < _end - time)
            {
                near.Add(local);
            }
        }
    }

    /// <summary>Advances two triangles until they meet or the motion ends.</summary>
    private void TestTriangles(in SurfaceTriangle local1, in SurfaceTriangle local2, double time)
    {
        var distance = _distance;
        var touch = TouchFactor * distance;
        ContactPoint? hit = null;
        for (var advances = 0; advances < MaxAdvances; advances++)
        {
            var from1 = Motion1.From(time);
            var from2 = Motion2.From(time);
            var triangle1 = local1.Place(in from1);
            var triangle2 = local2.Place(in from2);
            var test = new SeparationTest(
                in from1, in from2, triangle1.Centre, triangle1.Radius, triangle2.Centre, triangle2.Radius, out var relative);
            if (advances == 0 && test.SafeTime(in triangle1, in triangle2, distance, _end - time) >= _end - time)
            {
                return;
            }

            var (gap, axis, middle) = Measure(in triangle1, in triangle2);
            hit = axis == Vector.Zero ? null : new(middle, axis, gap);
            if (advances == 0 && gap < 2 * distance)
            {
                // What is so near from the beginning must not be stopped where it is.
                var gapBefore = time == 0 ? gap : Measure(local1.Place(in Motion1), local2.Place(in Motion2)).Gap;
                if (!(gapBefore > MinGap * distance))
                {
                    return;
                }

                var kept = gapBefore > MinHalvedGap * distance ? 0.5 : KeptFraction;
                distance = Math.Min(distance, kept * gapBefore);
                touch = Math.Min(touch, distance + ((TouchFactor - 1) * (gapBefore - distance)));
            }

            if (gap <= touch)
            {
                break;
            }

            // Where points nearly touch, the normals of faces, and of two edges, are more exact than the line between the points.
            var safe = Math.Max(
                test.SafeTime(axis, in triangle1, in triangle2, distance),
                test.SafeTime(in triangle1, in triangle2, distance, _end - time));
            time += safe > MinEdgeAdvance * (_end - time)
                ? safe : Math.Max(safe, test.EdgeSafeTime(in triangle1, in triangle2, distance, _end - time));
            if (time >= _end)
            {
                return;
            }
        }

        _end = time;
        Hit = hit;
    }

    /// <summary>
    /// Measures the gap of two triangles, with the unit vector from the second to the first (zero where they cross), and the point between.
    /// </summary>
    private (double Gap, Vector Axis, Vector Middle) Measure(in SurfaceTriangle triangle1, in SurfaceTriangle triangle2)
    {
        FaceTests++;
        var closest = TrianglePairKernel.Closest(triangle1.Corners, triangle2.Corners);
        var axis = (closest.Point1 - closest.Point2).UnitVectorOrZero();
        return (
            Math.Sqrt(closest.DistanceSquared) - triangle1.Rounding - triangle2.Rounding, axis,
            0.5 * (closest.Point1 - (triangle1.Rounding * axis) + closest.Point2 + (triangle2.Rounding * axis)));
    }
}
