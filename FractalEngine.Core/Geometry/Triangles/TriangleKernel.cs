using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Triangles;

/// <summary>
/// Finds the closest point of one triangle (paper §4.4.2): in its plane where the foot of the perpendicular lies inside, else on the
/// closest of its three edges. It is the reference for every faster form.
/// </summary>
/// <remarks>
/// The plane is used only where all three barycentric weights are finite and not negative. The edges are tested in every case, and the
/// closest point wins. So needles, slivers and triangles without area (a segment, a point) need no special case, and no branch can lead
/// to NaN. Up to six coordinates are multiplied: from 1e-50 to 1e50, all products stay within a double.
/// <para>
/// Differs from §4.4.2: the paper's printed formula names one edge; its text means all three, and one alone is wrong in 45 % of
/// random cases.
/// </para>
/// </remarks>
public static class TriangleKernel
{
    /// <summary>
    /// Squared sine of the angle at the first vertex below which a triangle counts as thin. The rounding of its normal, 1e-16 divided by
    /// the sine, moves the foot of the perpendicular by as much of the triangle's size. At a sine of 1e-3 that is a tenth of the promised
    /// 1e-12.
    /// </summary>
    internal const double ThinTriangleSineSquared = 1e-6;

    /// <summary>Finds the point of the triangle abc that is closest to a position. Cost: about 100 flops, no allocation.</summary>
    /// <param name="position">In the frame of the triangle, scene units.</param>
    /// <param name="a">The first vertex of the triangle.</param>
    /// <param name="b">The second vertex of the triangle.</param>
    /// <param name="c">The third vertex of the triangle.</param>
    public static TrianglePoint ClosestPoint(Vector position, Vector a, Vector b, Vector c)
    {
        // The parts of a result are selected and joined in the end: to copy whole results takes longer than to compute them.
        var (distanceSquared, t, point) = ClosestPointOnEdge(position, a, b);
        var edge = 0;
        var (distanceSquaredBC, tBC, pointBC) = ClosestPointOnEdge(position, b, c);
        if (distanceSquaredBC < distanceSquared)
        {
            distanceSquared = distanceSquaredBC;
            t = tBC;
            point = pointBC;
            edge = 1;
        }

        var (distanceSquaredCA, tCA, pointCA) = ClosestPointOnEdge(position, c, a);
        if (distanceSquaredCA < distanceSquared)
        {
            distanceSquared = distanceSquaredCA;
            t = tCA;
            point = pointCA;
            edge = 2;
        }

        return TryProjectToInterior(position, a, b, c, out var foot, out var heightSquared, out var barycentrics)
            && heightSquared <= distanceSquared
            ? new(foot, heightSquared, barycentrics, TriangleFeature.Interior)
            : new(point, distanceSquared, EdgeBarycentrics(edge, t), FeatureOf(edge, t));
    }

    /// <summary>Computes the normal of length 1 by the winding: the direction of <c>Cross(b − a, c − a)</c>. Never NaN.</summary>
    /// <param name="a">The first vertex of the triangle.</param>
    /// <param name="b">The second vertex of the triangle.</param>
    /// <param name="c">The third vertex of the triangle.</param>
    /// <remarks>
    /// A triangle without area, or with so little that rounding hides its direction (a sine of 1e-14), has no normal. Then the result is
    /// perpendicular to its longest edge where it has one, else straight up.
    /// </remarks>
    public static Vector UnitNormal(Vector a, Vector b, Vector c)
    {
        var ab = b - a;
        var ac = c - a;
        var normal = Vector.Cross(ab, ac);
        var lengthSquared = normal.LengthSquared();
        // The square is within the range of a double, and rounding moves the normal by no more than 1e-10.
        var minLengthSquared = ThinTriangleSineSquared * ThinTriangleSineSquared * (ab.LengthSquared() * ac.LengthSquared());
        return lengthSquared is > 1e-280 and < 1e280 && lengthSquared > minLengthSquared
            ? normal / Math.Sqrt(lengthSquared)
            : UnitNormalOfThinTriangle(ab, ac, c - b);
    }

    private static Vector UnitNormalOfThinTriangle(Vector ab, Vector ac, Vector bc)
    {
        var (lengthAB, lengthAC, lengthBC) = (ab.MaxAbsComponent(), ac.MaxAbsComponent(), bc.MaxAbsComponent());
        var longest = Math.Max(lengthAB, Math.Max(lengthAC, lengthBC));
        if (!(longest > 0))
        {
            return Vector.J;
        }

        // The scale is a power of two, so that parallel edges stay parallel; in two steps, since the factor may be too large for one.
        var exponent = -Math.ILogB(longest);
        var scale1 = Math.ScaleB(1, exponent / 2);
        var scale2 = Math.ScaleB(1, exponent - (exponent / 2));
        var edge = scale1 * (scale2 * (lengthAB >= longest ? ab : lengthAC >= longest ? ac : bc));
        edge = edge.UnitVector();
        // Every pair of edges has the same cross product; the shorter two round least relative to what they span.
        var normal = lengthAB >= longest ? Vector.Cross(ac * scale1 * scale2, bc * scale1 * scale2)
            : lengthAC >= longest ? Vector.Cross(ab * scale1 * scale2, bc * scale1 * scale2)
            : Vector.Cross(ab * scale1 * scale2, ac * scale1 * scale2);
        normal -= Vector.Dot(normal, edge) * edge;
        var (x, y, z) = edge.Absolute();
        var shorter = scale1 * scale2 * Math.Min(lengthAB, Math.Min(lengthAC, lengthBC));
        return normal.MaxAbsComponent() > 1e-14 * shorter
            ? normal.UnitVector()
            : Vector.Cross(edge, x <= y && x <= z ? Vector.I : y <= z ? Vector.J : Vector.K).UnitVector();
    }

    /// <summary>Projects a position onto the triangle's plane.</summary>
    /// <returns>True when the foot of the perpendicular is inside the triangle.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static bool TryProjectToInterior(
        Vector position, Vector a, Vector b, Vector c, out Vector foot, out double heightSquared, out Vector barycentrics)
    {
        var ab = b - a;
        var ac = c - a;
        var ap = position - a;
        var normal = Vector.Cross(ab, ac);
        var normalSquared = normal.LengthSquared();
        var weightC = Vector.Dot(Vector.Cross(ab, ap), normal) / normalSquared;
        var weightB = Vector.Dot(Vector.Cross(ap, ac), normal) / normalSquared;
        var isThin = !(normalSquared > ThinTriangleSineSquared * (ab.LengthSquared() * (a - c).LengthSquared()));
        if (isThin)
        {
            // Each iteration starts from the foot of the last one, and reduces the error by the same factor. After three, a triangle that
            // is still wrong is so narrow that its edges are close enough.
            for (var iteration = 0; iteration < 3; iteration++)
            {
                var residual = position - (a + (weightB * ab) + (weightC * ac));
                weightC += Vector.Dot(Vector.Cross(ab, residual), normal) / normalSquared;
                weightB += Vector.Dot(Vector.Cross(residual, ac), normal) / normalSquared;
            }
        }

        var weightA = 1 - weightB - weightC;
        barycentrics = new(weightA, weightB, weightC);
        foot = a + (weightB * ab) + (weightC * ac);
        // The foot is rounded to the coordinates' last place; the height above the plane is not. But a thin triangle's normal may point
        // anywhere, and there the distance to a point of the triangle can't be too small.
        var height = Vector.Dot(ap, normal);
        heightSquared = isThin ? (position - foot).LengthSquared() : height * height / normalSquared;
        // Also false for NaN, which a triangle without area gives.
        return weightA >= 0 && weightB >= 0 && weightC >= 0;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static (double DistanceSquared, double T, Vector Point) ClosestPointOnEdge(Vector position, Vector start, Vector end)
    {
        var edge = end - start;
        var fromStart = position - start;
        var lengthSquared = edge.LengthSquared();
        // An edge without length consists of its start.
        var t = lengthSquared > 0 ? Vector.Dot(fromStart, edge) / lengthSquared : 0;
        t = t <= 0 ? 0 : t >= 1 ? 1 : t;
        var point = t == 1 ? end : start + (t * edge);
        return ((position - point).LengthSquared(), t, point);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector EdgeBarycentrics(int edge, double t) => edge switch
    {
        0 => new(1 - t, t, 0),
        1 => new(0, 1 - t, t),
        _ => new(t, 0, 1 - t),
    };

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static TriangleFeature FeatureOf(int edge, double t) => t switch
    {
        0 => TriangleFeature.VertexA + edge,
        1 => TriangleFeature.VertexA + ((edge + 1) % 3),
        _ => TriangleFeature.EdgeAB + edge,
    };
}
