using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation.Building;

/// <summary>
/// Perlin's gradient noise ("Improving Noise", SIGGRAPH 2002) with gradients hashed from a seed.
/// </summary>
/// <remarks>
/// It is smooth, about −1 to 1, zero at points with whole coordinates, and has no preferred direction, and no scale other than 1.
/// </remarks>
/// <param name="seed">The same seed gives the same noise.</param>
internal sealed class GradientNoise(ulong seed)
{
    /// <summary>Computes the noise at a point.</summary>
    public double At(double x, double y, double z)
    {
        var (ix, iy, iz) = (Math.Floor(x), Math.Floor(y), Math.Floor(z));
        var (fx, fy, fz) = (x - ix, y - iy, z - iz);
        var (cx, cy, cz) = ((long)ix, (long)iy, (long)iz);
        var (u, v, w) = (Fade(fx), Fade(fy), Fade(fz));
        return Lerp(Lerp(Edge(0, 0), Edge(1, 0), v), Lerp(Edge(0, 1), Edge(1, 1), v), w);

        // Interpolates along the edge of the cell with the given offsets in y and z.
        double Edge(int j, int k) => Lerp(
            CornerContribution(cx, cy + j, cz + k, fx, fy - j, fz - k),
            CornerContribution(cx + 1, cy + j, cz + k, fx - 1, fy - j, fz - k),
            u);
    }

    /// <summary>Sums octaves, each at twice the frequency and half the strength of the one before.</summary>
    public double Octaves(Vector point, int count)
    {
        var sum = 0.0;
        var strength = 1.0;
        for (var octave = 0; octave < count; octave++)
        {
            sum += strength * At(point.X, point.Y, point.Z);
            point = NextOctave(point);
            strength *= 0.5;
        }

        return sum;
    }

    /// <summary>Sums octaves folded at zero, so that zeros become ridges: from 0 to about 2, highest on the ridges.</summary>
    public double Ridges(Vector point, int count)
    {
        var sum = 0.0;
        var strength = 1.0;
        for (var octave = 0; octave < count; octave++)
        {
            var ridge = 1 - Math.Min(1, Math.Abs(At(point.X, point.Y, point.Z)) * 1.6);
            sum += strength * ridge * ridge;
            point = NextOctave(point);
            strength *= 0.5;
        }

        return sum;
    }

    // The translation keeps the zeros of the octaves from falling on each other.
    private static Vector NextOctave(Vector point) => (2 * point) + new Vector(17.3, 31.7, 5.9);

    private static double Fade(double t) => t * t * t * ((t * ((6 * t) - 15)) + 10);

    private static double Lerp(double a, double b, double t) => a + (t * (b - a));

    /// <summary>Computes the scalar product of a corner's gradient with the offset from the corner.</summary>
    /// <remarks>The gradient is one of the twelve that point to the midpoints of a cube's edges.</remarks>
    private double CornerContribution(long x, long y, long z, double dx, double dy, double dz)
    {
        var hash = HashMixing.Mix(seed ^ HashMixing.Mix((ulong)x ^ HashMixing.Mix((ulong)y ^ HashMixing.Mix((ulong)z))));
        var (a, b) = (hash % 3) switch
        {
            0 => (dx, dy),
            1 => (dy, dz),
            _ => (dz, dx),
        };
        return ((hash & 4096) == 0 ? a : -a) + ((hash & 8192) == 0 ? b : -b);
    }
}
