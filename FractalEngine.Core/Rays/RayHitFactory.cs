using FractalEngine.Core.Collision;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>Completes the nearest triangle of a search to the result of a query, in the frame of the ray.</summary>
internal static class RayHitFactory
{
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
        var normal = TriangleKernel.UnitNormal(a, b, c);
        distance = TrianglePlane.Correct(origin, direction, distance, a, b, c);
        distance = Math.Min(Math.Max(distance, minDistance), maxDistance);
        var point = origin + (distance * direction);
        var weights = Barycentrics(point, a, b, c);
        if (TrianglePlane.IsThin(a, b, c))
        {
            // Either may be the better one: the weights lose digits across a needle, and edges leave out what is between them.
            var onEdge = TriangleKernel.ClosestPoint(point, a, b, c).Barycentrics;
            weights = Miss(weights) <= Miss(onEdge) ? weights : onEdge;
        }

        return new(distance, point, normal, Vector.Dot(normal, direction) < 0, weights, search.Face)
        {
            InstanceMap = map.ToAffineMap(),
        };

        double Miss(Vector weights) => ((weights.X * a) + (weights.Y * b) + (weights.Z * c) - point).LengthSquared();
    }

    /// <summary>Computes the weights of the corners at a point in the triangle, or at the nearest that rounding leaves.</summary>
    private static Vector Barycentrics(Vector point, Vector a, Vector b, Vector c)
    {
        // In units of the triangle, so that squares stay within the range of a double.
        var size = Math.Max((b - a).MaxAbsComponent(), (c - a).MaxAbsComponent());
        if (!(size > 0))
        {
            return Vector.I;
        }

        var (fromA, edgeB, edgeC) = ((point - a) / size, (b - a) / size, (c - a) / size);
        var cross = Vector.Cross(edgeB, edgeC);
        var squared = cross.LengthSquared();
        if (!(squared > 0))
        {
            return Vector.I;
        }

        var weightB = Math.Clamp(Vector.Dot(Vector.Cross(fromA, edgeC), cross) / squared, 0, 1);
        var weightC = Math.Clamp(Vector.Dot(Vector.Cross(edgeB, fromA), cross) / squared, 0, 1 - weightB);
        return new(1 - weightB - weightC, weightB, weightC);
    }
}
