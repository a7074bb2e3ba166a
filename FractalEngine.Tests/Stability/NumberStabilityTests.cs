using System.Globalization;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Text;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Mtl;
using FractalEngine.Parsing.Points;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Numbers;
using FractalEngine.Parsing.Wavefront;
using FractalEngine.Parsing.Wavefront.Writing;
using FractalEngine.Tests.Support;
using Xunit.Abstractions;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Stability;

/// <summary>
/// Tests numbers as text beyond NumberReaderTests: written and read back, compared with exact arithmetic, and in files of every format
/// under other cultures.
/// </summary>
public class NumberStabilityTests(ITestOutputHelper output)
{
    private const int Batch = 10_000;

    [Fact]
    public void TryRead_OfRandomText_IsTheNearestDouble() => CheckText(8);

    [Fact]
    [Trait("Category", "Soak")]
    public void TryRead_OfTenMillionRandomTexts_IsTheNearestDouble() => CheckText(1000);

    [Fact]
    public void TryRead_OfWhatWasWritten_IsTheSameBits() => CheckWritten(20);

    [Fact]
    [Trait("Category", "Soak")]
    public void TryRead_OfTenMillionThatWereWritten_IsTheSameBits() => CheckWritten(1000);

    /// <summary>Writes and reads under a culture. The text must be that of the invariant culture.</summary>
    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void Formats_InAnyCulture_AreWrittenAndReadToTheSameBits(string culture) => Seeded.Run(30, random =>
    {
        var numbers = Enumerable.Range(0, 9).Select(_ => RandomFinite(random) % 1e30).ToArray();
        Assert.Equal(Written(numbers), InCulture.Run(culture, () => Written(numbers)));
        Assert.Equal(ReadBack(numbers), InCulture.Run(culture, () => ReadBack(numbers)));
        Assert.Equal(string.Join(' ', numbers.Select(Bits)), InCulture.Run(culture, () => ReadBack(numbers)));
    });

    private void CheckText(int batches, [CallerMemberName] string test = "")
    {
        using var report = new StabilityReport(output, method: test);
        var comparedCount = 0;
        Parallel.For(1, batches + 1, seed => Seeded.RunOne(seed, random =>
        {
            for (var i = 0; i < Batch; i++)
            {
                var text = RandomDecimalText(random);
                var expected = double.Parse(text, NumberStyles.Float, CultureInfo.InvariantCulture);
                Assert.True(NumberReader.TryRead(text, out var value, out var length) && length == text.Length, text);
                report.Require(
                    "decimal texts whose bits are not those of double.Parse", HasSameBits(expected, value) ? 0 : 1, 0,
                    () => $"{text}: {value}, not {expected}");
                // Rational arithmetic takes long.
                if (i % 50 == 0 && double.IsFinite(value))
                {
                    report.Require(
                        "decimal texts off rational arithmetic (units in the last place)", UnitsOff(text, value), 0.5,
                        () => $"{text}: {value}");
                    Interlocked.Increment(ref comparedCount);
                }
            }
        }));
        // Few texts are beyond the range of a double.
        Seeded.AssertMost(comparedCount, batches * Batch / 50, minShare: 0.99);
    }

    private void CheckWritten(int batches, [CallerMemberName] string test = "")
    {
        using var report = new StabilityReport(output, method: test);
        var singleCount = 0;
        Parallel.For(1, batches + 1, seed => Seeded.RunOne(seed, random =>
        {
            for (var i = 0; i < Batch; i++)
            {
                var number = RandomFinite(random);
                Assert.True(NumberReader.TryRead(number.ToString("R", CultureInfo.InvariantCulture), out var value, out _));
                report.Require(
                    "numbers written and read whose bits changed: doubles", HasSameBits(number, value) ? 0 : 1, 0,
                    () => $"{number}: {value}");
                var single = BitConverter.Int32BitsToSingle(random.Next());
                if (float.IsFinite(single))
                {
                    Assert.True(NumberReader.TryRead(single.ToString("R", CultureInfo.InvariantCulture), out value, out _));
                    report.Require(
                        "numbers written and read whose bits changed: floats", single.Equals((float)value) ? 0 : 1, 0,
                        () => $"{single}: {value}");
                    Interlocked.Increment(ref singleCount);
                }
            }
        }));
        // All but those with the largest of 256 exponents.
        Seeded.AssertMost(singleCount, batches * Batch, minShare: 0.99);
    }

    private static bool HasSameBits(double x, double y) => BitConverter.DoubleToInt64Bits(x) == BitConverter.DoubleToInt64Bits(y);

    /// <summary>
    /// Creates a number: plain, with an exponent, subnormal, at the ends of the range, or exactly or nearly between two doubles.
    /// </summary>
    private static string RandomDecimalText(Random random) => random.Next(8) switch
    {
        0 => $"{RandomDigits(random, 1, 20)}.{RandomDigits(random, 0, 20)}",
        1 => $"-{RandomDigits(random, 1, 19)}e{random.Next(-345, 312)}",
        2 => $"{RandomDigits(random, 1, 18)}.{RandomDigits(random, 0, 18)}E{random.Next(-40, 40):+00;-00}",
        3 => $"{RandomDigits(random, 1, 17)}e-{random.Next(305, 345)}",
        4 => $".{RandomDigits(random, 1, 800)}e{random.Next(-400, 300)}",
        5 => MidpointText(BitConverter.Int64BitsToDouble(random.NextInt64(1L << 52)), random.Next(3)),
        _ => MidpointText(RandomPositive(random), random.Next(3)),
    };

    /// <summary>Creates a positive number. Very large ones, whose digits take long, are replaced by their square roots.</summary>
    private static double RandomPositive(Random random)
    {
        var number = BitConverter.Int64BitsToDouble(random.NextInt64(0x7FEFFFFFFFFFFFFF));
        return number > 1e250 ? Math.Sqrt(number) : number;
    }

    /// <summary>Writes all digits of the midpoint between a number and its neighbour, or of a number a little less or more.</summary>
    private static string MidpointText(double number, int more)
    {
        var (mantissa, exponent) = Decompose(number);
        var middle = (2 * mantissa) + 1;
        var power = exponent - 1;
        // m·2⁻ᵏ = m·5ᵏ·10⁻ᵏ
        var (digits, ten) = power >= 0 ? (middle << power, 0) : (middle * BigInteger.Pow(5, -power), power);
        return more switch
        {
            0 => $"{digits}e{ten}",
            1 => $"{digits}0000000001e{ten - 10}",
            _ => $"{digits - 1}9999999999e{ten - 10}",
        };
    }

    /// <summary>
    /// Computes how far a double is from a decimal text, in units of the double's last place. A tie that did not go to the even one counts
    /// as 1.
    /// </summary>
    private static double UnitsOff(string text, double value)
    {
        var (mantissa, exponent) = Decompose(value);
        var lower = text.ToUpperInvariant().Split('E');
        var (whole, fraction) = lower[0].TrimStart('-').Split('.') switch { [var w, var f] => (w, f), [var w] => (w, ""), _ => ("", "") };
        var decimals = BigInteger.Parse("0" + whole + fraction, CultureInfo.InvariantCulture);
        var power = (lower.Length > 1 ? int.Parse(lower[1], CultureInfo.InvariantCulture) : 0) - fraction.Length;
        // decimals·10^power against mantissa·2^exponent, both as whole numbers.
        var left = decimals * BigInteger.Pow(10, Math.Max(0, power)) * BigInteger.Pow(2, Math.Max(0, -exponent));
        var unit = BigInteger.Pow(2, Math.Max(0, exponent)) * BigInteger.Pow(10, Math.Max(0, -power));
        var twice = 2 * BigInteger.Abs(left - (mantissa * unit));
        return twice > unit || (twice == unit && !mantissa.IsEven) ? 1 : (double)(1000 * twice / unit) / 2000;
    }

    /// <summary>Decomposes a number, whose magnitude is mantissa·2^exponent.</summary>
    private static (BigInteger Mantissa, int Exponent) Decompose(double number)
    {
        var bits = BitConverter.DoubleToInt64Bits(number);
        var (field, fraction) = ((int)((bits >> 52) & 0x7FF), bits & 0xFFFFFFFFFFFFF);
        return field == 0 ? (fraction, -1074) : (fraction | (1L << 52), field - 1075);
    }

    private static string RandomDigits(Random random, int minCount, int maxCount) =>
        string.Concat(Enumerable.Range(0, random.Next(minCount, maxCount + 1)).Select(_ => (char)('0' + random.Next(10))));

    private static double RandomFinite(Random random)
    {
        var number = BitConverter.Int64BitsToDouble(random.NextInt64(long.MinValue, long.MaxValue));
        return double.IsFinite(number) ? number : random.Next(2) == 0 ? double.Epsilon : double.MaxValue;
    }

    private static string Bits(double number) => $"{BitConverter.DoubleToInt64Bits(number):X}";

    /// <summary>Writes the numbers as OBJ, SDO and CSV, and texts for people.</summary>
    private static string Written(double[] numbers)
    {
        using var stream = new MemoryStream();
        ObjMeshWriter.Write(MeshOf(numbers), stream, "mesh");
        using var table = new StringWriter { NewLine = "\n" };
        var world = new PhysicsWorld();
        world.Add(new(new(numbers[0], numbers[1], numbers[2]), 1) { Velocity = new(numbers[3] % 1e6, 0.5, -1.25) });
        new BodyCsvWriter(table).WriteStep(world);
        return string.Join('\n', Encoding.UTF8.GetString(stream.ToArray()), SceneWriter.Write(SceneOf(numbers)), table,
            new Diagnostic("ı.fdo", 1234567, 89, DiagnosticSeverity.Warning, "i"), DecimalText.FormatApproximately(1234567));
    }

    /// <summary>Writes and reads the numbers in all formats, and returns their bits. Fails unless all formats agree.</summary>
    private static string ReadBack(double[] numbers)
    {
        using var stream = new MemoryStream();
        ObjMeshWriter.Write(MeshOf(numbers), stream, "mesh");
        var mesh = ObjParser.Parse(new SourceText("a.obj", Encoding.UTF8.GetString(stream.ToArray()))).Mesh;
        var scene = SceneParser.Parse(new("a.sdo", SceneWriter.Write(SceneOf(numbers)))).Scene;
        var lines = numbers.Chunk(3).Select(point => new Vector(point[0], point[1], point[2]).ToString().Trim('(', ')'));
        var points = PointsParser.Parse(new("a.txt", string.Join('\n', lines)));
        var vector = $"v {Invariant(numbers[0])} {Invariant(numbers[1])} {Invariant(numbers[2])}";
        var fractal = Samples.ParseFractal($"{vector}\nt.a. (a, #, #)\nx. \"b.obj\"\n<$>. [t.1] x\n");
        var material = MtlParser.Parse(new("a.mtl", $"newmtl m\nNs {Invariant(Math.Abs(numbers[0]) % 1000)}\n"));
        Assert.Equal(Math.Abs(numbers[0]) % 1000, material.Materials["m"].SpecularExponent);
        Assert.Equal(new Vector(numbers[0], numbers[1], numbers[2]), NaiveFractal.Levels(fractal.Description.Steps).Single()[0].Position);
        Assert.Equal(numbers.Select(Bits), points.SelectMany(Components).Select(Bits));
        Assert.Equal(numbers[..6].Select(Bits), scene.Objects.Select(item => item.Placement.Position).SelectMany(Components).Select(Bits));
        return string.Join(' ', mesh.Positions.Select(Bits));
    }

    private static string Invariant(double number) => number.ToString("R", CultureInfo.InvariantCulture);

    private static double[] Components(Vector v) => [v.X, v.Y, v.Z];

    private static Mesh MeshOf(double[] numbers) => new([.. numbers], [0, 1, 2]);

    private static Scene SceneOf(double[] numbers) => new()
    {
        Objects =
        [
            new("a.obj", Samples.Move(numbers[0], numbers[1], numbers[2])),
            new("b.obj", Samples.Move(numbers[3], numbers[4], numbers[5])),
        ],
    };
}
