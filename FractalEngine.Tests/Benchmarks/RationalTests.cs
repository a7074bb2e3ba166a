using System.Globalization;
using System.Numerics;
using FractalEngine.Benchmarks.Precision;
using FractalEngine.Tests.Support;
using FsCheck;
using FsCheck.Fluent;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>
/// Compares with whole numbers: every double times 2¹⁰⁷⁴ is one. The conversion to these shares nothing with the one under test.
/// </summary>
public class RationalTests
{
    private const int Exponent = 1074;

    private static readonly BigInteger Unit = BigInteger.One << Exponent;
    private static readonly BigInteger Tens = BigInteger.Pow(10, Exponent);

    private static Gen<double> NotZero { get; } = Laws.AnyFinite.Where(x => x != 0);

    /// <summary>Generates quotients of any two doubles.</summary>
    private static Gen<Rational> Fractions { get; } = Laws.AnyFinite.Zip(NotZero, (x, y) => Rational.Of(x) / Rational.Of(y));

    [Fact]
    public void Of_AnyDouble_IsWhatItsDecimalsSay() => Laws.CheckForAll(Laws.AnyFinite, x =>
    {
        // So many decimals write every double exactly. They are not made by the code under test.
        var decimals = BigInteger.Parse(x.ToString($"F{Exponent}", CultureInfo.InvariantCulture).Replace(".", "", StringComparison.Ordinal),
            CultureInfo.InvariantCulture);
        return AreEqual(Rational.Of(x), decimals, Tens);
    });

    [Theory]
    [InlineData(0.75, 3, 4)]
    [InlineData(-0.75, -3, 4)]
    [InlineData(6, 6, 1)]
    [InlineData(-0.0, 0, 1)]
    [InlineData(9007199254740993, 9007199254740992, 1)]
    public void Of_ADouble_IsItsFraction(double x, long numerator, long denominator) =>
        Assert.Equal(new(numerator, denominator), Rational.Of(x));

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    [InlineData(double.NegativeInfinity)]
    public void Of_AnInfiniteNumberOrNaN_Throws(double number) =>
        Assert.Throws<ArgumentOutOfRangeException>(nameof(number), () => Rational.Of(number));

    [Fact]
    public void Operators_OfAnyDoubles_AreThoseOfWholeNumbers() => Laws.CheckForAll(Laws.AnyFinite.Zip(NotZero), pair =>
    {
        var (x, y) = (ToScaledInteger(pair.Item1), ToScaledInteger(pair.Item2));
        var (r, s) = (Rational.Of(pair.Item1), Rational.Of(pair.Item2));
        return AreEqual(r + s, x + y, Unit) && AreEqual(r - s, x - y, Unit) && AreEqual(r * s, x * y, Unit * Unit)
            && AreEqual(r / s, x * y.Sign, BigInteger.Abs(y));
    });

    [Fact]
    public void Operators_OfAnyFractions_AreThoseOfAField() => Laws.CheckForAll(Fractions.Three(), triple =>
    {
        var (r, s, t) = triple;
        Assert.Equal(r + s, s + r);
        Assert.Equal(r * s, s * r);
        Assert.Equal(r + s + t, r + (s + t));
        Assert.Equal(r * s * t, r * (s * t));
        Assert.Equal(r * (s + t), (r * s) + (r * t));
        Assert.Equal(r, r + Rational.Zero);
        Assert.Equal(r, r * Rational.One);
        Assert.Equal(Rational.Zero, r - r);
        Assert.Equal(r, r - s + s);
        Assert.True(s == Rational.Zero || r == r / s * s);
    });

    [Fact]
    public void Division_ByZero_Throws() => Assert.Throws<DivideByZeroException>(() => Rational.One / Rational.Of(-0.0));

    [Fact]
    public void Equality_OfDifferentlyWrittenFractions_IsThatOfNumbers()
    {
        var (half, other) = (new Rational(1, 2), new Rational(-3, 6));
        Assert.Equal(half, Rational.Zero - other);
        Assert.Equal(half.GetHashCode(), (Rational.Zero - other).GetHashCode());
        Assert.NotEqual(half, other);
    }

    [Fact]
    public void Order_OfAnyDoubles_IsTheirs() => Laws.CheckForAll(Laws.AnyFinite.Two(), pair =>
    {
        var (x, y) = pair;
        var (r, s) = (Rational.Of(x), Rational.Of(y));
        return r < s == x < y && r > s == x > y && r == s == (x == y);
    });

    [Fact]
    public void Order_OfFractionsThatDoublesCantTellApart_IsRight()
    {
        var third = Rational.One / Rational.Of(3);
        var above = third + Rational.Of(double.Epsilon);
        Assert.Equal(third.ToDouble(), above.ToDouble());
        Assert.True(third < above && above > third && !(above < third) && !(third > above) && !(third < third + Rational.Zero));
        Assert.True(Rational.Zero - above < Rational.Zero - third);
    }

    [Fact]
    public void ToDouble_OfAnyDouble_IsItself() => Laws.CheckForAll(Laws.AnyFinite, x => Rational.Of(x).ToDouble() == x);

    [Fact]
    public void ToDouble_OfAnyFraction_IsLessThanAPlaceAway() => Laws.CheckForAll(Laws.AnyFinite.Zip(NotZero), pair =>
    {
        var (numerator, denominator) = (ToScaledInteger(pair.Item1), ToScaledInteger(pair.Item2));
        var (x, y) = (numerator * denominator.Sign, BigInteger.Abs(denominator));
        var result = (Rational.Of(pair.Item1) / Rational.Of(pair.Item2)).ToDouble();
        // There is no neighbour beyond the largest double.
        return (result == double.NegativeInfinity || ToScaledInteger(Math.BitDecrement(result)) * y < x * Unit)
            && (result == double.PositiveInfinity || x * Unit < ToScaledInteger(Math.BitIncrement(result)) * y
            || result == double.MaxValue);
    });

    [Fact]
    public void ToDouble_OfIntegersThatNoDoubleHolds_IsTheirQuotient()
    {
        var (large, small) = (BigInteger.Pow(7, 3000), BigInteger.Pow(7, 2998));
        Assert.Equal(49, new Rational(large, small).ToDouble());
        Assert.Equal(-1 / 49.0, new Rational(-small, large).ToDouble());
        Assert.Equal(double.PositiveInfinity, new Rational(large, 1).ToDouble());
        Assert.Equal(0, new Rational(1, large).ToDouble());
        Assert.Equal(0, new Rational(0, large).ToDouble());
    }

    private static bool AreEqual(Rational rational, BigInteger numerator, BigInteger denominator) =>
        rational.Denominator.Sign > 0 && rational.Numerator * denominator == numerator * rational.Denominator;

    /// <summary>Converts a double times 2¹⁰⁷⁴ to an integer.</summary>
    private static BigInteger ToScaledInteger(double x)
    {
        if (double.IsInfinity(x))
        {
            throw new ArgumentOutOfRangeException(nameof(x), x, "expected a finite number");
        }

        var exponent = x == 0 ? 0 : Math.Max(Math.ILogB(x) - 52, -Exponent);
        return new BigInteger(Math.ScaleB(x, -exponent)) << (exponent + Exponent);
    }
}
