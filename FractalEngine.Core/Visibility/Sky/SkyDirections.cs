using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Sky;

/// <summary>The 64 directions in which a mask tells whether the sky is free, evenly spread over the sphere.</summary>
internal static class SkyDirections
{
    /// <summary>Number of directions, one for each bit of a mask.</summary>
    public const int Count = 64;

    private const int Lanes = 8;

    private static readonly Vector[] Directions = [.. Enumerable.Range(0, Count).Select(Spiral)];

    // x of all directions, then y, then z: [3 × 64].
    private static readonly float[] Components =
    [
        .. Directions.Select(static direction => (float)direction.X), .. Directions.Select(static direction => (float)direction.Y),
        .. Directions.Select(static direction => (float)direction.Z),
    ];

    // For each side, the part of the light that comes from each direction: [6 × 64].
    private static readonly float[] Weights = [.. Enumerable.Range(0, AmbientCube.Count).SelectMany(WeightsOf)];

    /// <summary>Returns the direction that belongs to a bit.</summary>
    /// <param name="index">Index of its bit.</param>
    public static Vector At(int index) => Directions[index];

    /// <summary>Returns the directions above a surface.</summary>
    public static ulong Above(Vector normal)
    {
        var above = 0ul;
        for (var i = 0; i < Count; i++)
        {
            above |= Vector.Dot(Directions[i], normal) > 0 ? 1ul << i : 0;
        }

        return above;
    }

    /// <summary>Finds the direction closest to a vector.</summary>
    public static int Nearest(Vector direction)
    {
        var best = 0;
        for (var i = 1; i < Count; i++)
        {
            best = Vector.Dot(Directions[i], direction) > Vector.Dot(Directions[best], direction) ? i : best;
        }

        return best;
    }

    /// <summary>Tells whether a map keeps all directions, up to rounding: it only scales, evenly.</summary>
    public static bool AreParallel(Matrix linear)
    {
        const double Tolerance = 1e-6;
        var scale = linear.MaxAbsEntry();
        return ((linear / scale) + (-linear.V1.X / scale * Matrix.Identity)).MaxAbsEntry() < Tolerance && linear.V1.X > 0;
    }

    /// <summary>Computes the part of an even sky's light that reaches a surface, from 0 to 1.</summary>
    /// <param name="mask">Directions in which the sky is free.</param>
    /// <param name="normal">Normal of the surface of any length: x, y, z, 0.</param>
    public static float VisiblePart(ulong mask, Vector256<double> normal)
    {
        // Only the direction matters, but squares and single precision would underflow.
        var (x, y, z) = (normal[0], normal[1], normal[2]);
        var scale = 1 / Math.Max(Math.Abs(x), Math.Max(Math.Abs(y), Math.Abs(z)));
        return VisiblePart(
            mask, Vector256.Create((float)(scale * x)), Vector256.Create((float)(scale * y)), Vector256.Create((float)(scale * z)));
    }

    /// <summary>Computes the part of an even sky's light that reaches a side, from 0 to 1.</summary>
    /// <param name="mask">Directions in which the sky is free.</param>
    /// <param name="side">Index of the side.</param>
    public static float VisiblePart(ulong mask, int side)
    {
        ref var weights = ref Weights[side * Count];
        var sum = Vector256<float>.Zero;
        for (nuint i = 0; i < Count; i += Lanes)
        {
            sum += Vector256.LoadUnsafe(ref weights, i) & LanesOf(mask >> (int)i);
        }

        return Vector256.Sum(sum);
    }

    private static float VisiblePart(ulong mask, Vector256<float> x, Vector256<float> y, Vector256<float> z)
    {
        ref var components = ref Components[0];
        var (sum, whole) = (Vector256<float>.Zero, Vector256<float>.Zero);
        for (nuint i = 0; i < Count; i += Lanes)
        {
            var cosine = (x * Vector256.LoadUnsafe(ref components, i)) + (y * Vector256.LoadUnsafe(ref components, i + Count))
                + (z * Vector256.LoadUnsafe(ref components, i + (2 * Count)));
            cosine = Vector256.Max(cosine, Vector256<float>.Zero);
            whole += cosine;
            sum += cosine & LanesOf(mask >> (int)i);
        }

        return Vector256.Sum(sum) / Vector256.Sum(whole);
    }

    /// <summary>Turns the lowest bits into lanes of ones or zeros.</summary>
    private static Vector256<float> LanesOf(ulong bits)
    {
        var bitOfLane = Vector256.Create(1, 2, 4, 8, 16, 32, 64, 128);
        return Vector256.Equals(Vector256.Create((int)bits) & bitOfLane, bitOfLane).AsSingle();
    }

    /// <summary>Points of a spiral from pole to pole, each as far from the last one as the golden angle.</summary>
    private static Vector Spiral(int index)
    {
        var z = 1 - ((2.0 * index) + 1) / Count;
        var radius = Math.Sqrt(1 - (z * z));
        var (sine, cosine) = Math.SinCos(index * Math.PI * (3 - Math.Sqrt(5)));
        return new(radius * cosine, z, radius * sine);
    }

    private static IEnumerable<float> WeightsOf(int side)
    {
        var normal = AmbientCube.NormalOf(side);
        var whole = Directions.Sum(direction => Math.Max(0, Vector.Dot(direction, normal)));
        return Directions.Select(direction => (float)(Math.Max(0, Vector.Dot(direction, normal)) / whole));
    }
}
