using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// The nearest point of one triangle (paper §4.4.2): its plane where the foot of the perpendicular lies inside, else the nearest of its
/// three edges. The reference for every faster form.
/// </summary>
/// <remarks>
/// The plane is used only where all three barycentric weights are finite and not negative, and the edges are looked at in every
/// case; the nearest wins. So needles, slivers and faces of no area at all (a segment, a point) need no special case, and no branch
/// can lead to NaN. Coordinates from 1e-30 to 1e30 keep all products within a double.
/// <para>
/// Differs from §4.4.2: the paper's printed formula names one edge; its text means all three, and one alone is wrong in 45 % of
/// random cases.
/// </para>
/// </remarks>
public static class TriangleKernel
{
    /// <summary>
    /// Squared sine of the first corner's angle below which a face counts as thin. The rounding of its normal, 1e-16 divided by the sine,
    /// moves the foot of the perpendicular by as much of the face's size: at a sine of 1e-3 that is a tenth of the 1e-12 that is promised.
    /// </summary>
    internal const double ThinTriangleSineSquared = 1e-6;

    /// <summary>The point of the triangle abc nearest to a position. Cost: about 100 flops, no allocation.</summary>
    public static TrianglePoint ClosestPoint(Vector position, Vector a, Vector b, Vector c)
    {
        // Parts of an answer are chosen and put together in the end: to copy whole answers takes longer than to compute them.
        var (distanceSquared, t, point) = ClosestPointOnEdge(position, a, b);
        var edge = 0;
        var (distanceSquaredBC, tBC, pointBC) = ClosestPointOnEdge(position, b, c);
        if (distanceSquaredBC < distanceSquared)
        {
            (distanceSquared, t, point, edge) = (distanceSquaredBC, tBC, pointBC, 1);
        }

        var (distanceSquaredCA, tCA, pointCA) = ClosestPointOnEdge(position, c, a);
        if (distanceSquaredCA < distanceSquared)
        {
            (distanceSquared, t, point, edge) = (distanceSquaredCA, tCA, pointCA, 2);
        }

        return TryProjectToInterior(position, a, b, c, out var foot, out var heightSquared, out var barycentrics)
            && heightSquared <= distanceSquared
            ? new(foot, heightSquared, barycentrics, TriangleFeature.Interior)
            : new(point, distanceSquared, EdgeBarycentrics(edge, t), FeatureOf(edge, t));
    }

    /// <summary>
    /// The unit normal by the winding, <c>Cross(b − a, c − a)</c>. A face without area, or with so little that rounding hides its
    /// direction (a sine of 1e-14), has none: then the result is perpendicular to its longest edge where it has one, else straight up.
    /// Never NaN.
    /// </summary>
    public static Vector UnitNormal(Vector a, Vector b, Vector c)
    {
        var (ab, ac) = (b - a, c - a);
        var normal = Vector.Cross(ab, ac);
        var lengthSquared = normal.LengthSquared();
        // Where the square did not leave the range of a double, and rounding moves the normal by no more than 1e-10.
        return lengthSquared is > 1e-280 and < 1e280 && lengthSquared > ThinTriangleSineSquared * ThinTriangleSineSquared
            * (ab.LengthSquared() * ac.LengthSquared())
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

        // By a power of two, so that edges of one direction keep it exactly; in two steps, since the factor may be too large for one.
        var exponent = -Math.ILogB(longest);
        var (scale1, scale2) = (Math.ScaleB(1, exponent / 2), Math.ScaleB(1, exponent - (exponent / 2)));
        var edge = scale1 * (scale2 * (lengthAB >= longest ? ab : lengthAC >= longest ? ac : bc));
        edge = edge.UnitVector();
        // The shorter two edges round least, relative to what they span: every pair has the same product.
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

    /// <summary>Sets the point where the perpendicular from the position meets the plane, if that is inside the triangle.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static bool TryProjectToInterior(
        Vector position, Vector a, Vector b, Vector c, out Vector foot, out double heightSquared, out Vector barycentrics)
    {
        var (ab, ac, ap) = (b - a, c - a, position - a);
        var normal = Vector.Cross(ab, ac);
        var normalSquared = normal.LengthSquared();
        var weightC = Vector.Dot(Vector.Cross(ab, ap), normal) / normalSquared;
        var weightB = Vector.Dot(Vector.Cross(ap, ac), normal) / normalSquared;
        var isThin = !(normalSquared > ThinTriangleSineSquared * (ab.LengthSquared() * (a - c).LengthSquared()));
        if (isThin)
        {
            // The same again from the foot, where the error is smaller by as much as the step before was wrong. Three times, since
            // a face too thin for that is so narrow that its edges are near enough.
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
        // The foot is rounded to the coordinates' last place; the height above the plane is not. But a thin face's normal may point
        // anywhere: there the distance to a point of the face can't be too small.
        var height = Vector.Dot(ap, normal);
        heightSquared = isThin ? (position - foot).LengthSquared() : height * height / normalSquared;
        // False for NaN too, which a face without area gives.
        return weightA >= 0 && weightB >= 0 && weightC >= 0;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static (double DistanceSquared, double T, Vector Point) ClosestPointOnEdge(Vector position, Vector start, Vector end)
    {
        var (edge, fromStart) = (end - start, position - start);
        var lengthSquared = edge.LengthSquared();
        // An edge without length has one point, its start.
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
