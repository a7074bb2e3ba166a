using System.Collections.Immutable;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

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
    private const double Coplanar = 1e-12;
    private const double SamePlane = 1e-9;

    private readonly ImmutableArray<(Vector A, Vector B, Vector C)> _facets;

    private ConvexHull(
        ImmutableArray<Vector> vertices, ImmutableArray<HullPlane> planes, double missed, ImmutableArray<(Vector A, Vector B, Vector C)> facets) =>
        (Vertices, Planes, Missed, _facets) = (vertices, planes, missed, facets);

    /// <summary>Its corners, some of the points.</summary>
    public ImmutableArray<Vector> Vertices { get; }

    /// <summary>The planes of its facets, by falling area: all of the hull lies below each. None for a segment or a point.</summary>
    public ImmutableArray<HullPlane> Planes { get; }

    /// <summary>How far out of the hull of <see cref="Vertices"/> points may lie.</summary>
    public double Missed { get; }

    /// <summary>The hull of some points.</summary>
    /// <param name="points">Finite; at least one.</param>
    /// <param name="mostVertices">At least 4. Beyond, points near the hull are left outside.</param>
    public static ConvexHull Of(ReadOnlySpan<Vector> points, int mostVertices)
    {
        var box = BoundingBox.Empty;
        foreach (var point in points)
        {
            box = box.Including(point);
        }

        var size = box.Diagonal;
        var (i0, i1) = FarthestPair(points);
        if (points[i0] == points[i1])
        {
            return new([points[i0]], [], 0, [(points[i0], points[i0], points[i0])]);
        }

        var along = (points[i1] - points[i0]).UnitVector();
        var i2 = Farthest(points, points[i0], (point, origin) => Vector.Cross(along, point - origin).Length(), out var width);
        if (!(width > Coplanar * size))
        {
            return new([points[i0], points[i1]], [], width, [(points[i0], points[i1], points[i1])]);
        }

        var normal = FaceKernel.UnitNormal(points[i0], points[i1], points[i2]);
        var i3 = Farthest(points, points[i0], (point, origin) => Math.Abs(Vector.Dot(normal, point - origin)), out var height);
        return height > Coplanar * size
            ? new QuickHull(points.ToArray(), Coplanar * size).Solid(i0, i1, i2, i3, mostVertices)
            : FlatHull(points, along, normal, height, mostVertices);
    }

    /// <summary>The hull's image under a map, which is the hull of the images. Misses as much as this times the factor by which the map lengthens.</summary>
    public ConvexHull Image(AffineMap map)
    {
        // Normals go with the cofactors; a mirror turns them inside out.
        var (normals, outwards) = (map.Linear.Cofactors(), map.Linear.Determinant() < 0 ? -1 : 1);
        return new ConvexHull(
            [.. Vertices.Select(vertex => map * vertex)],
            [.. Planes.Select(plane => plane with { Normal = outwards * (normals * plane.Normal).UnitVector(), Offset = double.NegativeInfinity })],
            0,
            [.. _facets.Select(facet => (map * facet.A, map * facet.B, map * facet.C))]).WithOffsets();
    }

    /// <summary>Cubic scene units; 0 where it is flat.</summary>
    public double Volume() => Math.Abs(_facets.Sum(facet => Vector.Dot(facet.A - Vertices[0], Vector.Cross(facet.B - Vertices[0], facet.C - Vertices[0])))) / 6;

    /// <summary>The largest product of a direction with a corner.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    public double Support(Vector direction)
    {
        var most = double.NegativeInfinity;
        foreach (var vertex in Vertices)
        {
            most = Math.Max(most, Vector.Dot(direction, vertex));
        }

        return most;
    }

    /// <summary>At most this far is a point from the hull: 0 inside.</summary>
    public double DistanceBound(Vector point)
    {
        if (Planes.Length > 0 && Planes.All(plane => Vector.Dot(plane.Normal, point) <= plane.Offset))
        {
            return 0;
        }

        var squared = double.PositiveInfinity;
        foreach (var (a, b, c) in _facets)
        {
            squared = Math.Min(squared, FaceKernel.ClosestPoint(point, a, b, c).DistanceSquared);
        }

        return Math.Sqrt(squared);
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private static (int First, int Second) FarthestPair(ReadOnlySpan<Vector> points)
    {
        Span<int> extremes = stackalloc int[6];
        for (var i = 1; i < points.Length; i++)
        {
            for (var axis = 0; axis < 3; axis++)
            {
                var coordinate = Coordinate(points[i], axis);
                extremes[axis] = coordinate < Coordinate(points[extremes[axis]], axis) ? i : extremes[axis];
                extremes[3 + axis] = coordinate > Coordinate(points[extremes[3 + axis]], axis) ? i : extremes[3 + axis];
            }
        }

        var (first, second, most) = (0, 0, 0.0);
        foreach (var i in extremes)
        {
            foreach (var j in extremes)
            {
                var squared = (points[i] - points[j]).LengthSquared();
                (first, second, most) = squared > most ? (i, j, squared) : (first, second, most);
            }
        }

        return (first, second);
    }

    private static int Farthest(ReadOnlySpan<Vector> points, Vector origin, Func<Vector, Vector, double> measure, out double most)
    {
        var farthest = 0;
        most = 0;
        for (var i = 0; i < points.Length; i++)
        {
            var distance = measure(points[i], origin);
            (farthest, most) = distance > most ? (i, distance) : (farthest, most);
        }

        return farthest;
    }

    private static double Coordinate(Vector v, int axis) => axis switch { 0 => v.X, 1 => v.Y, _ => v.Z };

    /// <summary>The hull of points of one plane, by their extremes in evenly spread directions.</summary>
    private static ConvexHull FlatHull(ReadOnlySpan<Vector> points, Vector along, Vector normal, double height, int mostVertices)
    {
        var across = Vector.Cross(normal, along);
        var corners = new List<Vector>();
        for (var i = 0; i < mostVertices; i++)
        {
            var (sine, cosine) = Math.SinCos(2 * Math.PI * i / mostVertices);
            var direction = (cosine * along) + (sine * across);
            var most = double.NegativeInfinity;
            var corner = points[0];
            foreach (var point in points)
            {
                var reach = Vector.Dot(direction, point);
                (corner, most) = reach > most ? (point, reach) : (corner, most);
            }

            if (corners.Count == 0 || (corners[^1] != corner && corners[0] != corner))
            {
                corners.Add(corner);
            }
        }

        var missed = height;
        var planes = new List<HullPlane>();
        for (var i = 0; i < corners.Count; i++)
        {
            var (start, end) = (corners[i], corners[(i + 1) % corners.Count]);
            var outwards = Vector.Cross(end - start, normal).UnitVector();
            planes.Add(new(outwards, Vector.Dot(outwards, start), 0));
            foreach (var point in points)
            {
                if (Vector.Dot(outwards, point - start) > 0)
                {
                    missed = Math.Max(missed, Math.Sqrt(FaceKernel.ClosestPoint(point, start, end, end).DistanceSquared));
                }
            }
        }

        var level = Vector.Dot(normal, points[0]);
        var hull = new ConvexHull([.. corners], [new(normal, level, 1), new(-normal, -level, 1), .. planes], missed, [.. Enumerable.Range(1, Math.Max(1, corners.Count - 2)).Select(i => (corners[0], corners[i % corners.Count], corners[(i + 1) % corners.Count]))]);
        return hull.WithOffsets();
    }

    /// <summary>The same hull, with no corner above its planes by rounding.</summary>
    private ConvexHull WithOffsets() =>
        new(Vertices, [.. Planes.Select(plane => plane with { Offset = Math.Max(plane.Offset, Support(plane.Normal)) })], Missed, _facets);
}

/// <summary>A plane that a hull lies below: normal · point ≤ offset.</summary>
/// <param name="Normal">Of length 1.</param>
/// <param name="Offset">From the origin, along the normal.</param>
/// <param name="Area">Twice the area of the hull's facets in it.</param>
internal readonly record struct HullPlane(Vector Normal, double Offset, double Area);
