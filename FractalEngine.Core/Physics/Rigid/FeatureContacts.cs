using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// Finds the contacts of leaves: corners over triangles, edges beside edges, and edges through triangles. Each corner and edge belongs
/// to one triangle, so that none is tested twice.
/// </summary>
internal sealed class FeatureContacts
{
    // Cosine of the angle between the line of the closest points and a face, for that face to be touched flatly.
    private const double MinFaceCosine = 0.9999;

    // Relative to the contact distance: edges beyond it are left to the sweep, since their normals change on the way.
    private const double EdgeMargin = 2;

    // Relative to the contact distance: a contact with an edge so near a deeper one with a face is a seam of that face.
    private const double SeamDistance = 4;

    // Relative to the gap of an edge: the face beside a seam is closer.
    private const double MaxSeamGap = 0.98;

    // Relative to the contact distance: gaps that count as equal.
    private const double SeamTolerance = 0.01;

    // Relative to the radius of a ball or capsule: the same for what has one.
    private const double SeamFraction = 0.1;

    // Relative to the contact distance: what is closer touches, and has no direction but that of the faces.
    private const double MinGap = 1e-3;

    // Relative to the radius of the smaller surface: deeper contacts count as no deeper.
    private const double MaxDepth = 0.02;

    private readonly LeafFeatures _features1 = new();
    private readonly LeafFeatures _features2 = new();
    private readonly List<(ContactPoint Contact, double SeamDistance, bool IsCrossing)> _edges = [];
    private readonly List<ContactPoint> _faces = [];
    private readonly List<(Vector End, int Triangle, bool IsFirst)> _crossed = [];
    private int[] _nearIndices = [];
    private List<NearPair> _near = [];
    private (double First, double Second) _outwards;
    private double _distance;
    private double _margin;
    private double _maxDepth;

    /// <summary>Number of pairs of corners, edges and triangles that have been measured.</summary>
    public long Tests { get; private set; }

    /// <summary>True where an edge has been found to go through the other surface by more than the contact distance.</summary>
    public bool HasCrossed { get; private set; }

    /// <summary>The contacts that have been found, reduced.</summary>
    public ContactManifold Manifold { get; } = new();

    /// <summary>Begins the contacts of two surfaces.</summary>
    /// <param name="isMirrored">Of which surfaces triangles are wound inwards.</param>
    /// <param name="radius">Radius of the smaller one, scene units.</param>
    /// <param name="distance">The distance at which surfaces rest on each other, scene units.</param>
    /// <param name="margin">Largest gap that counts, scene units.</param>
    /// <param name="near">Receives all that is within the margin.</param>
    public void Begin((bool First, bool Second) isMirrored, double radius, double distance, double margin, List<NearPair> near)
    {
        _outwards = (isMirrored.First ? -1 : 1, isMirrored.Second ? -1 : 1);
        _distance = distance;
        _margin = margin;
        _maxDepth = MaxDepth * radius;
        _near = near;
        HasCrossed = false;
        _edges.Clear();
        _faces.Clear();
        Manifold.Begin(distance);
    }

    /// <summary>Adds the contacts of two leaves.</summary>
    /// <param name="first">The first surface.</param>
    /// <param name="leaf1">Index of its leaf.</param>
    /// <param name="motion1">Where it is.</param>
    /// <param name="second">The second surface.</param>
    /// <param name="leaf2">Index of its leaf.</param>
    /// <param name="motion2">Where it is, in the same frame.</param>
    public void Add(
        SurfaceNodes first, int leaf1, in SurfaceMotion motion1, SurfaceNodes second, int leaf2, in SurfaceMotion motion2)
    {
        _features1.Collect(first, leaf1, in motion1, second[leaf2].Place(in motion2), _margin);
        _features2.Collect(second, leaf2, in motion2, first[leaf1].Place(in motion1), _margin);
        var count = _features1.Leaf.Triangles.Length * _features2.Leaf.Triangles.Length;
        if (_nearIndices.Length < count)
        {
            _nearIndices = new int[count];
        }

        _nearIndices.AsSpan(0, count).Fill(-1);
        _crossed.Clear();
        AddCrossings(_features1, _features2, isFirst: true);
        AddCrossings(_features2, _features1, isFirst: false);
        AddCorners(_features1, _features2, isFirst: true);
        AddCorners(_features2, _features1, isFirst: false);
        foreach (ref readonly var edge1 in CollectionsMarshal.AsSpan(_features1.Edges))
        {
            foreach (ref readonly var edge2 in CollectionsMarshal.AsSpan(_features2.Edges))
            {
                AddEdges(in edge1, in edge2);
            }
        }
    }

    /// <summary>Ends the contacts of two surfaces, and lists those that are kept.</summary>
    public void End(List<ContactPoint> contacts)
    {
        foreach (var (edge, seamDistance, isCrossing) in _edges)
        {
            if (!IsSeam(in edge, seamDistance, isCrossing))
            {
                Manifold.Add(in edge);
            }
        }

        Manifold.CopyTo(contacts);
    }

    /// <summary>Adds the contacts of edges of one leaf that go through triangles of the other.</summary>
    private void AddCrossings(LeafFeatures withEdges, LeafFeatures withTriangles, bool isFirst)
    {
        foreach (ref readonly var edge in CollectionsMarshal.AsSpan(withEdges.Edges))
        {
            foreach (ref readonly var near in CollectionsMarshal.AsSpan(withTriangles.Triangles))
            {
                ref readonly var triangle = ref near.Placed;
                var height1 = Vector.Dot(triangle.Normal, edge.Start - triangle.Corners.A);
                var height2 = Vector.Dot(triangle.Normal, edge.End - triangle.Corners.A);
                // What only touches is found as a corner over a triangle, or as two edges.
                if (height1 < 0 == height2 < 0 || Math.Min(Math.Abs(height1), Math.Abs(height2)) <= MinGap * _distance)
                {
                    continue;
                }

                Tests++;
                var point = edge.Start + (height1 / (height1 - height2) * (edge.End - edge.Start));
                if (IsInside(in triangle, point))
                {
                    var other = withEdges.Triangle(edge.Triangle);
                    _crossed.Add((Math.Abs(height1) < Math.Abs(height2) ? edge.Start : edge.End, near.Index, isFirst));
                    AddNear(edge.Triangle, near.Index, isFirst, Vector.Zero, 0);
                    AddCrossing(in isFirst ? ref other : ref triangle, in isFirst ? ref triangle : ref other, point);
                }
            }
        }
    }

    /// <summary>Adds the contact of triangles that cross: out of the face that is less deep in the other body.</summary>
    private void AddCrossing(in SurfaceTriangle triangle1, in SurfaceTriangle triangle2, Vector point)
    {
        var outwards1 = _outwards.First * triangle1.Normal;
        var outwards2 = _outwards.Second * triangle2.Normal;
        var depth1 = triangle2.LowestAlong(outwards1) - Vector.Dot(outwards1, triangle1.Corners.A);
        var depth2 = triangle1.LowestAlong(outwards2) - Vector.Dot(outwards2, triangle2.Corners.A);
        var isFirst = outwards2 == Vector.Zero || (outwards1 != Vector.Zero && depth1 > depth2);
        var contact = new ContactPoint(point, isFirst ? -outwards1 : outwards2, Math.Max(isFirst ? depth1 : depth2, -_maxDepth));
        if (contact.Gap >= -_distance)
        {
            // What only touches along an edge is no contact where others touch flatly.
            _edges.Add((contact, SeamDistance * _distance, true));
        }
        else
        {
            HasCrossed = true;
            Manifold.Add(in contact);
        }
    }

    /// <summary>Adds the contacts of corners of one leaf with triangles of the other.</summary>
    private void AddCorners(LeafFeatures withCorners, LeafFeatures withTriangles, bool isFirst)
    {
        foreach (ref readonly var corner in CollectionsMarshal.AsSpan(withCorners.Corners))
        {
            foreach (ref readonly var near in CollectionsMarshal.AsSpan(withTriangles.Triangles))
            {
                AddCorner(in corner, in near.Placed, near.Index, isFirst);
            }
        }
    }

    private void AddCorner(in SurfaceCorner corner, in SurfaceTriangle triangle, int index, bool isFirst)
    {
        var (a, b, c) = triangle.Corners;
        var height = Vector.Dot(triangle.Normal, corner.Position - a);
        var rounding = corner.Rounding + triangle.Rounding;
        if (Math.Abs(height) - rounding > _margin || triangle.Normal == Vector.Zero)
        {
            return;
        }

        Tests++;
        var closest = TriangleKernel.ClosestPoint(corner.Position, a, b, c);
        var gap = Math.Sqrt(closest.DistanceSquared) - rounding;
        if (gap > _margin)
        {
            return;
        }

        // Where nothing tells the side, it is that of a body's outside, and of the faces that meet there the one before the corner.
        var isTouching = Math.Abs(height) <= MinGap * _distance;
        var side = !isTouching ? Math.Sign(height) : isFirst ? _outwards.Second : _outwards.First;
        var normal = side * triangle.Normal;
        AddNear(corner.Triangle, index, isFirst, normal, gap);
        var foot = corner.Position - (height * triangle.Normal);
        var isOver = (closest.Point - foot).LengthSquared() <= MinGap * MinGap * _distance * _distance
            && !(isTouching && Vector.Dot(normal, corner.Inwards) < 0);
        if (isOver && !_crossed.Contains((corner.Position, index, isFirst)))
        {
            AddFace(new(
                0.5 * (corner.Position - (corner.Rounding * normal) + foot + (triangle.Rounding * normal)), isFirst ? normal : -normal,
                (side * height) - rounding));
        }
    }

    private void AddFace(in ContactPoint contact)
    {
        _faces.Add(contact);
        Manifold.Add(in contact);
    }

    private void AddEdges(in SurfaceEdge edge1, in SurfaceEdge edge2)
    {
        Tests++;
        Span<(Vector Point1, Vector Point2)> pairs = stackalloc (Vector, Vector)[4];
        var count = SurfaceEdge.FindClosest(in edge1, in edge2, pairs);
        foreach (var (point1, point2) in pairs[..count])
        {
            AddEdges(in edge1, point1, in edge2, point2);
        }
    }

    private void AddEdges(in SurfaceEdge edge1, Vector point1, in SurfaceEdge edge2, Vector point2)
    {
        var rounding = edge1.Rounding + edge2.Rounding;
        var length = (point1 - point2).Length();
        var gap = length - rounding;
        if (gap > _margin)
        {
            return;
        }

        var normal = IsInside(in edge1, point1) && IsInside(in edge2, point2) ? NormalOf(in edge1, in edge2, point1 - point2)
            : length > MinGap * _distance ? (point1 - point2) / length
            : Vector.Zero;
        AddNear(edge1.Triangle, edge2.Triangle, isFirst: true, normal, gap);
        if (normal == Vector.Zero)
        {
            return;
        }

        var face = FaceAlong(in edge1, in edge2, normal);
        if (face != Vector.Zero)
        {
            normal = face;
            gap = Vector.Dot(face, point1 - point2) - rounding;
        }

        var contact = new ContactPoint(0.5 * (point1 - (edge1.Rounding * normal) + point2 + (edge2.Rounding * normal)), normal, gap);
        if (face != Vector.Zero)
        {
            AddFace(in contact);
        }
        else if (edge1.Rounding > 0 && edge2.Rounding > 0)
        {
            // Balls and capsules have no edges that could be seams.
            Manifold.Add(in contact);
        }
        else if (gap <= EdgeMargin * _distance)
        {
            _edges.Add((contact, (SeamDistance * _distance) + (SeamFraction * rounding), false));
        }
    }

    private bool IsInside(in SurfaceTriangle triangle, Vector point)
    {
        var (a, b, c) = triangle.Corners;
        return IsInside(triangle.Normal, a, b, point) && IsInside(triangle.Normal, b, c, point) && IsInside(triangle.Normal, c, a, point);
    }

    private bool IsInside(Vector normal, Vector start, Vector end, Vector point) =>
        Vector.Dot(Vector.Cross(normal, end - start), point - start) > MinGap * _distance * (end - start).Length();

    private bool IsInside(in SurfaceEdge edge, Vector point) =>
        Math.Min((point - edge.Start).Length(), (point - edge.End).Length()) > MinGap * _distance;

    /// <summary>
    /// The normal of edges that cross: at right angles to both, which tells more of it than closest points that rounding moves along the
    /// edges. Where they touch, it leads out of the second surface.
    /// </summary>
    private Vector NormalOf(in SurfaceEdge edge1, in SurfaceEdge edge2, Vector between)
    {
        var normal = Vector.Cross(edge1.End - edge1.Start, edge2.End - edge2.Start).UnitVectorOrZero();
        var side = between.Length() > MinGap * _distance ? between
            : (_outwards.Second * (edge2.Normal1 + edge2.Normal2)) - (_outwards.First * (edge1.Normal1 + edge1.Normal2));
        return Vector.Dot(normal, side) < 0 ? -normal : normal;
    }

    /// <summary>The normal of a face beside one of two edges that is about the line between them; zero where there is none.</summary>
    private static Vector FaceAlong(in SurfaceEdge edge1, in SurfaceEdge edge2, Vector line)
    {
        foreach (var normal in (ReadOnlySpan<Vector>)[edge2.Normal1, edge2.Normal2, edge1.Normal1, edge1.Normal2])
        {
            var cosine = Vector.Dot(normal, line);
            if (Math.Abs(cosine) >= MinFaceCosine)
            {
                return cosine < 0 ? -normal : normal;
            }
        }

        return Vector.Zero;
    }

    /// <summary>Adds two triangles to those that are near, or what is closer of them.</summary>
    private void AddNear(int triangle, int otherTriangle, bool isFirst, Vector axis, double gap)
    {
        var (triangle1, triangle2) = isFirst ? (triangle, otherTriangle) : (otherTriangle, triangle);
        ref var index = ref _nearIndices[(triangle1 * _features2.Leaf.Triangles.Length) + triangle2];
        var pair = new NearPair(_features1.Index, triangle1, _features2.Index, triangle2, isFirst ? axis : -axis, gap);
        if (index < 0)
        {
            index = _near.Count;
            _near.Add(pair);
        }
        else if (gap < _near[index].Gap)
        {
            _near[index] = pair;
        }
    }

    /// <summary>True for a contact with an edge where faces join that are touched beside it.</summary>
    private bool IsSeam(in ContactPoint edge, double seamDistance, bool isCrossing)
    {
        var maxGap = isCrossing ? edge.Gap + (SeamTolerance * _distance) : MaxSeamGap * edge.Gap;
        foreach (ref readonly var face in CollectionsMarshal.AsSpan(_faces))
        {
            if (face.Gap <= maxGap && (face.Point - edge.Point).Length() <= seamDistance)
            {
                return true;
            }
        }

        return false;
    }
}
