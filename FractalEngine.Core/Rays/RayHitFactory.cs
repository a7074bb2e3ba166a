using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>Completes the nearest triangle of a search to the result of a query, in the frame of the ray.</summary>
internal static class RayHitFactory
{
    // Where a ray is closer to a triangle's plane than this, as a sine, the distance of the search is more accurate than the plane's.
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
        var cross = Vector.Cross(b - a, c - a);
        var length = cross.Length();
        var normal = length > 0 ? cross / length : Vector.Zero;
        var slope = Vector.Dot(normal, direction);
        if (Math.Abs(slope) > MinSine)
        {
            // From a point near the triangle, so that what a far origin rounds away does not count.
            distance += Vector.Dot(normal, a - (origin + (distance * direction))) / slope;
        }

        distance = Math.Min(Math.Max(distance, minDistance), maxDistance);
        var point = origin + (distance * direction);
        return new(distance, point, normal, slope < 0, Barycentrics(point, a, b, c, cross), search.Face)
        {
            InstanceMap = map.ToAffineMap(),
        };
    }

    /// <summary>Computes the weights of the corners at a point in the triangle, or at the nearest that rounding leaves.</summary>
    private static Vector Barycentrics(Vector point, Vector a, Vector b, Vector c, Vector cross)
    {
        var squared = cross.LengthSquared();
        if (!(squared > 0))
        {
            return Vector.I;
        }

        var weightB = Math.Clamp(Vector.Dot(Vector.Cross(point - a, c - a), cross) / squared, 0, 1);
        var weightC = Math.Clamp(Vector.Dot(Vector.Cross(b - a, point - a), cross) / squared, 0, 1 - weightB);
        return new(1 - weightB - weightC, weightB, weightC);
    }
}
