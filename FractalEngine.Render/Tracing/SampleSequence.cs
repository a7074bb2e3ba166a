using System.Runtime.CompilerServices;

namespace FractalEngine.Render.Tracing;

/// <summary>
/// Points of the unit square for the samples of one pixel, spread more evenly than random ones: the first two dimensions of Sobol's
/// sequence with Owen's scrambling, shuffled and scrambled anew for each pair of dimensions and each pixel.
/// </summary>
/// <remarks>
/// After B. Burley, "Practical Hash-based Owen Scrambling", JCGT 2020. The same pixel, sample and seed give the same points everywhere.
/// </remarks>
/// <param name="pixel">Index of the pixel.</param>
/// <param name="sample">Index of the sample, from 0.</param>
/// <param name="seed">Distinguishes independent images.</param>
internal struct SampleSequence(int pixel, int sample, int seed)
{
    private const float UnitOfUInt24 = 1f / (1 << 24);

    private readonly uint _pixelSeed = Hash((uint)pixel ^ Hash((uint)seed));
    private readonly uint _reversedIndex = ReverseBits((uint)sample);
    private uint _dimension;

    /// <summary>The next point, both coordinates from 0 to below 1.</summary>
    public (double U, double V) Next()
    {
        var seed = Hash(_pixelSeed + (0x9E3779B9u * ++_dimension));
        var index = ReverseBits(ScrambleReversed(_reversedIndex, seed));
        return (
            ToUnit(ReverseBits(ScrambleReversed(index, Hash(seed ^ 0xA511E9B3)))),
            ToUnit(ReverseBits(ScrambleReversed(SecondDimensionReversed(index), Hash(seed ^ 0x63D83595)))));
    }

    /// <summary>The next number from 0 to below 1.</summary>
    public double NextNumber() => Next().U;

    private static double ToUnit(uint bits) => (bits >> 8) * UnitOfUInt24;

    /// <summary>
    /// The second dimension of Sobol's sequence with its bits reversed. Its direction numbers are the rows of Pascal's triangle modulo 2:
    /// bit j is the sum of all bits of the index whose positions contain those of j, so that each position is summed over once.
    /// </summary>
    private static uint SecondDimensionReversed(uint index)
    {
        index ^= (index >> 1) & 0x55555555;
        index ^= (index >> 2) & 0x33333333;
        index ^= (index >> 4) & 0x0F0F0F0F;
        index ^= (index >> 8) & 0x00FF00FF;
        return index ^ (index >> 16);
    }

    /// <summary>Flips each bit or not, as the bits below it and the seed decide.</summary>
    private static uint ScrambleReversed(uint bits, uint seed)
    {
        bits += seed;
        bits ^= bits * 0x6C50B47C;
        bits ^= bits * 0xB82F1E52;
        bits ^= bits * 0xC7AFE638;
        return bits ^ (bits * 0x8D22F6E6);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static uint ReverseBits(uint bits)
    {
        bits = ((bits >> 1) & 0x55555555) | ((bits & 0x55555555) << 1);
        bits = ((bits >> 2) & 0x33333333) | ((bits & 0x33333333) << 2);
        bits = ((bits >> 4) & 0x0F0F0F0F) | ((bits & 0x0F0F0F0F) << 4);
        return System.Buffers.Binary.BinaryPrimitives.ReverseEndianness(bits);
    }

    /// <summary>Spreads the bits of a number over all bits of the result.</summary>
    private static uint Hash(uint bits)
    {
        bits = (bits ^ (bits >> 16)) * 0x7FEB352D;
        bits = (bits ^ (bits >> 15)) * 0x846CA68B;
        return bits ^ (bits >> 16);
    }
}
