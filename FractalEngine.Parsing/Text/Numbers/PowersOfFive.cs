using System.Numerics;
using System.Runtime.CompilerServices;

namespace FractalEngine.Parsing.Text.Numbers;

/// <summary>
/// Powers of five as normalised 128-bit integers, as D. Lemire, "Number parsing at a gigabyte per second" (2021), defines them. They are
/// computed at the first use.
/// </summary>
internal static class PowersOfFive
{
    /// <summary>Smallest exponent: any number of 19 digits times a smaller power of ten rounds to 0.</summary>
    public const int MinExponent = -342;

    /// <summary>Largest exponent: any positive integer times a larger power of ten is infinite.</summary>
    public const int MaxExponent = 308;

    // The reciprocals of powers up to here are rounded upwards, so that exact quotients are recognised.
    private const int MinExactQuotient = -27;

    private static readonly ulong[] Halves = Create();

    /// <summary>Returns the leading 128 bits of 5^exponent, of which the first is 1.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static (ulong High, ulong Low) Get(int exponent)
    {
        var index = 2 * (exponent - MinExponent);
        return (Halves[index], Halves[index + 1]);
    }

    private static ulong[] Create()
    {
        var halves = new ulong[2 * (MaxExponent - MinExponent + 1)];
        var power = BigInteger.One;
        for (var exponent = 0; exponent <= -MinExponent; exponent++)
        {
            if (exponent <= MaxExponent)
            {
                Store(halves, exponent, Truncate(power));
            }

            if (exponent > 0)
            {
                Store(halves, -exponent, Reciprocal(power, -exponent));
            }

            power *= 5;
        }

        return halves;
    }

    private static BigInteger Reciprocal(BigInteger power, int exponent)
    {
        var bits = (int)power.GetBitLength();
        return exponent >= MinExactQuotient
            ? (BigInteger.One << (bits + 127)) / power + 1
            : Truncate(((BigInteger.One << (bits + 192)) / power) + 1);
    }

    /// <summary>Returns the leading 128 bits of a number, with zeros behind a shorter one.</summary>
    private static BigInteger Truncate(BigInteger number)
    {
        var excess = (int)number.GetBitLength() - 128;
        return excess > 0 ? number >> excess : number << -excess;
    }

    private static void Store(ulong[] halves, int exponent, BigInteger value)
    {
        var index = 2 * (exponent - MinExponent);
        halves[index] = (ulong)(value >> 64);
        halves[index + 1] = (ulong)(value & ulong.MaxValue);
    }
}
