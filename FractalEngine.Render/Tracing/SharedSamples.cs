using System.Numerics;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Render.Tracing;

/// <summary>Sums of samples and of their first hits, each shared by the up to four pixels whose tent filters reach it.</summary>
/// <remarks>
/// The tents of all pixels add up to 1 everywhere, so that together their samples lie equally densely. Weighed by the height of its tent,
/// a pixel profits from those of its neighbours: 36 instead of 16 count fully. What the image converges to is the same.
/// </remarks>
/// <param name="width">Pixels.</param>
/// <param name="height">Pixels.</param>
/// <param name="viewport">The part that has samples.</param>
internal sealed class SharedSamples(int width, int height, (int X, int Y, int Width, int Height) viewport)
{
    /// <summary>Later samples are ignored: noise is invisible by then, and sums in single precision get worse.</summary>
    public const int MaxCount = 4096;

    private const int Stride = 5;

    // Squares of brighter light leave the range; everything is white long before.
    private const double MaxRadiance = 1e12;

    // Of each pixel: reflected light and weight, emitted light and distance, albedo and weight of the first half, normal, and reflected
    // light of the first half.
    private readonly Vector4[] _sums = new Vector4[Stride * width * height];

    /// <summary>The part of the image that has samples.</summary>
    public (int X, int Y, int Width, int Height) Viewport => viewport;

    /// <summary>Adds a sample. Threads may do so at once in rows that are three apart.</summary>
    /// <param name="x">Pixel that the sample was made for, from the left.</param>
    /// <param name="y">From the top.</param>
    /// <param name="sample">Index of the sample.</param>
    /// <param name="across">Where it is, from the middle of the pixel, from −1 to 1.</param>
    /// <param name="down">Likewise, downwards.</param>
    /// <param name="radiance">Its light.</param>
    /// <param name="first">What its path has met first.</param>
    public void Add(int x, int y, int sample, double across, double down, Vector radiance, in FirstHit first)
    {
        if (sample >= MaxCount)
        {
            return;
        }

        var (otherX, otherY) = (x + Math.Sign(across), y + Math.Sign(down));
        var shareX = otherX < viewport.X || otherX >= viewport.X + viewport.Width ? 0 : (float)Math.Abs(across);
        var shareY = otherY < viewport.Y || otherY >= viewport.Y + viewport.Height ? 0 : (float)Math.Abs(down);
        var half = IsOfFirstHalf(sample) ? 1f : 0f;
        var reflected = ToVector4(radiance - first.Emitted, 1);
        var emitted = ToVector4(first.Emitted, (float)first.Distance);
        var albedo = ToVector4(first.Albedo, half);
        var normal = ToVector4(first.Normal, 0);
        AddRow(y, 1 - shareY);
        AddRow(otherY, shareY);

        void AddRow(int row, float weight)
        {
            if (weight > 0)
            {
                AddTo((row * width) + x, weight * (1 - shareX));
                AddTo((row * width) + otherX, weight * shareX);
            }
        }

        void AddTo(int pixel, float weight)
        {
            if (weight > 0)
            {
                var sums = _sums.AsSpan(Stride * pixel, Stride);
                sums[0] += weight * reflected;
                sums[1] += weight * emitted;
                sums[2] += weight * albedo;
                sums[3] += weight * normal;
                sums[4] += weight * half * reflected;
            }
        }
    }

    /// <summary>Reads the weighted means of a pixel; all are zero where it has no samples.</summary>
    /// <param name="x">From the left.</param>
    /// <param name="y">From the top.</param>
    /// <param name="reflected">Light that surfaces reflect.</param>
    /// <param name="emitted">Light that comes unreflected, and in W the distance.</param>
    /// <param name="albedo">Albedo.</param>
    /// <param name="normal">Mean of the normals, in general no unit vector.</param>
    /// <returns>The variance of the reflected light.</returns>
    public Vector4 Read(int x, int y, out Vector4 reflected, out Vector4 emitted, out Vector4 albedo, out Vector4 normal)
    {
        var sums = _sums.AsSpan(Stride * ((y * width) + x), Stride);
        var weight = sums[0].W;
        var scale = weight > 0 ? 1 / weight : 0;
        (reflected, emitted, albedo, normal) = (scale * sums[0], scale * sums[1], scale * sums[2], scale * sums[3]);
        var share = albedo.W;
        // The halves are independent: their difference has the variance σ²/a + σ²/b, the mean of both σ²/(a + b).
        var difference = (scale * sums[4]) - (share * reflected);
        return share is > 0 and < 1 ? difference * difference / (share * (1 - share)) : Vector4.Zero;
    }

    // Runs of a power of two samples are spread evenly, so the halves are made of such: then they differ as little as the images do.
    private static bool IsOfFirstHalf(int sample) =>
        sample < 2 ? sample == 0 : ((sample >> (BitOperations.Log2((uint)sample) - 1)) & 1) == 1;

    private static Vector4 ToVector4(Vector v, float w) => new(Limit(v.X), Limit(v.Y), Limit(v.Z), w);

    private static float Limit(double value) => (float)Math.Clamp(value, -MaxRadiance, MaxRadiance);
}
