using System.Numerics;
using FractalEngine.Benchmarks.Precision;
using FractalEngine.Tests.Support;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>
/// Squared distances that prove themselves by the Karush-Kuhn-Tucker conditions. A point q is the point of a convex hull closest to p if and
/// only if q is in the hull and (p − q)·(x − q) ≤ 0 for every vertex x. Candidates come from the normal equations of each feature. Whichever
/// passes is right, however it was found. Coordinates are integers times a common power of two.
/// </summary>
/// <remarks>It stays apart from the two that it checks: <c>ExactDistance</c> and, through that, <c>ExactTriangleDistance</c>.</remarks>
internal static class KktDistanceOracle
{
    /// <summary>Computes the squared distance of a position from a triangle that has an area.</summary>
    public static Rational SquaredToTriangle(Vector position, Vector a, Vector b, Vector c)
    {
        var scale = Scale(position, a, b, c);
        var (p, x, y, z) = (Point.Of(position, scale), Point.Of(a, scale), Point.Of(b, scale), Point.Of(c, scale));
        Candidate[] candidates =
        [
            new(1, x), new(1, y), new(1, z), ClosestOnEdge(p, x, y), ClosestOnEdge(p, y, z), ClosestOnEdge(p, z, x),
            ClosestOnPlane(p, x, y, z),
        ];
        return FirstOptimal(p, candidates, [x, y, z], scale);
    }

    /// <summary>Computes the squared distance of a position from a box.</summary>
    public static Rational SquaredToBox(Vector position, Vector minimum, Vector maximum)
    {
        var scale = Scale(position, minimum, maximum);
        var (p, low, high) = (Point.Of(position, scale), Point.Of(minimum, scale), Point.Of(maximum, scale));
        var candidates =
            from qx in new[] { low.X, p.X, high.X }
            where qx >= low.X && qx <= high.X
            from qy in new[] { low.Y, p.Y, high.Y }
            where qy >= low.Y && qy <= high.Y
            from qz in new[] { low.Z, p.Z, high.Z }
            where qz >= low.Z && qz <= high.Z
            select new Candidate(1, new(qx, qy, qz));
        Point[] corners =
        [
            .. from i in Enumerable.Range(0, 8)
               select new Point((i & 1) == 0 ? low.X : high.X, (i & 2) == 0 ? low.Y : high.Y, (i & 4) == 0 ? low.Z : high.Z),
        ];
        return FirstOptimal(p, candidates, corners, scale);
    }

    private static Rational FirstOptimal(Point p, IEnumerable<Candidate> candidates, Point[] corners, int scale)
    {
        var (divisor, q) = candidates.First(candidate => candidate.Divisor.Sign > 0 && corners.All(corner => IsBeyond(candidate, corner)));
        var offset = (divisor * p) - q;
        var (numerator, denominator) = (Point.Dot(offset, offset), divisor * divisor);
        return scale >= 0 ? new(numerator << (2 * scale), denominator) : new(numerator, denominator << (-2 * scale));

        bool IsBeyond(Candidate candidate, Point corner) =>
            Point.Dot((candidate.Divisor * p) - candidate.Point, (candidate.Divisor * corner) - candidate.Point).Sign <= 0;
    }

    /// <summary>Finds the foot of the perpendicular, with divisor 0 where it is not on the edge.</summary>
    private static Candidate ClosestOnEdge(Point p, Point start, Point end)
    {
        var along = end - start;
        var (t, length) = (Point.Dot(p - start, along), Point.Dot(along, along));
        return t.Sign < 0 || t > length ? default : new(length, ((length - t) * start) + (t * end));
    }

    /// <summary>Finds the foot in the plane. The two barycentrics solve the equations of Gram's matrix.</summary>
    private static Candidate ClosestOnPlane(Point p, Point a, Point b, Point c)
    {
        var (ab, ac, ap) = (b - a, c - a, p - a);
        var (bb, bc, cc, bp, cp) = (Point.Dot(ab, ab), Point.Dot(ab, ac), Point.Dot(ac, ac), Point.Dot(ab, ap), Point.Dot(ac, ap));
        var determinant = (bb * cc) - (bc * bc);
        var (u, v) = ((cc * bp) - (bc * cp), (bb * cp) - (bc * bp));
        return u.Sign < 0 || v.Sign < 0 || u + v > determinant
            ? default
            : new(determinant, ((determinant - u - v) * a) + (u * b) + (v * c));
    }

    private static int Scale(params Vector[] vectors) =>
        ScaledInteger.CommonExponent(vectors.SelectMany(v => new[] { v.X, v.Y, v.Z }));

    /// <summary>A point that has been multiplied by a divisor.</summary>
    private readonly record struct Candidate(BigInteger Divisor, Point Point);

    private readonly record struct Point(BigInteger X, BigInteger Y, BigInteger Z)
    {
        public static Point Of(Vector v, int scale) =>
            new(ScaledInteger.Of(v.X, scale), ScaledInteger.Of(v.Y, scale), ScaledInteger.Of(v.Z, scale));

        public static Point operator +(Point p, Point q) => new(p.X + q.X, p.Y + q.Y, p.Z + q.Z);

        public static Point operator -(Point p, Point q) => new(p.X - q.X, p.Y - q.Y, p.Z - q.Z);

        public static Point operator *(BigInteger factor, Point p) => new(factor * p.X, factor * p.Y, factor * p.Z);

        public static BigInteger Dot(Point p, Point q) => (p.X * q.X) + (p.Y * q.Y) + (p.Z * q.Z);
    }
}
