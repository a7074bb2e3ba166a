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
        if (!(Math.Min(weights.X, Math.Min(weights.Y, weights.Z)) >= 0))
        {
            // Outside by rounding: the nearest point of the triangle.
            weights = TriangleKernel.ClosestPoint(point, a, b, c).Barycentrics;
        }

        return new(distance, point, normal, Vector.Dot(normal, direction) < 0, weights, search.Face)
        {
            InstanceMap = map.ToAffineMap(),
        };
    }

    /// <summary>Computes the weights of the corners at a point in the plane of the triangle.</summary>
    /// <remarks>From the height above the longest edge and the place along it: so the weights give the point of a needle, too.</remarks>
    private static Vector Barycentrics(Vector point, Vector a, Vector b, Vector c)
    {
        var (ab, bc, ca) = ((b - a).MaxAbsComponent(), (c - b).MaxAbsComponent(), (a - c).MaxAbsComponent());
        if (bc > ab && bc >= ca)
        {
            var (weightB, weightC, weightA) = WeightsAboveEdge(point, b, c, a, bc);
            return new(weightA, weightB, weightC);
        }

        if (ca > ab)
        {
            var (weightC, weightA, weightB) = WeightsAboveEdge(point, c, a, b, ca);
            return new(weightA, weightB, weightC);
        }

        return ab > 0 ? WeightsAboveEdge(point, a, b, c, ab) : Vector.I;
    }

    /// <summary>Computes the weights of an edge's ends and of the third corner, in units in which squares are accurate.</summary>
    private static Vector WeightsAboveEdge(Vector point, Vector start, Vector end, Vector apex, double size)
    {
        var (edge, toApex, toPoint) = ((end - start) / size, (apex - start) / size, (point - start) / size);
        var squared = edge.LengthSquared();
        var apexPlace = Vector.Dot(toApex, edge) / squared;
        // Twice, since what rounding leaves of the edge matters beside the altitude of a needle.
        var altitude = toApex - (apexPlace * edge);
        altitude -= Vector.Dot(altitude, edge) / squared * edge;
        var altitudeSquared = altitude.LengthSquared();
        var weightApex = altitudeSquared > 0 ? Vector.Dot(toPoint, altitude) / altitudeSquared : 0;
        var weightEnd = (Vector.Dot(toPoint, edge) / squared) - (weightApex * apexPlace);
        return new(1 - weightApex - weightEnd, weightEnd, weightApex);
    }
}
