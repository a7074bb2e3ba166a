using System.Numerics;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Core.Visibility;

/// <summary>The 64 directions in which a mask tells whether the sky is free, evenly spread over the sphere.</summary>
internal static class SkyDirections
{
    /// <summary>Number of directions, one for each bit of a mask.</summary>
    public const int Count = 64;

    // The normals of the six sides come first, then one along each direction.
    private const int AxisNormals = SkySides.Count;

    private static readonly Vector[] Directions = [.. Enumerable.Range(0, Count).Select(Spiral)];

    // For each normal and each byte of a mask, the part of the light that its set bits let through: [normals × 8 × 256].
    private static readonly float[] Parts = ComputeParts();

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

    /// <summary>Finds the normal for which parts are known that is closest to a vector: its index.</summary>
    /// <param name="normal">Of any length: x, y, z, 0.</param>
    public static int NearestNormal(Vector256<double> normal)
    {
        const double NearlyOne = 1 - 1e-6;
        var side = SkySides.Of(normal);
        var component = normal[side % 3];
        return component * component > NearlyOne * Vector256.Dot(normal, normal)
            ? side
            : AxisNormals + Nearest(SimdAffineMap.ToVector(normal));
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
    /// <param name="normal">Index of the surface's normal.</param>
    public static float VisiblePart(ulong mask, int normal)
    {
        var table = Parts.AsSpan(normal * 8 * 256, 8 * 256);
        var sum = 0f;
        for (var i = 0; i < 8; i++)
        {
            sum += table[(i * 256) + (int)((mask >> (8 * i)) & 255)];
        }

        return sum;
    }

    /// <summary>Points of a spiral from pole to pole, each as far from the last one as the golden angle.</summary>
    private static Vector Spiral(int index)
    {
        var z = 1 - ((2.0 * index) + 1) / Count;
        var radius = Math.Sqrt(1 - (z * z));
        var (sine, cosine) = Math.SinCos(index * Math.PI * (3 - Math.Sqrt(5)));
        return new(radius * cosine, z, radius * sine);
    }

    private static float[] ComputeParts()
    {
        var parts = new float[(AxisNormals + Count) * 8 * 256];
        for (var normal = 0; normal < AxisNormals + Count; normal++)
        {
            var unit = normal >= AxisNormals ? Directions[normal - AxisNormals] : SkySides.NormalOf(normal);
            var whole = Directions.Sum(direction => Math.Max(0, Vector.Dot(direction, unit)));
            for (var i = 0; i < 8; i++)
            {
                for (var bits = 0; bits < 256; bits++)
                {
                    var sum = 0.0;
                    for (var rest = bits; rest != 0; rest &= rest - 1)
                    {
                        sum += Math.Max(0, Vector.Dot(Directions[(8 * i) + BitOperations.TrailingZeroCount(rest)], unit));
                    }

                    parts[(((normal * 8) + i) * 256) + bits] = (float)(sum / whole);
                }
            }
        }

        return parts;
    }
}
