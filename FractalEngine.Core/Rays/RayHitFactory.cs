using FractalEngine.Core.Collision;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>Completes the nearest triangle of a search to the result of a query, in the frame of the ray.</summary>
internal static class RayHitFactory
{
    // Where a ray is closer to a triangle's plane than this, as a sine, the distance of the search is more accurate than the plane's.
    private const double MinSine = 1e-4;

    // Squared sine of the angle at the first corner below which the weights of the corners lose digits.
    private const double ThinSineSquared = 1e-2;

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
        var isThin = !(cross.LengthSquared() > ThinSineSquared * edgeB.LengthSquared() * edgeC.LengthSquared());
        if (Math.Abs(slope) > MinSine && size > 0)
        {
            var (anchor, planeNormal) = isThin ? PlaneOfThinTriangle(a, b, c, normal) : (a, normal);
            // From a point near the triangle, so that what a far origin rounds away does not count.
            distance += Vector.Dot(planeNormal, anchor - (origin + (distance * direction))) / Vector.Dot(planeNormal, direction);
        }

        distance = Math.Min(Math.Max(distance, minDistance), maxDistance);
        var point = origin + (distance * direction);
        var weights = Barycentrics((point - a) / size, edgeB, edgeC, cross);
        if (isThin)
        {
            // Either may be the better one: the weights lose digits across a needle, and edges leave out what is between them.
            var onEdge = TriangleKernel.ClosestPoint(point, a, b, c).Barycentrics;
            weights = Miss(weights) <= Miss(onEdge) ? weights : onEdge;
        }

        return new(distance, point, normal, slope < 0, weights, search.Face)
        {
            InstanceMap = map.ToAffineMap(),
        };

        double Miss(Vector weights) => ((weights.X * a) + (weights.Y * b) + (weights.Z * c) - point).LengthSquared();
    }

    /// <summary>
    /// Finds a corner and a normal of the plane of a thin triangle. Rounding may turn the plane about the longest edge, from which no point
    /// of the triangle is far; about other axes it must not.
    /// </summary>
    private static (Vector Corner, Vector Normal) PlaneOfThinTriangle(Vector a, Vector b, Vector c, Vector normal)
    {
        var (ab, bc, ca) = ((b - a).LengthSquared(), (c - b).LengthSquared(), (a - c).LengthSquared());
        var (corner, edge) = ab >= bc && ab >= ca ? (a, b - a) : bc >= ca ? (b, c - b) : (c, a - c);
        var direction = edge / edge.MaxAbsComponent();
        return (corner, normal - (Vector.Dot(normal, direction) / direction.LengthSquared() * direction));
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
