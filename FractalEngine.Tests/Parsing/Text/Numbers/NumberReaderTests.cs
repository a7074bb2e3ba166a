using System.Globalization;
using System.Numerics;
using FractalEngine.Parsing.Text.Numbers;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Text.Numbers;

public class NumberReaderTests
{
    [Fact]
    public void TryRead_OfTwoHundredThousandRandomNumbers_EqualsTheFrameworks() => Seeded.RunOne(1, random =>
    {
        for (var i = 0; i < 200_000; i++)
        {
            AssertEqual((i % 5) switch
            {
                0 => $"{RandomSign(random)}{RandomDigits(random, 1, 20)}.{RandomDigits(random, 0, 20)}",
                1 => $"{RandomSign(random)}{RandomDigits(random, 1, 17)}e{random.Next(-345, 312)}",
                2 => $"{RandomSign(random)}0.{new string('0', random.Next(0, 40))}{RandomDigits(random, 1, 60)}{RandomExponent(random)}",
                3 => RandomShortestText(random),
                _ => $"{RandomSign(random)}.{RandomDigits(random, 1, 9)}",
            });
        }
    });

    private static string RandomExponent(Random random) => $"E{(random.Next(2) == 0 ? "+" : "-")}{random.Next(0, 330):00}";

    private static string RandomShortestText(Random random)
    {
        var number = BitConverter.Int64BitsToDouble(random.NextInt64());
        return double.IsFinite(number) ? number.ToString("R", CultureInfo.InvariantCulture) : "1";
    }

    [Fact]
    public void TryRead_OfNumbersHalfwayBetweenTwoDoubles_RoundsAsTheFramework() => Seeded.RunOne(2, random =>
    {
        for (var i = 0; i < 5_000; i++)
        {
            // (2m + 1)·2⁻ᵏ lies halfway between m·2¹⁻ᵏ and its neighbour; as a decimal it is (2m + 1)·5ᵏ·10⁻ᵏ.
            var (mantissa, power) = (random.NextInt64(1L << 52, 1L << 53), random.Next(0, 80));
            var halfway = ((2 * new BigInteger(mantissa)) + 1) * BigInteger.Pow(5, power);
            AssertEqual($"{halfway}e-{power}");
            AssertEqual($"{halfway}000000000000000000000000000001e-{power + 30}");
            AssertEqual($"{halfway - 1}99999999999999999e-{power + 17}");
        }
    });

    [Theory]
    [InlineData("0")]
    [InlineData("-0")]
    [InlineData("-0.0e5")]
    [InlineData("5.")]
    [InlineData(".5")]
    [InlineData("+7")]
    [InlineData("000000000000000000000000000000001")]
    [InlineData("9007199254740993")]
    [InlineData("9007199254740992.5")]
    [InlineData("123456789012345678901234567890")]
    [InlineData("1e23")]
    [InlineData("8.5e22")]
    [InlineData("4.9406564584124654e-324")]
    [InlineData("2.4703282292062327e-324")]
    [InlineData("2.4703282292062328e-324")]
    [InlineData("2.2250738585072011e-308")]
    [InlineData("1.7976931348623157e308")]
    [InlineData("1.7976931348623158e308")]
    [InlineData("1.797693134862315708145274237317043567981e308")]
    [InlineData("1e-400")]
    [InlineData("0e999999999999")]
    [InlineData("1e-99999999999999999999")]
    [InlineData("1e0000000000000000000000005")]
    public void TryRead_OfASpecialNumber_EqualsTheFrameworks(string text) => AssertEqual(text);

    [Theory]
    [InlineData("1e309")]
    [InlineData("1e400")]
    [InlineData("1e99999999999999999999")]
    [InlineData("17976931348623159e292")]
    public void TryRead_OutOfRange_IsInfinite(string text)
    {
        Assert.True(NumberReader.TryRead(text, out var value, out var length));
        Assert.Equal((double.PositiveInfinity, text.Length), (value, length));
    }

    [Fact]
    public void TryRead_OfAVeryLongNumber_EqualsTheFrameworks()
    {
        AssertEqual(new string('9', 5000) + "e-4990");
        AssertEqual("0." + new string('0', 5000) + "1e5001");
        AssertEqual("1" + new string('0', 5000) + "e-5000");
    }

    [Theory]
    [InlineData("1 2", 1)]
    [InlineData("1.5,2", 3)]
    [InlineData("-1.5)", 4)]
    [InlineData("1e", 1)]
    [InlineData("1e+", 1)]
    [InlineData("1e5e5", 3)]
    [InlineData("1ex", 1)]
    [InlineData("1.2.3", 3)]
    [InlineData("0x10", 1)]
    [InlineData("1/2", 1)]
    [InlineData("1-2", 1)]
    [InlineData("1_000", 1)]
    [InlineData("1٣", 1)]
    public void TryRead_OfANumberAndMore_StopsBehindIt(string text, int expected)
    {
        Assert.True(NumberReader.TryRead(text, out var value, out var length));
        Assert.Equal((double.Parse(text[..expected], CultureInfo.InvariantCulture), expected), (value, length));
    }

    [Theory]
    [InlineData("")]
    [InlineData(" 1")]
    [InlineData(".")]
    [InlineData("-")]
    [InlineData("+-1")]
    [InlineData("-.")]
    [InlineData("e5")]
    [InlineData(".e5")]
    [InlineData("nan")]
    [InlineData("NaN")]
    [InlineData("inf")]
    [InlineData("-Infinity")]
    [InlineData("∞")]
    [InlineData("٣")]
    [InlineData("−1")]
    [InlineData("(1)")]
    public void TryRead_OfNoNumber_Fails(string text) => Assert.False(NumberReader.TryRead(text, out _, out _));

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void TryRead_InAnyCulture_IsTheSame(string culture) => InCulture.Run(culture, () =>
    {
        AssertEqual("-1.5");
        AssertEqual("-1234567890.12345678901234567890e-5");
        return 0;
    });

    [Fact]
    public void TryRead_OfUsualNumbers_AllocatesNothing()
    {
        Assert.Equal(0, Allocation.Measure(static () =>
        {
            NumberReader.TryRead("-123.456789", out _, out _);
            NumberReader.TryRead("1.7976931348623157e308", out _, out _);
        }));
    }

    private static void AssertEqual(string text)
    {
        var expected = double.Parse(text, NumberStyles.Float, CultureInfo.InvariantCulture);
        Assert.True(NumberReader.TryRead(text, out var value, out var length), text);
        if (BitConverter.DoubleToInt64Bits(expected) != BitConverter.DoubleToInt64Bits(value) || length != text.Length)
        {
            Assert.Fail($"{text} was read as {value:R} ({length} of {text.Length} characters), not {expected:R}");
        }
    }

    private static string RandomSign(Random random) => random.Next(3) switch { 0 => "-", 1 => "+", _ => "" };

    private static string RandomDigits(Random random, int minCount, int maxCount) =>
        string.Concat(Enumerable.Range(0, random.Next(minCount, maxCount + 1)).Select(_ => (char)('0' + random.Next(10))));
}
