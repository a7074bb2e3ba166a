using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Hulls;

/// <summary>
/// The convex hull of some points, or of the most important ones where it has too many vertices. Flat sets, segments and single points
/// have hulls as well.
/// </summary>
internal sealed class ConvexHull
{
    // As a part of the set's size: closer points count as on a facet.
    private const double CoplanarTolerance = 1e-12;

    // Shorter transformed normals have lost their direction to rounding.
    private const double MinNormalLength = 1e-30;

    private readonly HullFacet[] _facets;

    /// <summary>Makes a hull, and raises its planes so that rounding puts no vertex above them.</summary>
    /// <param name="vertices">The vertices, at least one.</param>
    /// <param name="planes">The planes of the facets by descending area, which are changed.</param>
    /// <param name="maxOutsideDistance">Upper bound of the distance of the points from the hull.</param>
    /// <param name="facets">The surface, or what a flat hull, a segment or a point has of it.</param>
    public ConvexHull(Vector[] vertices, HullPlane[] planes, double maxOutsideDistance, HullFacet[] facets)
    {
        Vertices = vertices;
        Planes = planes;
        MaxOutsideDistance = maxOutsideDistance;
        _facets = facets;
        for (var i = 0; i < planes.Length; i++)
        {
            var (normal, offset, area) = planes[i];
            planes[i] = new(normal, Math.Max(offset, Support(normal)), area);
        }
    }

    /// <summary>The vertices, which are some of the points.</summary>
    public Vector[] Vertices { get; }

    /// <summary>The planes of the facets by descending area; the hull lies below each. None for a segment or a point.</summary>
    public HullPlane[] Planes { get; }

    /// <summary>Upper bound of the distance of the points from the hull of <see cref="Vertices"/>.</summary>
    public double MaxOutsideDistance { get; }

    /// <summary>Builds the hull of some points.</summary>
    /// <param name="points">At least one point, all of them finite. Neither kept nor copied: wide sets have millions.</param>
    /// <param name="maxVertices">Maximum number of vertices, at least 4. Beyond it, points near the hull are left outside.</param>
    public static ConvexHull Build(Vector[] points, int maxVertices) => Build(points, points.Length, maxVertices);

    /// <summary>Builds the hull of the first points of an array, which may be larger.</summary>
    /// <param name="array">Begins with the points, all of them finite. It is not kept.</param>
    /// <param name="count">Number of points, at least one.</param>
    /// <param name="maxVertices">Maximum number of vertices, at least 4. Beyond it, points near the hull are left outside.</param>
    public static ConvexHull Build(Vector[] array, int count, int maxVertices)
    {
        var points = array.AsSpan(0, count);
        var box = BoundingBox.Around(points);
        // Far from the origin, coordinates are rounded by more than a part of the size.
        var largest = box.MaxAbsCoordinate();
        var tolerance = Math.Max(CoplanarTolerance * box.Diagonal, RoundingErrors.Chain * largest);
        var (i0, i1) = FindFarthestPair(points);
        if (points[i0] == points[i1])
        {
            return new([points[i0]], [], 0, [new(points[i0], points[i0], points[i0])]);
        }

        var direction = (points[i1] - points[i0]).UnitVector();
        var i2 = FindFarthest(points, points[i0], (point, origin) => Vector.Cross(direction, point - origin).Length(), out var width);
        if (!(width > tolerance))
        {
            return new([points[i0], points[i1]], [], width, [new(points[i0], points[i1], points[i1])]);
        }

        var normal = TriangleKernel.UnitNormal(points[i0], points[i1], points[i2]);
        var i3 = FindFarthest(points, points[i0], (point, origin) => Math.Abs(Vector.Dot(normal, point - origin)), out var height);
        return height > tolerance
            ? new QuickHull(array, count, tolerance, RoundingErrors.Norm * largest).Build(i0, i1, i2, i3, maxVertices)
            : FlatHull.Build(points, direction, normal, height, maxVertices);
    }

    /// <summary>
    /// Computes the hull's image under a map, which is the hull of the images. The points lie outside it by up to this hull's
    /// <see cref="MaxOutsideDistance"/> times the factor by which the map lengthens vectors, and that of the image besides.
    /// </summary>
    public ConvexHull Transform(AffineMap map)
    {
        // Normals transform by the cofactors; a mirror turns them inside out. Their lengths don't matter, but must not underflow.
        var linear = (1 / map.Linear.MaxAbsEntry()) * map.Linear;
        var normalMatrix = linear.Cofactors();
        var orientation = linear.Determinant() < 0 ? -1 : 1;
        var vertices = Array.ConvertAll(Vertices, vertex => map * vertex);
        var planes = new HullPlane[Planes.Length];
        for (var i = 0; i < planes.Length; i++)
        {
            var normal = orientation * (normalMatrix * Planes[i].Normal);
            if (!(normal.MaxAbsComponent() is > MinNormalLength and < double.PositiveInfinity))
            {
                // The map flattens the hull, or shrinks it to a segment or a point.
                return Build(vertices, Math.Max(4, vertices.Length));
            }

            planes[i] = new(normal.UnitVector(), double.NegativeInfinity, Planes[i].DoubledArea);
        }

        return new(
            vertices, planes, 0, Array.ConvertAll(_facets, facet => new HullFacet(map * facet.A, map * facet.B, map * facet.C)));
    }

    /// <summary>The triangles of the surface, wound outwards unless the hull is flat.</summary>
    public IEnumerable<(Vector A, Vector B, Vector C)> Triangles => _facets.Select(static facet => (facet.A, facet.B, facet.C));

    /// <summary>Computes the volume in cubic scene units; 0 where the hull is flat.</summary>
    public double Volume() => Math.Abs(_facets.Sum(
        facet => Vector.Dot(facet.A - Vertices[0], Vector.Cross(facet.B - Vertices[0], facet.C - Vertices[0])))) / 6;

    /// <summary>Computes the support of the hull: the largest product of a direction with a vertex.</summary>
    public double Support(Vector direction)
    {
        var maxProduct = double.NegativeInfinity;
        foreach (var vertex in Vertices)
        {
            maxProduct = Math.Max(maxProduct, Vector.Dot(direction, vertex));
        }

        return maxProduct;
    }

    /// <summary>Computes an upper bound of a point's distance from the solid hull; 0 inside.</summary>
    /// <param name="point">The point.</param>
    /// <param name="cutoff">The method may return early any bound that is no larger than this.</param>
    public double DistanceUpperBound(Vector point, double cutoff = 0)
    {
        if (Planes.Length > 0 && IsBelowAllPlanes(point))
        {
            return 0;
        }

        var distanceSquared = double.PositiveInfinity;
        foreach (var (a, b, c) in _facets)
        {
            distanceSquared = Math.Min(distanceSquared, TriangleKernel.ClosestPoint(point, a, b, c).DistanceSquared);
            if (Math.Sqrt(distanceSquared) <= cutoff)
            {
                break;
            }
        }

        return Math.Sqrt(distanceSquared);
    }

    private bool IsBelowAllPlanes(Vector point)
    {
        foreach (ref readonly var plane in Planes.AsSpan())
        {
            if (!(Vector.Dot(plane.Normal, point) <= plane.Offset))
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>Finds the farthest two of the points with the smallest and largest coordinates.</summary>
    private static (int First, int Second) FindFarthestPair(ReadOnlySpan<Vector> points)
    {
        Span<int> extremes = stackalloc int[6];
        for (var i = 1; i < points.Length; i++)
        {
            for (var axis = 0; axis < 3; axis++)
            {
                var coordinate = points[i].Component(axis);
                extremes[axis] = coordinate < points[extremes[axis]].Component(axis) ? i : extremes[axis];
                extremes[3 + axis] = coordinate > points[extremes[3 + axis]].Component(axis) ? i : extremes[3 + axis];
            }
        }

        var first = 0;
        var second = 0;
        var maxDistanceSquared = 0.0;
        foreach (var i in extremes)
        {
            foreach (var j in extremes)
            {
                var distanceSquared = (points[i] - points[j]).LengthSquared();
                if (distanceSquared > maxDistanceSquared)
                {
                    first = i;
                    second = j;
                    maxDistanceSquared = distanceSquared;
                }
            }
        }

        return (first, second);
    }

    /// <summary>Finds the first point with the largest measure.</summary>
    private static int FindFarthest(
        ReadOnlySpan<Vector> points, Vector origin, Func<Vector, Vector, double> measure, out double maxDistance)
    {
        var farthest = 0;
        maxDistance = 0;
        for (var i = 0; i < points.Length; i++)
        {
            var distance = measure(points[i], origin);
            if (distance > maxDistance)
            {
                farthest = i;
                maxDistance = distance;
            }
        }

        return farthest;
    }
}
