using FractalEngine.Core.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Images;

/// <summary>What is written as OpenEXR is what a plain reader of the format's layout finds.</summary>
public class ExrWriterTests
{
    private static readonly float[] Corners =
    [
        0, -0f, 1, float.NaN, float.PositiveInfinity, float.NegativeInfinity, 65504, 65519, 65520, 1e30f, -1e30f, 6e-8f, 2e-8f, 1e-40f,
        float.Epsilon, float.MaxValue, float.MinValue, 0.1f, -2049,
    ];

    [Fact]
    public void Write_OfRandomChannels_IsReadBackSortedByName() => Seeded.Run(150, random =>
    {
        var (width, height) = (random.Next(1, 60), random.Next(1, 60));
        var names = new[] { "R", "Z", "albedo.R", "a", "B", "position.X", "level.X", "~" }[..random.Next(1, 9)];
        random.Shuffle(names);
        var isSmooth = random.Next(2) == 0;
        var channels = names.Select(name => new ImageChannel(name, Values(random, width * height, isSmooth))
        {
            IsHalf = random.Next(2) == 0,
        }).ToArray();
        var read = new PlainExr(Write(width, height, channels));
        Assert.Equal((width, height), (read.Width, read.Height));
        Assert.Equal(names.Order(StringComparer.Ordinal), read.Channels.Select(channel => channel.Name));
        foreach (var (name, isHalf, values) in read.Channels)
        {
            var written = channels.Single(channel => channel.Name == name);
            Assert.Equal(written.IsHalf, isHalf);
            var expected = isHalf ? written.Values.Select(Rounded).ToArray() : written.Values;
            Assert.Equal(expected.Select(BitConverter.SingleToInt32Bits), values.Select(BitConverter.SingleToInt32Bits));
        }
    });

    [Theory]
    [InlineData(3000, 1)]
    [InlineData(1, 3000)]
    [InlineData(300, 33)]
    public void Write_OfLongSides_IsSmallerThanItsNumbers(int width, int height)
    {
        var values = Enumerable.Range(0, width * height).Select(i => 1 + (i * 1e-4f)).ToArray();
        var file = Write(width, height, [new("Y", values)]);
        Assert.Equal(values, new PlainExr(file)["Y"]);
        Assert.True(file.Length < 4 * values.Length || height == 3000, $"{file.Length} bytes");
    }

    [Fact]
    public void Write_OnAnyNumberOfThreads_GivesEqualBytes()
    {
        var channels = new[] { new ImageChannel("Y", Values(new(3), 90 * 200, true)) };
        var first = Write(90, 200, channels);
        Assert.All(Enumerable.Range(0, 4), _ => Assert.Equal(first, Write(90, 200, channels)));
    }

    [Theory]
    [InlineData(0, 1, "Y")]
    [InlineData(2, 2, "Y")]
    [InlineData(1, 1, "")]
    [InlineData(1, 1, "ä")]
    [InlineData(1, 1, "12345678901234567890123456789012")]
    [InlineData(1, 1, "Y", "Y")]
    [InlineData(1, 1)]
    public void Write_OfWhatNoFileHolds_IsRefused(int width, int height, params string[] names) => Assert.Throws<ArgumentException>(
        () => Write(width, height, [.. names.Select(name => new ImageChannel(name, new float[1]))]));

    private static byte[] Write(int width, int height, IReadOnlyList<ImageChannel> channels)
    {
        var stream = new MemoryStream();
        ExrWriter.Write(width, height, channels, stream);
        return stream.ToArray();
    }

    private static float[] Values(Random random, int count, bool isSmooth) => [.. Enumerable.Range(0, count).Select(i => isSmooth
        ? i * 0.01f
        : random.Next(3) == 0 ? Corners[random.Next(Corners.Length)] : BitConverter.Int32BitsToSingle(random.Next()))];

    /// <summary>The nearest half in plain arithmetic, within the range.</summary>
    private static float Rounded(float value)
    {
        if (!float.IsFinite(value))
        {
            return (float)(Half)value;
        }

        var unit = Math.ScaleB(1, Math.Max(value == 0 ? -14 : Math.ILogB(value), -14) - 10);
        return (float)Math.CopySign(Math.Min(65504, Math.Abs(Math.Round(value / unit, MidpointRounding.ToEven) * unit)), value);
    }
}
