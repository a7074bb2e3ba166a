using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// Finds where two surfaces touch or nearly touch: all pairs of triangles within a margin, the outermost parts first, without those that
/// the contacts found so far hold apart.
/// </summary>
internal sealed class ContactSearch : PairSearch
{
    // Cosine of the angle between the line of the closest points and a face, for that face to be touched flatly.
    private const double MinFaceCosine = 0.9999;

    // Relative to the contact distance: edges and corners beyond it are left to the sweep, since their normals change on the way.
    private const double EdgeMargin = 2;

    // Relative to the contact distance: a contact with an edge so near a deeper one with a face is a seam of that face.
    private const double SeamDistance = 4;

    // Relative to the gap of an edge: the face beside a seam is closer.
    private const double MaxSeamGap = 0.98;

    // Relative to the contact distance: gaps that count as equal.
    private const double SeamTolerance = 0.01;

    // Relative to the radius of a ball or capsule: the same for what has one.
    private const double SeamFraction = 0.1;

    // Pairs of parts that are opened: the contacts found up to there have to do.
    private const int MaxPairs = 4_000;

    // Corners of a triangle that is clipped by another.
    private const int MaxCorners = 9;

    private readonly PriorityQueue<Pair, (double Inwardness, int Order)> _queue = new();
    private readonly List<(SurfaceTriangle Placed, int Index)> _near1 = [];
    private readonly List<(SurfaceTriangle Placed, int Index)> _near2 = [];
    private List<NearPair> _near = [];
    private readonly List<(ContactPoint Contact, bool IsCrossing)> _edges = [];
    private readonly List<ContactPoint> _faces = [];
    private readonly ContactManifold _manifold = new();
    private double _distance;
    private double _margin;
    private double _maxDepth;
    private double _seamDistance;
    private Vector _middle;
    private int _order;

    /// <summary>Finds the contacts of two surfaces.</summary>
    /// <param name="first">The first surface.</param>
    /// <param name="motion1">Where it is.</param>
    /// <param name="second">The second surface.</param>
    /// <param name="motion2">Where it is, in the same frame.</param>
    /// <param name="distance">The distance at which surfaces rest on each other, scene units.</param>
    /// <param name="margin">Largest gap that counts, at least that distance.</param>
    /// <param name="contacts">Receives the contacts, in the order of their groups.</param>
    /// <param name="near">Receives all that is within the margin.</param>
    /// <returns>False where there was too much to look at all of it.</returns>
    public bool FindContacts(
        SurfaceNodes first, in SurfaceMotion motion1, SurfaceNodes second, in SurfaceMotion motion2, double distance, double margin,
        List<ContactPoint> contacts, List<NearPair> near)
    {
        _near = near;
        SetPair(first, motion1.Stopped, second, motion2.Stopped);
        _distance = distance;
        _margin = margin;
        var box1 = first[0].Place(in Motion1);
        var box2 = second[0].Place(in Motion2);
        _middle = box1.Radius < box2.Radius ? box1.Centre : box2.Centre;
        _maxDepth = 0.02 * Math.Min(box1.Radius, box2.Radius);
        _queue.Clear();
        _edges.Clear();
        _faces.Clear();
        _order = 0;
        _manifold.Begin(distance);
        Enqueue(0, 0);
        for (var opened = 0; opened < MaxPairs && _queue.TryDequeue(out var pair, out _); opened++)
        {
            if (_manifold.Holds(in pair.Box1, in pair.Box2))
            {
                near.Add(new(pair.First, -1, pair.Second, -1, pair.Axis));
                continue;
            }

            if (first.IsLeaf(pair.First) && second.IsLeaf(pair.Second))
            {
                TestLeaves(pair.First, pair.Second);
                continue;
            }

            var children = OpenLarger(pair.First, pair.Second, out var opensFirst);
            for (var child = children.Start.Value; child < children.End.Value; child++)
            {
                Enqueue(opensFirst ? child : pair.First, opensFirst ? pair.Second : child);
            }
        }

        foreach (var (edge, isCrossing) in _edges)
        {
            if (!IsSeam(in edge, isCrossing))
            {
                _manifold.Add(in edge);
            }
        }

        _manifold.CopyTo(contacts);
        return _queue.Count == 0;
    }

    // Nothing moves, so that what is apart stays so for ever.
    private SeparationTest Test => new(in Motion1, in Motion2, Vector.Zero, 0, Vector.Zero, 0);

    private void Enqueue(int node1, int node2)
    {
        BoundTests++;
        var box1 = First[node1].Place(in Motion1);
        var box2 = Second[node2].Place(in Motion2);
        _ = Test.SafeTime(in box1, in box2, _margin, 1, out var best);
        if (best.Gap <= _margin)
        {
            ref readonly var smaller = ref box1.Radius < box2.Radius ? ref box1 : ref box2;
            _queue.Enqueue(
                new(node1, in box1, node2, in box2, best.Axis), (-(smaller.Centre - _middle).Length() - smaller.Radius, ++_order));
        }
    }

    private void TestLeaves(int leaf1, int leaf2)
    {
        var box1 = First[leaf1].Place(in Motion1);
        var box2 = Second[leaf2].Place(in Motion2);
        CollectNear(First.Triangles(leaf1), in box2, isFirst: true, _near1);
        CollectNear(Second.Triangles(leaf2), in box1, isFirst: false, _near2);
        foreach (ref readonly var triangle1 in CollectionsMarshal.AsSpan(_near1))
        {
            foreach (ref readonly var triangle2 in CollectionsMarshal.AsSpan(_near2))
            {
                if (TestTriangles(in triangle1.Placed, in triangle2.Placed, out var axis))
                {
                    _near.Add(new(leaf1, triangle1.Index, leaf2, triangle2.Index, axis));
                }
            }
        }
    }

    private void CollectNear(
        SurfaceTriangle[] triangles, in SurfaceBox otherBox, bool isFirst, List<(SurfaceTriangle Placed, int Index)> near)
    {
        near.Clear();
        for (var i = 0; i < triangles.Length; i++)
        {
            var triangle = isFirst ? triangles[i].Place(in Motion1) : triangles[i].Place(in Motion2);
            if (Test.SafeTime(in triangle, in otherBox, isFirst, _margin, 1) < 1)
            {
                near.Add((triangle, i));
            }
        }
    }

    /// <summary>Adds the contacts of two triangles.</summary>
    /// <returns>False where they are farther apart than the margin.</returns>
    private bool TestTriangles(in SurfaceTriangle triangle1, in SurfaceTriangle triangle2, out Vector normal)
    {
        normal = Vector.Zero;
        if (Test.SafeTime(in triangle1, in triangle2, _margin, 1) >= 1)
        {
            return false;
        }

        FaceTests++;
        var closest = TrianglePairKernel.Closest(triangle1.Corners, triangle2.Corners);
        var rounding = triangle1.Rounding + triangle2.Rounding;
        var gap = Math.Sqrt(closest.DistanceSquared) - rounding;
        if (gap > _margin)
        {
            return false;
        }

        normal = (closest.Point1 - closest.Point2).UnitVectorOrZero();
        if (normal == Vector.Zero || closest.DistanceSquared == 0)
        {
            AddCrossing(in triangle1, in triangle2, closest.Point1);
            return true;
        }

        var cosine1 = Math.Abs(Vector.Dot(normal, triangle1.Normal));
        var cosine2 = Math.Abs(Vector.Dot(normal, triangle2.Normal));
        if (Math.Max(cosine1, cosine2) >= MinFaceCosine)
        {
            Clip(in triangle1, in triangle2, normal, isFirstClipped: cosine2 >= cosine1, isCrossing: false);
        }
        else if (triangle1.Normal == Vector.Zero && triangle2.Normal == Vector.Zero)
        {
            // Balls and capsules have no edges that could be seams.
            _manifold.Add(CreateContact(in closest, normal, triangle1.Rounding, triangle2.Rounding, gap));
        }
        else if (gap <= EdgeMargin * _distance)
        {
            _seamDistance = (SeamDistance * _distance) + (SeamFraction * rounding);
            _edges.Add((CreateContact(in closest, normal, triangle1.Rounding, triangle2.Rounding, gap), false));
        }

        return true;
    }

    private static ContactPoint CreateContact(
        in TrianglePair closest, Vector normal, double rounding1, double rounding2, double gap) =>
        new(0.5 * (closest.Point1 - (rounding1 * normal) + closest.Point2 + (rounding2 * normal)), normal, gap);

    /// <summary>Adds the corners of what a triangle that lies flat on the face of another has in common with it.</summary>
    /// <param name="triangle1">Of the first surface.</param>
    /// <param name="triangle2">Of the second surface.</param>
    /// <param name="normal">About that of the face, from the second to the first.</param>
    /// <param name="isFirstClipped">True where the face is of the second surface.</param>
    /// <param name="isCrossing">True for triangles that touch or cross.</param>
    private void Clip(
        in SurfaceTriangle triangle1, in SurfaceTriangle triangle2, Vector normal, bool isFirstClipped, bool isCrossing)
    {
        ref readonly var clipped = ref isFirstClipped ? ref triangle1 : ref triangle2;
        ref readonly var face = ref isFirstClipped ? ref triangle2 : ref triangle1;
        var faceNormal = Vector.Dot(normal, face.Normal) < 0 ? -face.Normal : face.Normal;
        Span<Vector> corners = stackalloc Vector[MaxCorners];
        Span<Vector> kept = stackalloc Vector[MaxCorners];
        (corners[0], corners[1], corners[2]) = clipped.Corners;
        var count = ClipBySide(corners, 3, face.Corners.A, face.Corners.B, face.Normal, kept);
        count = ClipBySide(kept, count, face.Corners.B, face.Corners.C, face.Normal, corners);
        count = ClipBySide(corners, count, face.Corners.C, face.Corners.A, face.Normal, kept);
        var towards = isFirstClipped ? 1 : -1;
        // Faces that only touch along an edge are no contact where others touch flatly.
        var isEdge = isCrossing && !HasArea(kept[..count], faceNormal);
        foreach (var corner in kept[..count])
        {
            var height = towards * Vector.Dot(faceNormal, corner - face.Corners.A);
            var gap = height - triangle1.Rounding - triangle2.Rounding;
            if (gap <= _margin && gap >= -_maxDepth)
            {
                var foot = corner - (towards * height * faceNormal);
                var contact = new ContactPoint(
                    0.5 * (corner - (towards * clipped.Rounding * faceNormal) + foot + (towards * face.Rounding * faceNormal)), faceNormal,
                    gap);
                if (isEdge)
                {
                    _seamDistance = SeamDistance * _distance;
                    _edges.Add((contact, true));
                    continue;
                }

                _faces.Add(contact);
                _manifold.Add(in contact);
            }
        }
    }

    private static int ClipBySide(
        ReadOnlySpan<Vector> corners, int count, Vector from, Vector to, Vector faceNormal, Span<Vector> kept)
    {
        var inwards = Vector.Cross(faceNormal, to - from);
        var keptCount = 0;
        for (var i = 0; i < count; i++)
        {
            var current = corners[i];
            var next = corners[(i + 1) % count];
            var height1 = Vector.Dot(inwards, current - from);
            var height2 = Vector.Dot(inwards, next - from);
            if (height1 >= 0)
            {
                kept[keptCount++] = current;
            }

            if ((height1 < 0 && height2 > 0) || (height1 > 0 && height2 < 0))
            {
                kept[keptCount++] = current + (height1 / (height1 - height2) * (next - current));
            }
        }

        return keptCount;
    }

    /// <summary>Adds the contact of triangles that cross: out of the face that is less deep in the other body.</summary>
    private void AddCrossing(in SurfaceTriangle triangle1, in SurfaceTriangle triangle2, Vector point)
    {
        var outwards1 = First.IsMirrored ? -triangle1.Normal : triangle1.Normal;
        var outwards2 = Second.IsMirrored ? -triangle2.Normal : triangle2.Normal;
        var depth1 = triangle2.ReachAlong(outwards1).Minimum - Vector.Dot(outwards1, triangle1.Corners.A);
        var depth2 = triangle1.ReachAlong(outwards2).Minimum - Vector.Dot(outwards2, triangle2.Corners.A);
        var isFirst = outwards2 == Vector.Zero || (outwards1 != Vector.Zero && depth1 > depth2);
        var normal = isFirst ? -outwards1 : outwards2;
        var depth = isFirst ? depth1 : depth2;
        if (normal == Vector.Zero)
        {
            return;
        }

        if (depth >= -_distance)
        {
            Clip(in triangle1, in triangle2, normal, isFirstClipped: !isFirst, isCrossing: true);
        }
        else if (CrossingLength(in triangle1, in triangle2) > SeamTolerance * _distance)
        {
            _manifold.Add(new(point, normal, Math.Max(depth, -_maxDepth)));
        }
    }

    /// <summary>Length of the line in which two triangles cross; 0 or less for those that only touch.</summary>
    private static double CrossingLength(in SurfaceTriangle triangle1, in SurfaceTriangle triangle2)
    {
        var line = Vector.Cross(triangle1.Normal, triangle2.Normal).UnitVectorOrZero();
        var (minimum1, maximum1) = CrossPlane(in triangle1, in triangle2, line);
        var (minimum2, maximum2) = CrossPlane(in triangle2, in triangle1, line);
        return Math.Min(maximum1, maximum2) - Math.Max(minimum1, minimum2);
    }

    private static (double Minimum, double Maximum) CrossPlane(in SurfaceTriangle triangle, in SurfaceTriangle other, Vector line)
    {
        var (a, b, c) = triangle.Corners;
        var range = (Minimum: double.PositiveInfinity, Maximum: double.NegativeInfinity);
        foreach (var (from, to) in (ReadOnlySpan<(Vector From, Vector To)>)[(a, b), (b, c), (c, a)])
        {
            var height1 = Vector.Dot(other.Normal, from - other.Corners.A);
            var height2 = Vector.Dot(other.Normal, to - other.Corners.A);
            if (height1 < 0 != height2 < 0)
            {
                var place = Vector.Dot(line, from + (height1 / (height1 - height2) * (to - from)));
                range = (Math.Min(range.Minimum, place), Math.Max(range.Maximum, place));
            }
        }

        return range;
    }

    private bool HasArea(ReadOnlySpan<Vector> corners, Vector normal)
    {
        var area = 0.0;
        for (var i = 2; i < corners.Length; i++)
        {
            area += Vector.Dot(normal, Vector.Cross(corners[i - 1] - corners[0], corners[i] - corners[0]));
        }

        return Math.Abs(area) > _distance * _distance;
    }

    /// <summary>True for a contact with an edge where faces join that are touched beside it.</summary>
    private bool IsSeam(in ContactPoint edge, bool isCrossing)
    {
        var maxGap = isCrossing ? edge.Gap + (SeamTolerance * _distance) : MaxSeamGap * edge.Gap;
        foreach (var face in _faces)
        {
            if (face.Gap <= maxGap && (face.Point - edge.Point).Length() <= _seamDistance)
            {
                return true;
            }
        }

        return false;
    }

    private readonly struct Pair(int first, in SurfaceBox box1, int second, in SurfaceBox box2, Vector axis)
    {
        public readonly SurfaceBox Box1 = box1;

        public readonly SurfaceBox Box2 = box2;

        public int First { get; } = first;

        public int Second { get; } = second;

        public Vector Axis { get; } = axis;
    }
}
