using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Sky;

/// <summary>
/// Offsets from −½ to ½ that turn steps between the cells of <see cref="SkyMasks"/> into gradients: of many instances, as many take the
/// next cell as are close to it.
/// </summary>
internal static class SkyDither
{
    // Bits of a hash for each axis.
    private const int AxisBits = 21;
    private const double Unit = 1.0 / (1 << AxisBits);

    // The powers of one by the plastic number's generalisation to three dimensions, as in M. Roberts' sequence R3 (2018).
    private static readonly Vector256<double> Step = Vector256.Create(0.8191725133961645, 0.6710436067037893, 0.5497004779019703, 0);

    /// <summary>Computes the offsets of an instance.</summary>
    /// <param name="hash">
    /// Its hash by <see cref="HashMixing.GoldenGamma"/>, whose upper bits are evenly spread over siblings.
    /// </param>
    public static Vector256<double> Of(ulong hash) => Next(Vector256.Create(
        (hash >> (64 - AxisBits)) * Unit, ((hash >> (64 - (2 * AxisBits))) & ((1 << AxisBits) - 1)) * Unit,
        (hash & ((1 << AxisBits) - 1)) * Unit, 0));

    /// <summary>Computes the offsets of the next level.</summary>
    public static Vector256<double> Next(Vector256<double> dither)
    {
        var next = dither + Step;
        return next - Vector256.Round(next);
    }
}
