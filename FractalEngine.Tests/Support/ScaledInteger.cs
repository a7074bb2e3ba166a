using System.Numerics;

namespace FractalEngine.Tests.Support;

/// <summary>
/// Doubles as integers times a common power of two, for exact arithmetic in oracles. <c>Rational</c> of the benchmarks and its tests convert
/// on their own, so that the two check each other.
/// </summary>
internal static class ScaledInteger
{
    private const int MantissaBits = 52;

    /// <summary>Finds the largest exponent for which all numbers are integers times that power of two; 0 for zeros alone.</summary>
    public static int CommonExponent(IEnumerable<double> numbers) =>
        numbers.Where(number => number != 0).Select(number => Math.ILogB(number) - MantissaBits).DefaultIfEmpty(0).Min();

    /// <summary>Converts a number to the integer that, times 2 to the exponent, is the number.</summary>
    /// <param name="number">A finite number.</param>
    /// <param name="exponent">At most the common exponent of numbers among which this one is.</param>
    public static BigInteger Of(double number, int exponent)
    {
        if (number == 0)
        {
            return 0;
        }

        var ulpExponent = Math.ILogB(number) - MantissaBits;
        return new BigInteger(Math.ScaleB(number, -ulpExponent)) << (ulpExponent - exponent);
    }

    /// <summary>Computes the double next to a quotient times 2 to the exponent. The quotient is rounded from at least 119 bits.</summary>
    public static double Quotient(BigInteger numerator, BigInteger denominator, int exponent)
    {
        var shift = 120 - (int)(BigInteger.Abs(numerator).GetBitLength() - BigInteger.Abs(denominator).GetBitLength());
        var quotient = shift >= 0 ? (numerator << shift) / denominator : numerator / (denominator << -shift);
        return Math.ScaleB((double)quotient, exponent - shift);
    }
}
