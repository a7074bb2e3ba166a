using System.Buffers.Binary;
using System.IO.Compression;
using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Images;

/// <summary>What is written is read back, says what it is, and is the same each time.</summary>
public class PngWriterTests
{
    [Fact]
    public void Write_OfRandomImages_IsReadBack() => Seeded.Run(300, random =>
    {
        var image = Image(random, random.Next(1, 70), random.Next(1, 30));
        var read = ImageFile.Load(new MemoryStream(Write(image)), isTga: false);
        Assert.Equal((image.Width, image.Height), (read.Width, read.Height));
        Assert.Equal(image.Pixels, read.Pixels);
    });

    [Theory]
    [InlineData(100_000, 1)]
    [InlineData(1, 10_000)]
    [InlineData(9_000, 12)]
    public void Write_OfLongSides_IsReadBack(int width, int height) => Seeded.Run(1, random =>
    {
        // Beyond the steps after which the sums of the filters are carried over, and beyond one chunk.
        var image = Image(random, width, height);
        Assert.True(image.Pixels.AsSpan().SequenceEqual(ImageFile.Load(new MemoryStream(Write(image)), isTga: false).Pixels));
    });

    [Theory]
    [InlineData(10, 1000)]
    [InlineData(29.97, 2997)]
    [InlineData(23.976, 2398)]
    [InlineData(0.01, 1)]
    public void Animation_OfAFractionOfAFrameASecond_HasDelaysOfHundredthsOfIt(double framesPerSecond, int expected)
    {
        var animation = new ApngAnimation(framesPerSecond);
        animation.Add(new(1, 1, [1, 2, 3, 4]));
        var stream = new MemoryStream();
        animation.Write(stream);
        var control = stream.ToArray().AsSpan();
        control = control[(control.IndexOf("fcTL"u8) + 4)..];
        // A delay of so many parts of a second.
        Assert.Equal(100, BinaryPrimitives.ReadUInt16BigEndian(control[20..]));
        Assert.Equal(expected, BinaryPrimitives.ReadUInt16BigEndian(control[22..]));
    }

    [Fact]
    public void WriteDeep_OfRandomImages_HasTheRowsOfThePlainEncoder() => Seeded.Run(100, random =>
    {
        var (width, height) = (random.Next(1, 40), random.Next(1, 9));
        var isSmooth = random.Next(2) == 0;
        var pixels = Enumerable.Range(0, 4 * width * height).Select(i => (ushort)(isSmooth ? 97 * i : random.Next(65536))).ToArray();
        var stream = new MemoryStream();
        PngWriter.WriteDeep(new(width, height, pixels), stream);
        var file = stream.ToArray();
        Assert.Equal([16, 6, 0, 0, 0], file[24..29]);
        // A decoder of 8 bits keeps about the upper byte.
        var read = ImageFile.Load(new MemoryStream(file), isTga: false);
        Assert.All(pixels.Zip(read.Pixels), pair => Assert.InRange(pair.First - (257 * pair.Second), -257, 257));
        Assert.Equal(["IHDR", "IDAT", "IEND"], Chunks(file).Select(chunk => chunk.Type));
        using var data = new ZLibStream(new MemoryStream(file[41..^16]), CompressionMode.Decompress);
        var rows = new MemoryStream();
        data.CopyTo(rows);
        var samples = new PlainSamples(width, height, 6, 16, false, pixels);
        var candidates = Enumerable.Range(0, 5).Select(type => PlainPng.Filtered(samples, random, type)).ToArray();
        var expected = Enumerable.Range(0, height).SelectMany(y => candidates
            .Select(all => all.AsSpan(y * ((8 * width) + 1), (8 * width) + 1).ToArray())
            .MinBy(line => line.Skip(1).Sum(value => Math.Abs((int)(sbyte)value)))!);
        Assert.Equal(expected, rows.ToArray());
    });

    [Fact]
    public void Write_GivesRgbaOf8BitsAndNoOtherChunk()
    {
        var file = Write(Image(new(1), 7, 5));
        Assert.Equal([0, 0, 0, 7, 0, 0, 0, 5, 8, 6, 0, 0, 0], file[16..29]);
        Assert.Equal(["IHDR", "IDAT", "IEND"], Chunks(file).Select(chunk => chunk.Type));
    }

    [Fact]
    public void Write_OfMuchData_MakesChunksOf64KiB()
    {
        var noise = new byte[4 * 300 * 200];
        new Random(1).NextBytes(noise);
        var lengths = Chunks(Write(new(300, 200, noise))).Where(chunk => chunk.Type == "IDAT").Select(chunk => chunk.Length).ToArray();
        Assert.All(lengths[..^1], length => Assert.Equal(65536, length));
        Assert.InRange(lengths[^1], 1, 65536);
        Assert.True(lengths.Length >= 4);
    }

    [Fact]
    public void Write_OfEqualImages_GivesEqualBytes() => Assert.Equal(Write(Image(new(7), 300, 100)), Write(Image(new(7), 300, 100)));

    [Fact]
    public void Filter_OfEachRow_IsTheOneOfLeastMagnitude() => Seeded.Run(50, random =>
    {
        var image = Image(random, random.Next(1, 40), 6);
        var stride = 4 * image.Width;
        var filter = new PngFilter(stride);
        var samples = new PlainSamples(image.Width, image.Height, 6, 8, false, [.. image.Pixels.Select(value => (ushort)value)]);
        // All rows by each filter, from the plain encoder.
        var candidates = Enumerable.Range(0, 5).Select(type => PlainPng.Filtered(samples, random, type)).ToArray();
        for (var y = 0; y < image.Height; y++)
        {
            var expected = candidates.Select(rows => rows.AsSpan(y * (stride + 1), stride + 1).ToArray())
                .MinBy(line => line.Skip(1).Sum(value => Math.Abs((int)(sbyte)value)))!;
            Assert.Equal(expected, filter.Apply(image.Pixels.AsSpan(y * stride, stride)).ToArray());
        }
    });

    [Fact]
    public void Write_OfAGradient_IsSmall()
    {
        var pixels = new byte[4 * 256 * 256];
        for (var i = 0; i < 256 * 256; i++)
        {
            ((byte[])[(byte)(i % 256), (byte)(i / 256), (byte)((i % 256) + (i / 256)), 255]).CopyTo(pixels, 4 * i);
        }

        // 256 KiB of pixels whose differences repeat.
        Assert.InRange(Write(new(256, 256, pixels)).Length, 57, 3000);
    }

    [Theory]
    [InlineData(0, 1, 0)]
    [InlineData(1, 0, 0)]
    [InlineData(2, 2, 15)]
    [InlineData(-1, -1, 4)]
    [InlineData(65536, 65536, 0)]
    public void Write_OfAnImageThatIsNone_IsRefused(int width, int height, int bytes) =>
        Assert.Throws<ArgumentException>(() => PngWriter.Write(new(width, height, new byte[bytes]), Stream.Null));

    [Fact]
    public void Write_ToAStreamThatFails_PassesTheErrorOn() =>
        Assert.Throws<NotSupportedException>(() => PngWriter.Write(new(1, 1, new byte[4]), new MemoryStream([], writable: false)));

    /// <summary>Noise, plain areas and gradients side by side.</summary>
    internal static PixelImage Image(Random random, int width, int height)
    {
        var pixels = new byte[4 * width * height];
        for (var y = 0; y < height; y++)
        {
            var kind = random.Next(4);
            for (var x = 0; x < width; x++)
            {
                for (var c = 0; c < 4; c++)
                {
                    pixels[(4 * ((y * width) + x)) + c] = kind switch
                    {
                        0 => (byte)random.Next(256),
                        1 => (byte)(x + (c * y)),
                        2 when y > 0 => pixels[(4 * (((y - 1) * width) + x)) + c],
                        _ => (byte)(17 * c),
                    };
                }
            }
        }

        return new(width, height, pixels);
    }

    internal static byte[] Write(PixelImage image)
    {
        using var stream = new MemoryStream();
        PngWriter.Write(image, stream);
        return stream.ToArray();
    }

    private static IEnumerable<(string Type, int Length)> Chunks(byte[] file)
    {
        for (var start = 8; start < file.Length;)
        {
            var length = (file[start] << 24) | (file[start + 1] << 16) | (file[start + 2] << 8) | file[start + 3];
            yield return (System.Text.Encoding.ASCII.GetString(file, start + 4, 4), length);
            start += 12 + length;
        }
    }
}
