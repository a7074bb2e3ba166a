using System.Collections.Immutable;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// The convex hull of some points, or, where it has too many corners, that of the most important ones. Flat sets, segments and
/// single points have hulls as well.
/// </summary>
/// <remarks>
/// Quickhull (Barber, Dobkin and Huhdanpaa 1996): begin with a tetrahedron, then add the point farthest above some facet, and replace
/// the facets that it sees by those between it and their horizon.
/// </remarks>
internal sealed partial class ConvexHull
{
    // Of the size of the set. Nearer points count as on a facet, and facets that differ by less are one plane.
    private const double CoplanarTolerance = 1e-12;
    private const double SamePlaneTolerance = 1e-9;

    private readonly ImmutableArray<(Vector A, Vector B, Vector C)> _facets;

    private ConvexHull(
        ImmutableArray<Vector> vertices, ImmutableArray<HullPlane> planes, double maxOutsideDistance,
        ImmutableArray<(Vector A, Vector B, Vector C)> facets) =>
        (Vertices, Planes, MaxOutsideDistance, _facets) = (vertices, planes, maxOutsideDistance, facets);

    /// <summary>Its corners, some of the points.</summary>
    public ImmutableArray<Vector> Vertices { get; }

    /// <summary>The planes of its facets, by falling area: all of the hull lies below each. None for a segment or a point.</summary>
    public ImmutableArray<HullPlane> Planes { get; }

    /// <summary>How far out of the hull of <see cref="Vertices"/> points may lie.</summary>
    public double MaxOutsideDistance { get; }

    /// <summary>The hull of some points.</summary>
    /// <param name="points">Finite; at least one.</param>
    /// <param name="maxVertices">At least 4. Beyond, points near the hull are left outside.</param>
    public static ConvexHull Build(ReadOnlySpan<Vector> points, int maxVertices)
    {
        var box = BoundingBox.Empty;
        foreach (var point in points)
        {
            box = box.Including(point);
        }

        var size = box.Diagonal;
        var (i0, i1) = FindFarthestPair(points);
        if (points[i0] == points[i1])
        {
            return new([points[i0]], [], 0, [(points[i0], points[i0], points[i0])]);
        }

        var direction = (points[i1] - points[i0]).UnitVector();
        var i2 = FindFarthest(points, points[i0], (point, origin) => Vector.Cross(direction, point - origin).Length(), out var width);
        if (!(width > CoplanarTolerance * size))
        {
            return new([points[i0], points[i1]], [], width, [(points[i0], points[i1], points[i1])]);
        }

        var normal = TriangleKernel.UnitNormal(points[i0], points[i1], points[i2]);
        var i3 = FindFarthest(points, points[i0], (point, origin) => Math.Abs(Vector.Dot(normal, point - origin)), out var height);
        return height > CoplanarTolerance * size
            ? new QuickHull(points.ToArray(), CoplanarTolerance * size).Build(i0, i1, i2, i3, maxVertices)
            : BuildFlatHull(points, direction, normal, height, maxVertices);
    }

    /// <summary>
    /// The hull's image under a map, which is the hull of the images. Misses as much as this times the factor by which the map lengthens.
    /// </summary>
    public ConvexHull Transform(AffineMap map)
    {
        // Normals go with the cofactors; a mirror turns them inside out.
        var (normals, orientation) = (map.Linear.Cofactors(), map.Linear.Determinant() < 0 ? -1 : 1);
        return new ConvexHull(
            [.. Vertices.Select(vertex => map * vertex)],
            [.. Planes.Select(
                plane => plane with { Normal = orientation * (normals * plane.Normal).UnitVector(), Offset = double.NegativeInfinity })],
            0,
            [.. _facets.Select(facet => (map * facet.A, map * facet.B, map * facet.C))]).WithConservativeOffsets();
    }

    /// <summary>Cubic scene units; 0 where it is flat.</summary>
    public double Volume() =>
        Math.Abs(_facets.Sum(facet => Vector.Dot(facet.A - Vertices[0], Vector.Cross(facet.B - Vertices[0], facet.C - Vertices[0])))) / 6;

    /// <summary>The largest product of a direction with a corner.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    public double Support(Vector direction)
    {
        var maxProduct = double.NegativeInfinity;
        foreach (var vertex in Vertices)
        {
            maxProduct = Math.Max(maxProduct, Vector.Dot(direction, vertex));
        }

        return maxProduct;
    }

    /// <summary>At most this far is a point from the hull: 0 inside.</summary>
    public double DistanceUpperBound(Vector point)
    {
        if (Planes.Length > 0 && Planes.All(plane => Vector.Dot(plane.Normal, point) <= plane.Offset))
        {
            return 0;
        }

        var distanceSquared = double.PositiveInfinity;
        foreach (var (a, b, c) in _facets)
        {
            distanceSquared = Math.Min(distanceSquared, TriangleKernel.ClosestPoint(point, a, b, c).DistanceSquared);
        }

        return Math.Sqrt(distanceSquared);
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private static (int First, int Second) FindFarthestPair(ReadOnlySpan<Vector> points)
    {
        Span<int> extremes = stackalloc int[6];
        for (var i = 1; i < points.Length; i++)
        {
            for (var axis = 0; axis < 3; axis++)
            {
                var coordinate = Component(points[i], axis);
                extremes[axis] = coordinate < Component(points[extremes[axis]], axis) ? i : extremes[axis];
                extremes[3 + axis] = coordinate > Component(points[extremes[3 + axis]], axis) ? i : extremes[3 + axis];
            }
        }

        var (first, second, maxDistanceSquared) = (0, 0, 0.0);
        foreach (var i in extremes)
        {
            foreach (var j in extremes)
            {
                var distanceSquared = (points[i] - points[j]).LengthSquared();
                (first, second, maxDistanceSquared) = distanceSquared > maxDistanceSquared
                    ? (i, j, distanceSquared)
                    : (first, second, maxDistanceSquared);
            }
        }

        return (first, second);
    }

    private static int FindFarthest(ReadOnlySpan<Vector> points, Vector origin, Func<Vector, Vector, double> measure,
        out double maxDistance)
    {
        var farthest = 0;
        maxDistance = 0;
        for (var i = 0; i < points.Length; i++)
        {
            var distance = measure(points[i], origin);
            (farthest, maxDistance) = distance > maxDistance ? (i, distance) : (farthest, maxDistance);
        }

        return farthest;
    }

    private static double Component(Vector v, int axis) => axis switch { 0 => v.X, 1 => v.Y, _ => v.Z };

    /// <summary>The hull of points of one plane, by their extremes in evenly spread directions.</summary>
    private static ConvexHull BuildFlatHull(ReadOnlySpan<Vector> points, Vector along, Vector normal, double height, int maxVertices)
    {
        var across = Vector.Cross(normal, along);
        var vertices = new List<Vector>();
        for (var i = 0; i < maxVertices; i++)
        {
            var (sine, cosine) = Math.SinCos(2 * Math.PI * i / maxVertices);
            var direction = (cosine * along) + (sine * across);
            var maxProjection = double.NegativeInfinity;
            var vertex = points[0];
            foreach (var point in points)
            {
                var projection = Vector.Dot(direction, point);
                (vertex, maxProjection) = projection > maxProjection ? (point, projection) : (vertex, maxProjection);
            }

            if (vertices.Count == 0 || (vertices[^1] != vertex && vertices[0] != vertex))
            {
                vertices.Add(vertex);
            }
        }

        var maxOutsideDistance = height;
        var planes = new List<HullPlane>();
        for (var i = 0; i < vertices.Count; i++)
        {
            var (start, end) = (vertices[i], vertices[(i + 1) % vertices.Count]);
            var outwards = Vector.Cross(end - start, normal).UnitVector();
            planes.Add(new(outwards, Vector.Dot(outwards, start), 0));
            foreach (var point in points)
            {
                if (Vector.Dot(outwards, point - start) > 0)
                {
                    maxOutsideDistance =
                        Math.Max(maxOutsideDistance, Math.Sqrt(TriangleKernel.ClosestPoint(point, start, end, end).DistanceSquared));
                }
            }
        }

        var planeOffset = Vector.Dot(normal, points[0]);
        var hull = new ConvexHull([.. vertices], [new(normal, planeOffset, 1), new(-normal, -planeOffset, 1), .. planes],
            maxOutsideDistance,
            [.. Enumerable.Range(1, Math.Max(1, vertices.Count - 2))
            .Select(i => (vertices[0], vertices[i % vertices.Count], vertices[(i + 1) % vertices.Count]))]);
        return hull.WithConservativeOffsets();
    }

    /// <summary>The same hull, with no corner above its planes by rounding.</summary>
    private ConvexHull WithConservativeOffsets() =>
        new(Vertices, [.. Planes.Select(plane => plane with { Offset = Math.Max(plane.Offset, Support(plane.Normal)) })],
        MaxOutsideDistance, _facets);
}

/// <summary>A plane that a hull lies below: normal · point ≤ offset.</summary>
/// <param name="Normal">Of length 1.</param>
/// <param name="Offset">From the origin, along the normal.</param>
/// <param name="Area">Twice the area of the hull's facets in it.</param>
internal readonly record struct HullPlane(Vector Normal, double Offset, double Area);
