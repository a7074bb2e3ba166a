using System.Numerics;
using System.Runtime.CompilerServices;

namespace FractalEngine.Parsing.Text.Numbers;

/// <summary>Converts decimal numbers to the closest double: always the same bits as <see cref="double.Parse(string)"/>.</summary>
/// <remarks>
/// Digits up to 2⁵³ with a small power of ten take one exact multiplication or division (W. D. Clinger, "How to read floating point
/// numbers accurately", 1990). All others take one or two 128-bit products (D. Lemire, "Number parsing at a gigabyte per second",
/// 2021), which need no further check (N. Mushtak and D. Lemire, "Fast number parsing without fallback", 2023).
/// </remarks>
internal static class DecimalConversion
{
    /// <summary>Largest number of decimal digits that always fit into 64 bits.</summary>
    public const int MaxDigits = 19;

    // A double represents powers of ten up to 10²² and integers up to 2⁵³ exactly.
    private const int MaxExactPower = 22;
    private const ulong MaxExactInteger = 1UL << 53;

    private const int FractionBits = 52;
    private const int ExponentBias = 1023;
    private const ulong InfinityBits = 0x7FFUL << FractionBits;

    // Bits of the product above the fraction: the leading one and two for rounding, of which one is lost to normalisation.
    private const int ExtraBits = 3;

    // A number halfway between two doubles has an exact product, which only these powers allow (Lemire, section 8).
    private const int MinHalfwayPower = -4;
    private const int MaxHalfwayPower = 23;

    /// <summary>Powers of ten that a double represents exactly, 10⁰ to 10²².</summary>
    public static ReadOnlySpan<double> ExactPowersOfTen =>
    [
        1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11,
        1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
    ];

    /// <summary>Returns the double closest to digits·10^exponent, ties to even; infinite beyond the range.</summary>
    /// <param name="digits">Integer of up to <see cref="MaxDigits"/> digits, or any other of 64 bits.</param>
    /// <param name="exponent">Any power of ten.</param>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    public static double ToDouble(ulong digits, int exponent)
    {
        if (digits <= MaxExactInteger && exponent is >= -MaxExactPower and <= MaxExactPower)
        {
            return exponent < 0 ? digits / ExactPowersOfTen[-exponent] : digits * ExactPowersOfTen[exponent];
        }

        return digits == 0 || exponent < PowersOfFive.MinExponent ? 0
            : exponent > PowersOfFive.MaxExponent ? double.PositiveInfinity
            : BitConverter.UInt64BitsToDouble(RoundProduct(digits, exponent));
    }

    /// <summary>Computes the bits of the rounded product of digits, not 0, and a power of ten.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private static ulong RoundProduct(ulong digits, int exponent)
    {
        var leadingZeros = BitOperations.LeadingZeroCount(digits);
        var (high, low) = Multiply(digits << leadingZeros, exponent);
        var upperBit = (int)(high >> 63);
        var shift = upperBit + 64 - FractionBits - ExtraBits;
        var mantissa = high >> shift;
        // 217706/2¹⁶ is log₂ 10 as exactly as these exponents need; 10^e = 5^e·2^e, and 5^e is normalised to 64 bits.
        var power = ((217706 * exponent) >> 16) + 63 + upperBit - leadingZeros + ExponentBias;
        if (power <= 0)
        {
            return RoundSubnormal(mantissa, 1 - power);
        }

        var isHalfway = low <= 1 && exponent is >= MinHalfwayPower and <= MaxHalfwayPower && (mantissa & 3) == 1
            && mantissa << shift == high;
        mantissa = isHalfway ? mantissa >> 1 : (mantissa + 1) >> 1;
        if (mantissa >> (FractionBits + 1) != 0)
        {
            mantissa >>= 1;
            power++;
        }

        return power >= 0x7FF ? InfinityBits : ((ulong)power << FractionBits) | (mantissa & ((1UL << FractionBits) - 1));
    }

    /// <summary>Rounds a mantissa with one extra bit to a subnormal number, or to the smallest normal one.</summary>
    private static ulong RoundSubnormal(ulong mantissa, int shift) => shift >= 64 ? 0 : ((mantissa >> shift) + 1) >> 1;

    /// <summary>
    /// Returns the upper 128 bits of the product of a normalised integer and a power of five, as exactly as rounding needs.
    /// </summary>
    private static (ulong High, ulong Low) Multiply(ulong digits, int exponent)
    {
        var (powerHigh, powerLow) = PowersOfFive.Get(exponent);
        var high = Math.BigMul(digits, powerHigh, out var low);
        // The lower half of the power can only change what is rounded if all bits below are ones.
        const ulong LowerBits = ulong.MaxValue >> (FractionBits + ExtraBits);
        if ((high & LowerBits) == LowerBits)
        {
            var carry = Math.BigMul(digits, powerLow, out ulong _);
            low += carry;
            high += low < carry ? 1UL : 0;
        }

        return (high, low);
    }
}
