using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>
/// Perlin's gradient noise (Improving Noise, SIGGRAPH 2002) with gradients hashed from a seed: smooth, about −1 to 1, zero at points
/// with whole coordinates, and without a direction or scale other than 1.
/// </summary>
internal sealed class GradientNoise(ulong seed)
{
    /// <summary>The noise at a point.</summary>
    public double At(double x, double y, double z)
    {
        var (ix, iy, iz) = (Math.Floor(x), Math.Floor(y), Math.Floor(z));
        var (fx, fy, fz) = (x - ix, y - iy, z - iz);
        var (cx, cy, cz) = ((long)ix, (long)iy, (long)iz);
        var (u, v, w) = (Fade(fx), Fade(fy), Fade(fz));
        return Lerp(
            Lerp(
                Lerp(CornerContribution(cx, cy, cz, fx, fy, fz), CornerContribution(cx + 1, cy, cz, fx - 1, fy, fz), u),
                Lerp(CornerContribution(cx, cy + 1, cz, fx, fy - 1, fz), CornerContribution(cx + 1, cy + 1, cz, fx - 1, fy - 1, fz), u),
                v),
            Lerp(
                Lerp(CornerContribution(cx, cy, cz + 1, fx, fy, fz - 1), CornerContribution(cx + 1, cy, cz + 1, fx - 1, fy, fz - 1), u),
                Lerp(CornerContribution(cx, cy + 1, cz + 1, fx, fy - 1, fz - 1),
                CornerContribution(cx + 1, cy + 1, cz + 1, fx - 1, fy - 1, fz - 1), u),
                v),
            w);
    }

    /// <summary>A sum of octaves, each at twice the frequency and half the strength of the one before.</summary>
    public double Octaves(Vector point, int count)
    {
        var (sum, strength) = (0.0, 1.0);
        for (var octave = 0; octave < count; octave++)
        {
            sum += strength * At(point.X, point.Y, point.Z);
            // The shift keeps the zeros of the octaves from falling on each other.
            (point, strength) = ((2 * point) + new Vector(17.3, 31.7, 5.9), 0.5 * strength);
        }

        return sum;
    }

    /// <summary>Octaves folded at zero, so that zeros become ridges: from 0 to about 2, highest on the ridges.</summary>
    public double Ridges(Vector point, int count)
    {
        var (sum, strength) = (0.0, 1.0);
        for (var octave = 0; octave < count; octave++)
        {
            var ridge = 1 - Math.Min(1, Math.Abs(At(point.X, point.Y, point.Z)) * 1.6);
            sum += strength * ridge * ridge;
            (point, strength) = ((2 * point) + new Vector(17.3, 31.7, 5.9), 0.5 * strength);
        }

        return sum;
    }

    private static double Fade(double t) => t * t * t * ((t * ((6 * t) - 15)) + 10);

    private static double Lerp(double a, double b, double t) => a + (t * (b - a));

    /// <summary>One of the twelve gradients that point to the middles of a cube's edges, times the way from the corner.</summary>
    private double CornerContribution(long x, long y, long z, double dx, double dy, double dz)
    {
        var hash = SplitMix64.Mix(seed ^ SplitMix64.Mix((ulong)x ^ SplitMix64.Mix((ulong)y ^ SplitMix64.Mix((ulong)z))));
        var (a, b) = (hash % 3) switch
        {
            0 => (dx, dy),
            1 => (dy, dz),
            _ => (dz, dx),
        };
        return ((hash & 4096) == 0 ? a : -a) + ((hash & 8192) == 0 ? b : -b);
    }
}
