using System.Numerics;
using FractalEngine.Tests.Support;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Colliders;

/// <summary>
/// The distance of a position from a triangle in exact arithmetic: coordinates are integers times a common power of two, distances are
/// fractions of integers, and only the last square root rounds. It shares nothing with the engine's kernel, and stays apart from
/// <c>ExactDistance</c> of the benchmarks, so that the two check each other.
/// </summary>
internal static class ExactTriangleDistance
{
    /// <summary>Computes the distance of a position from the triangle abc.</summary>
    public static double Distance(Vector position, Vector a, Vector b, Vector c)
    {
        var exponent = Exponent(position, a, b, c);
        var p = Point.Of(position, exponent);
        var p1 = Point.Of(a, exponent);
        var p2 = Point.Of(b, exponent);
        var p3 = Point.Of(c, exponent);
        var closest = Fraction.Min(SquaredToSegment(p, p1, p2), Fraction.Min(SquaredToSegment(p, p2, p3), SquaredToSegment(p, p3, p1)));
        var ab = p2 - p1;
        var ac = p3 - p1;
        var ap = p - p1;
        var normal = Point.Cross(ab, ac);
        var square = Point.Dot(normal, normal);
        var weightB = Point.Dot(Point.Cross(ap, ac), normal);
        var weightC = Point.Dot(Point.Cross(ab, ap), normal);
        if (!square.IsZero && weightB.Sign >= 0 && weightC.Sign >= 0 && weightB + weightC <= square)
        {
            closest = Fraction.Min(closest, new(BigInteger.Pow(Point.Dot(ap, normal), 2), square));
        }

        return closest.SquareRoot(exponent);
    }

    /// <summary>
    /// Computes the sine of a triangle's smallest angle: twice the area by the product of the two longest edges. 0 where there is no area.
    /// </summary>
    public static double SineOfSmallestAngle(Vector a, Vector b, Vector c)
    {
        var exponent = Exponent(a, b, c);
        var p1 = Point.Of(a, exponent);
        var p2 = Point.Of(b, exponent);
        var p3 = Point.Of(c, exponent);
        var normal = Point.Cross(p2 - p1, p3 - p1);
        BigInteger[] edges = [.. new[] { p2 - p1, p3 - p2, p1 - p3 }.Select(edge => Point.Dot(edge, edge)).Order()];
        return edges[1].IsZero ? 0 : new Fraction(Point.Dot(normal, normal), edges[1] * edges[2]).SquareRoot(0);
    }

    private static int Exponent(params ReadOnlySpan<Vector> vectors) =>
        ScaledInteger.CommonExponent(vectors.ToArray().SelectMany(v => new[] { v.X, v.Y, v.Z }));

    private static Fraction SquaredToSegment(Point p, Point start, Point end)
    {
        var along = end - start;
        var from = p - start;
        var square = Point.Dot(along, along);
        var dot = Point.Dot(along, from);
        return dot.Sign <= 0 ? new(Point.Dot(from, from), 1)
            : dot >= square ? new(Point.Dot(p - end, p - end), 1)
            : new((Point.Dot(from, from) * square) - (dot * dot), square);
    }

    private readonly record struct Fraction(BigInteger Numerator, BigInteger Denominator)
    {
        public static Fraction Min(Fraction f1, Fraction f2) =>
            f1.Numerator * f2.Denominator <= f2.Numerator * f1.Denominator ? f1 : f2;

        /// <summary>Computes the square root times a power of two.</summary>
        public double SquareRoot(int exponent)
        {
            if (Numerator.IsZero)
            {
                return 0;
            }

            // An even shift leaves 120 bits, so that the truncated rest is far below a double's last place.
            var shift = (120 - (int)(Numerator.GetBitLength() - Denominator.GetBitLength())) & ~1;
            var quotient = shift >= 0 ? (Numerator << shift) / Denominator : Numerator / (Denominator << -shift);
            return Math.ScaleB(Math.Sqrt((double)quotient), exponent - (shift / 2));
        }
    }

    private readonly record struct Point(BigInteger X, BigInteger Y, BigInteger Z)
    {
        public static Point Of(Vector v, int exponent) =>
            new(ScaledInteger.Of(v.X, exponent), ScaledInteger.Of(v.Y, exponent), ScaledInteger.Of(v.Z, exponent));

        public static Point operator -(Point p1, Point p2) => new(p1.X - p2.X, p1.Y - p2.Y, p1.Z - p2.Z);

        public static BigInteger Dot(Point p1, Point p2) => (p1.X * p2.X) + (p1.Y * p2.Y) + (p1.Z * p2.Z);

        public static Point Cross(Point p1, Point p2) =>
            new((p1.Y * p2.Z) - (p1.Z * p2.Y), (p1.Z * p2.X) - (p1.X * p2.Z), (p1.X * p2.Y) - (p1.Y * p2.X));
    }
}
