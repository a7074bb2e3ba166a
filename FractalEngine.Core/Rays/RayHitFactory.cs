using FractalEngine.Core.Collision;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>Completes the nearest triangle of a search to the result of a query, in the frame of the ray.</summary>
internal static class RayHitFactory
{
    // Where the plane of a triangle is uncertain, as that of a needle, the distance of the search is more accurate than the plane's. And
    // where a ray is closer to it than this, as a sine.
    private const double MinSine = 1e-4;

    /// <summary>Creates the result for a triangle.</summary>
    /// <param name="origin">Origin of the ray.</param>
    /// <param name="direction">Its direction, of length 1.</param>
    /// <param name="search">The search that found the triangle.</param>
    /// <param name="minDistance">Smallest distance of a result.</param>
    /// <param name="maxDistance">Largest distance of a result.</param>
    /// <param name="mesh">The mesh of the instance.</param>
    /// <param name="map">From the mesh's frame to that of the ray.</param>
    public static RayHit Create(
        Vector origin, Vector direction, in RaySearch search, double minDistance, double maxDistance,
        Mesh mesh, in SimdAffineMap map)
    {
        var distance = search.MaxDistance;
        var (a, b, c) = mesh.Face(search.Face);
        (a, b, c) = (map.Apply(a), map.Apply(b), map.Apply(c));
        // In units of the triangle, so that squares stay within the range of a double.
        var size = Math.Max((b - a).MaxAbsComponent(), (c - a).MaxAbsComponent());
        var (edgeB, edgeC) = size > 0 ? ((b - a) / size, (c - a) / size) : (Vector.Zero, Vector.Zero);
        var cross = Vector.Cross(edgeB, edgeC);
        var normal = TriangleKernel.UnitNormal(a, b, c);
        var slope = Vector.Dot(normal, direction);
        var isThin = !(cross.LengthSquared() > TriangleKernel.ThinTriangleSineSquared * edgeB.LengthSquared() * edgeC.LengthSquared());
        if (!isThin && Math.Abs(slope) > MinSine)
        {
            // From a point near the triangle, so that what a far origin rounds away does not count.
            distance += Vector.Dot(normal, a - (origin + (distance * direction))) / slope;
        }

        distance = Math.Min(Math.Max(distance, minDistance), maxDistance);
        var point = origin + (distance * direction);
        var weights = isThin
            ? TriangleKernel.ClosestPoint(point, a, b, c).Barycentrics
            : Barycentrics((point - a) / size, edgeB, edgeC, cross);
        return new(distance, point, normal, slope < 0, weights, search.Face)
        {
            InstanceMap = map.ToAffineMap(),
        };
    }

    /// <summary>Computes the weights of the corners at a point in the triangle, or at the nearest that rounding leaves.</summary>
    private static Vector Barycentrics(Vector fromA, Vector edgeB, Vector edgeC, Vector cross)
    {
        var squared = cross.LengthSquared();
        var weightB = Math.Clamp(Vector.Dot(Vector.Cross(fromA, edgeC), cross) / squared, 0, 1);
        var weightC = Math.Clamp(Vector.Dot(Vector.Cross(edgeB, fromA), cross) / squared, 0, 1 - weightB);
        return new(1 - weightB - weightC, weightB, weightC);
    }
}
