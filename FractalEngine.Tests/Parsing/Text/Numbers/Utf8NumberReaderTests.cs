using System.Globalization;
using System.Text;
using FractalEngine.Parsing.Text.Numbers;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Text.Numbers;

public class Utf8NumberReaderTests
{
    private const int Batch = 25_000;

    private static readonly string[] Behind = ["", " ", "\n", "\t1.5", "/2", "-1", "+", "#"];

    [Fact]
    public void Read_OfRandomNumbers_EqualsTheFrameworks() => CheckRandom(4);

    [Fact]
    [Trait("Category", "Soak")]
    public void Read_OfFortyMillionRandomNumbers_EqualsTheFrameworks() => CheckRandom(1600);

    private static void CheckRandom(int batches) => Parallel.For(1, batches + 1, seed => Seeded.RunOne(seed, random =>
    {
        var buffer = new byte[256];
        for (var i = 0; i < Batch; i++)
        {
            AssertEqual(CreateNumber(random), Behind[random.Next(Behind.Length)], buffer);
        }
    }));

    private static string CreateNumber(Random random) => random.Next(9) switch
    {
        0 => BitConverter.Int64BitsToDouble(random.NextInt64()) is var d && double.IsFinite(d) ? Invariant(d, "R") : "1.5",
        1 => Invariant((2 * random.NextDouble()) - 1, $"F{random.Next(18)}"),
        2 => Invariant(random.NextDouble() * Math.Pow(10, random.Next(-8, 9)), "R"),
        3 => $"{random.NextInt64(long.MaxValue)}e{random.Next(-345, 312)}",
        4 => $"{random.Next(1000)}.{new string('0', random.Next(12))}{random.Next()}",
        5 => $"-.{random.NextInt64(100_000_000_000)}",
        6 => Invariant(BitConverter.Int64BitsToDouble(random.NextInt64(1L << 53)), $"E{random.Next(10, 22)}"),
        7 => $"+{random.Next()}{(random.Next(2) == 0 ? "." : "")}",
        _ => ((float)random.NextDouble()).ToString("R", CultureInfo.InvariantCulture),
    };

    private static string Invariant(double number, string format) => number.ToString(format, CultureInfo.InvariantCulture);

    /// <summary>Every number of digits before and behind the point, around those that fit into eight and sixteen characters.</summary>
    [Fact]
    public void Read_OfAnyNumberOfDigits_EqualsTheFrameworks()
    {
        var buffer = new byte[256];
        foreach (var sign in (string[])["", "-", "+"])
        {
            for (var whole = 0; whole <= 21; whole++)
            {
                for (var fraction = 0; fraction <= 21; fraction++)
                {
                    var digits = "1234567890123456789012345"[..whole];
                    var point = fraction == 0 && whole > 0 ? "" : ".";
                    if (whole + fraction > 0)
                    {
                        AssertEqual($"{sign}{digits}{point}{"9876543210987654321098765"[..fraction]}", " 1", buffer);
                        AssertEqual($"{sign}{digits}{point}{"0000000000000000000000000"[..fraction]}e-{whole}", "", buffer);
                    }
                }
            }
        }
    }

    [Theory]
    [InlineData("")]
    [InlineData(".")]
    [InlineData("-")]
    [InlineData("-.")]
    [InlineData("+-1.5")]
    [InlineData("--1.5")]
    [InlineData("-e1.5")]
    [InlineData("e5")]
    [InlineData("x1.5")]
    [InlineData("/1.5")]
    [InlineData(":1.5")]
    [InlineData("nan")]
    [InlineData("1e")]
    [InlineData("1.5e+")]
    [InlineData("1e1234567")]
    [InlineData("1e309")]
    [InlineData("-17976931348623159e292")]
    public void Read_OfWhatIsNoFiniteNumber_IsLeftToTheParser(string text)
    {
        var value = 0.0;
        Assert.Equal(Utf8NumberReader.None, Utf8NumberReader.Read(ref Pad(text, new byte[64])[0], 0, ref value));
    }

    [Theory]
    [InlineData("7", 7)]
    [InlineData("12345678", 12345678)]
    [InlineData("00000012", 12)]
    [InlineData("123/4", 123)]
    public void ReadInteger_OfUpToEightDigits_IsItsValue(string text, int expected)
    {
        var end = Utf8NumberReader.ReadInteger(ref Pad(text, new byte[64])[0], 0, out var value);
        Assert.Equal((expected, text.Split('/')[0].Length), (value, (int)end));
    }

    [Theory]
    [InlineData("")]
    [InlineData("-1")]
    [InlineData("/")]
    [InlineData(":")]
    [InlineData("\u00B1")]
    public void ReadInteger_OfOtherText_IsNone(string text) =>
        Assert.Equal(Utf8NumberReader.None, Utf8NumberReader.ReadInteger(ref Pad(text, new byte[64])[0], 0, out _));

    private static void AssertEqual(string text, string behind, byte[] buffer)
    {
        var expected = double.Parse(text, NumberStyles.Float, CultureInfo.InvariantCulture);
        var value = 0.0;
        var end = (int)Utf8NumberReader.Read(ref Pad(text + behind, buffer)[0], 0, ref value);
        var isEqual = double.IsFinite(expected)
            ? end == text.Length && BitConverter.DoubleToInt64Bits(expected) == BitConverter.DoubleToInt64Bits(value)
            : end == Utf8NumberReader.None;
        if (!isEqual)
        {
            Assert.Fail($"{text} before '{behind}' was read as {value:R} ({end} of {text.Length} characters), not {expected:R}");
        }
    }

    /// <summary>Puts a text into a buffer, with a line feed and bytes of any value behind it.</summary>
    private static byte[] Pad(string text, byte[] buffer)
    {
        Array.Fill(buffer, (byte)'5');
        buffer[Encoding.Latin1.GetBytes(text, buffer)] = (byte)'\n';
        return buffer;
    }
}
