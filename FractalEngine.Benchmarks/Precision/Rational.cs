using System.Numerics;

namespace FractalEngine.Benchmarks.Precision;

/// <summary>A fraction of integers, for results without any rounding. Every finite double is one.</summary>
/// <param name="Numerator">Numerator of any sign.</param>
/// <param name="Denominator">Denominator, greater than 0.</param>
internal readonly record struct Rational(BigInteger Numerator, BigInteger Denominator)
{
    public static Rational Zero => new(0, 1);

    public static Rational One => new(1, 1);

    public static Rational operator +(Rational r, Rational s) =>
        new((r.Numerator * s.Denominator) + (s.Numerator * r.Denominator), r.Denominator * s.Denominator);

    public static Rational operator -(Rational r, Rational s) => r + new Rational(-s.Numerator, s.Denominator);

    public static Rational operator *(Rational r, Rational s) => new(r.Numerator * s.Numerator, r.Denominator * s.Denominator);

    /// <exception cref="DivideByZeroException">The divisor is 0.</exception>
    public static Rational operator /(Rational r, Rational s) => s.Numerator.Sign switch
    {
        0 => throw new DivideByZeroException(),
        < 0 => new(-r.Numerator * s.Denominator, r.Denominator * -s.Numerator),
        _ => new(r.Numerator * s.Denominator, r.Denominator * s.Numerator),
    };

    public static bool operator <(Rational r, Rational s) => r.Numerator * s.Denominator < s.Numerator * r.Denominator;

    public static bool operator >(Rational r, Rational s) => s < r;

    /// <summary>Converts a double without rounding.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is NaN or infinite.</exception>
    public static Rational Of(double number)
    {
        if (!double.IsFinite(number))
        {
            throw new ArgumentOutOfRangeException(nameof(number), number, "expected a finite number");
        }

        var bits = BitConverter.DoubleToInt64Bits(Math.Abs(number));
        var exponentField = (int)(bits >> 52);
        var isSubnormal = exponentField == 0;
        var exponent = isSubnormal ? -1074 : exponentField - 1075;
        var mantissa = (bits & ((1L << 52) - 1)) | (isSubnormal ? 0 : 1L << 52);
        BigInteger numerator = number < 0 ? -mantissa : mantissa;
        return exponent >= 0 ? new(numerator << exponent, 1) : new(numerator, BigInteger.One << -exponent);
    }

    /// <summary>Tells whether two fractions are the same number: ½ equals 2/4.</summary>
    public bool Equals(Rational other) => Numerator * other.Denominator == other.Numerator * Denominator;

    /// <inheritdoc/>
    public override int GetHashCode()
    {
        var divisor = BigInteger.GreatestCommonDivisor(Numerator, Denominator);
        return HashCode.Combine(Numerator / divisor, Denominator / divisor);
    }

    /// <summary>Converts to a double that is off by about its last place, however large the integers are.</summary>
    public double ToDouble()
    {
        if (Numerator.IsZero)
        {
            return 0;
        }

        // The quotient has 64 bits or one more.
        var shift = 64 - (int)(BigInteger.Abs(Numerator).GetBitLength() - Denominator.GetBitLength());
        var quotient = shift >= 0 ? (Numerator << shift) / Denominator : Numerator / (Denominator << -shift);
        return Math.ScaleB((double)quotient, -shift);
    }
}
