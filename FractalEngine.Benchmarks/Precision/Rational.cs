using System.Numerics;

namespace FractalEngine.Benchmarks.Precision;

/// <summary>A fraction of integers, for results without any rounding. Every finite double is one.</summary>
/// <param name="Numerator">Of any sign.</param>
/// <param name="Denominator">Positive.</param>
internal readonly record struct Rational(BigInteger Numerator, BigInteger Denominator)
{
    public static Rational Zero => new(0, 1);

    public static Rational One => new(1, 1);

    public static Rational operator +(Rational r, Rational s) =>
        new((r.Numerator * s.Denominator) + (s.Numerator * r.Denominator), r.Denominator * s.Denominator);

    public static Rational operator -(Rational r, Rational s) => r + new Rational(-s.Numerator, s.Denominator);

    public static Rational operator *(Rational r, Rational s) => new(r.Numerator * s.Numerator, r.Denominator * s.Denominator);

    /// <exception cref="DivideByZeroException">The second is zero.</exception>
    public static Rational operator /(Rational r, Rational s) => s.Numerator.Sign switch
    {
        0 => throw new DivideByZeroException(),
        < 0 => new(-r.Numerator * s.Denominator, r.Denominator * -s.Numerator),
        _ => new(r.Numerator * s.Denominator, r.Denominator * s.Numerator),
    };

    public static bool operator <(Rational r, Rational s) => r.Numerator * s.Denominator < s.Numerator * r.Denominator;

    public static bool operator >(Rational r, Rational s) => s < r;

    /// <summary>Exactly this double.</summary>
    /// <exception cref="ArgumentOutOfRangeException">It is NaN or infinite.</exception>
    public static Rational Of(double number)
    {
        if (!double.IsFinite(number))
        {
            throw new ArgumentOutOfRangeException(nameof(number), number, "expected a finite number");
        }

        var bits = BitConverter.DoubleToInt64Bits(Math.Abs(number));
        var (exponent, fraction) = ((int)(bits >> 52), bits & ((1L << 52) - 1));
        (exponent, fraction) = exponent == 0 ? (-1074, fraction) : (exponent - 1075, fraction | (1L << 52));
        BigInteger numerator = number < 0 ? -fraction : fraction;
        return exponent >= 0 ? new(numerator << exponent, 1) : new(numerator, BigInteger.One << -exponent);
    }

    /// <summary>True for the same number: ½ is 2/4.</summary>
    public bool Equals(Rational other) => Numerator * other.Denominator == other.Numerator * Denominator;

    /// <inheritdoc/>
    public override int GetHashCode() => BigInteger.GreatestCommonDivisor(Numerator, Denominator) switch
    {
        var divisor => HashCode.Combine(Numerator / divisor, Denominator / divisor),
    };

    /// <summary>To about the last place of a double, whatever the size of the integers.</summary>
    public double ToDouble()
    {
        if (Numerator.IsZero)
        {
            return 0;
        }

        // A quotient of 64 bits or one more.
        var shift = 64 - (int)(BigInteger.Abs(Numerator).GetBitLength() - Denominator.GetBitLength());
        var quotient = shift >= 0 ? (Numerator << shift) / Denominator : Numerator / (Denominator << -shift);
        return Math.ScaleB((double)quotient, -shift);
    }
}
