using System.Numerics;
using FractalEngine.Core.Geometry;
using FractalEngine.Tests.Support;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Rays;

/// <summary>
/// A ray in exact arithmetic, by Plücker's test: on which side it passes an edge is the sign of a determinant of integers. Its origin, its
/// direction and all corners count as the doubles that they are; results are rounded once.
/// </summary>
internal sealed class ExactRay(Ray ray)
{
    private readonly int _exponent = ScaledInteger.CommonExponent(Coordinates(ray.Direction));

    /// <summary>Computes by how much the line of the ray passes to the left of a directed edge, as seen along the ray.</summary>
    /// <param name="start">Start of the edge.</param>
    /// <param name="end">Its end.</param>
    /// <returns>The distance of the two lines; negative on the right. The sign is exact.</returns>
    public double Side(Vector start, Vector end) => Apart(start, end, ray.Origin);

    /// <summary>Computes how far a point is to the left of a directed edge, as seen along the ray.</summary>
    /// <param name="start">Start of the edge.</param>
    /// <param name="end">Its end.</param>
    /// <param name="point">The point.</param>
    /// <returns>The distance across the ray; negative on the right. The sign is exact.</returns>
    public double Apart(Vector start, Vector end, Vector point)
    {
        var exponent = ScaledInteger.CommonExponent([.. Coordinates(start), .. Coordinates(end), .. Coordinates(point)]);
        var origin = Integers(start, exponent);
        var determinant = Dot(Integers(ray.Direction, _exponent), Cross(
            Subtract(Integers(end, exponent), origin), Subtract(Integers(point, exponent), origin)));
        var across = Vector.Cross(ray.Direction, end - start).Length();
        return across > 0 ? ScaledInteger.Quotient(determinant, 1, _exponent + (2 * exponent)) / across : 0;
    }

    /// <summary>Computes the distance at which the line of the ray crosses the plane of a triangle; NaN where it is parallel.</summary>
    public double Distance(Vector a, Vector b, Vector c)
    {
        var exponent = ScaledInteger.CommonExponent([.. Coordinates(a), .. Coordinates(b), .. Coordinates(c), .. Coordinates(ray.Origin)]);
        var corner = Integers(a, exponent);
        var normal = Cross(Subtract(Integers(b, exponent), corner), Subtract(Integers(c, exponent), corner));
        var height = Dot(normal, Subtract(corner, Integers(ray.Origin, exponent)));
        var slope = Dot(normal, Integers(ray.Direction, _exponent));
        return slope.IsZero ? double.NaN : ScaledInteger.Quotient(height, slope, exponent - _exponent) * ray.Direction.Length();
    }

    private static double[] Coordinates(Vector v) => [v.X, v.Y, v.Z];

    private static BigInteger[] Integers(Vector v, int exponent) =>
        [ScaledInteger.Of(v.X, exponent), ScaledInteger.Of(v.Y, exponent), ScaledInteger.Of(v.Z, exponent)];

    private static BigInteger[] Subtract(BigInteger[] a, BigInteger[] b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

    private static BigInteger Dot(BigInteger[] a, BigInteger[] b) => (a[0] * b[0]) + (a[1] * b[1]) + (a[2] * b[2]);

    private static BigInteger[] Cross(BigInteger[] a, BigInteger[] b) =>
        [(a[1] * b[2]) - (a[2] * b[1]), (a[2] * b[0]) - (a[0] * b[2]), (a[0] * b[1]) - (a[1] * b[0])];
}
