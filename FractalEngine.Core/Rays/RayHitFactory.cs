using System.Runtime.CompilerServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>Completes the nearest triangle of a search to the result of a query, in the frame of the ray.</summary>
internal static class RayHitFactory
{
    // How far off a triangle a point of it may be, in units of the rounding of a coordinate.
    private const double ErrorFactor = 8;

    /// <summary>Creates the result for a triangle.</summary>
    /// <param name="origin">Origin of the ray.</param>
    /// <param name="direction">Its direction, of length 1.</param>
    /// <param name="search">The search that found the triangle.</param>
    /// <param name="minDistance">Smallest distance of a result.</param>
    /// <param name="maxDistance">Largest distance of a result.</param>
    /// <param name="mesh">The mesh of the instance.</param>
    /// <param name="map">From the mesh's frame to that of the ray.</param>
    /// <param name="hit">Receives the result, which is large: returned, it would be copied once more.</param>
    /// <remarks>Not inlined: beside a search, the compiler has no room left for its many operations on vectors.</remarks>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Create(
        Vector origin, Vector direction, in RaySearch search, double minDistance, double maxDistance,
        Mesh mesh, in SimdAffineMap map, out RayHit hit)
    {
        var (a, b, c) = mesh.Face(search.Face);
        (a, b, c) = (map.Apply(a), map.Apply(b), map.Apply(c));
        var (ab, ac) = (b - a, c - a);
        var cross = Vector.Cross(ab, ac);
        var squared = cross.LengthSquared();
        var isWellShaped = TrianglePlane.IsWellShaped(ab, ac, squared);
        var normal = isWellShaped ? cross / Math.Sqrt(squared) : TriangleKernel.UnitNormal(a, b, c);
        var isSteep = TrianglePlane.IsSteep(direction, normal);
        var distance = !isSteep ? search.MaxDistance
            : isWellShaped ? TrianglePlane.Correct(origin, direction, search.MaxDistance, a, normal)
            : TrianglePlane.Correct(origin, direction, search.MaxDistance, a, b, c);
        var point = origin + (distance * direction);
        var weights = isWellShaped ? Barycentrics(point - a, ab, ac, cross, squared) : Barycentrics(point, a, b, c);
        if (!isSteep || !(Math.Min(weights.X, Math.Min(weights.Y, weights.Z)) >= 0))
        {
            (distance, weights) = NearestApproach(origin, direction, in search, distance, a, b, c);
        }

        if (!(distance >= minDistance && distance <= maxDistance))
        {
            distance = Math.Min(Math.Max(distance, minDistance), maxDistance);
            weights = TriangleKernel.ClosestPoint(origin + (distance * direction), a, b, c).Barycentrics;
        }

        point = origin + (distance * direction);
        hit = new(distance, point, normal, Vector.Dot(normal, direction) < 0, weights, search.Face)
        {
            InstanceMap = map.ToAffineMap(),
            Mesh = mesh,
            MeshIndex = search.MeshIndex,
        };
    }

    /// <summary>
    /// Finds where a ray that grazes a triangle, or passes beside it by rounding, is nearest to it: where the search has found it, where it
    /// crosses the plane, or where it passes an edge.
    /// </summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    private static (double Distance, Vector Weights) NearestApproach(
        Vector origin, Vector direction, in RaySearch search, double planeDistance, Vector a, Vector b, Vector c)
    {
        ReadOnlySpan<double> distances =
            [planeDistance, search.MaxDistance, TrianglePlane.ApproachEdges(origin, direction, a, b, c).Distance];
        var rounding = ErrorFactor * search.Error;
        var (best, weights, least) = (search.MaxDistance, Vector.I, double.PositiveInfinity);
        foreach (var distance in distances)
        {
            var point = origin + (distance * direction);
            var nearest = TriangleKernel.ClosestPoint(point, a, b, c);
            var apart = (nearest.Point - point).MaxAbsComponent();
            // What search has found goes before another place along the same edge.
            if (apart < least && least > rounding)
            {
                (best, weights, least) = (distance, nearest.Barycentrics, apart);
            }
        }

        return (best, weights);
    }

    /// <summary>Computes the weights of the corners at a point in the plane of a well-shaped triangle, as parts of its area.</summary>
    private static Vector Barycentrics(Vector fromA, Vector ab, Vector ac, Vector cross, double squared)
    {
        var weightB = Vector.Dot(Vector.Cross(fromA, ac), cross) / squared;
        var weightC = Vector.Dot(Vector.Cross(ab, fromA), cross) / squared;
        return new(1 - weightB - weightC, weightB, weightC);
    }

    /// <summary>Computes the weights of the corners at a point in the plane of any triangle.</summary>
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
