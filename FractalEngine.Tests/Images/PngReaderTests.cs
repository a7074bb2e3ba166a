using FractalEngine.Core.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Images;

/// <summary>Files of every kind in the standard, written by <see cref="PlainPng"/> from random samples: each pixel is exact.</summary>
public class PngReaderTests
{
    public static TheoryData<int, int, bool> Kinds
    {
        get
        {
            var data = new TheoryData<int, int, bool>();
            foreach (var (colourType, depth) in PlainSamples.Kinds)
            {
                data.Add(colourType, depth, false);
                data.Add(colourType, depth, true);
            }

            return data;
        }
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void Read_OfEachKind_GivesTheExactPixels(int colourType, int depth, bool isInterlaced) => Seeded.Run(30, random =>
        AssertRead(PlainSamples.Random(random, colourType, depth, isInterlaced, random.Next(1, 40), random.Next(1, 20)), random));

    [Theory]
    [MemberData(nameof(Kinds))]
    public void Read_ThroughEachFilter_GivesTheExactPixels(int colourType, int depth, bool isInterlaced) => Seeded.Run(2, random =>
    {
        for (var filter = 0; filter < 5; filter++)
        {
            AssertRead(PlainSamples.Random(random, colourType, depth, isInterlaced, random.Next(1, 80), 4), random, filter);
        }
    });

    [Fact]
    public void Read_OfEachSmallInterlacedSize_GivesTheExactPixels() => Seeded.Run(1, random =>
    {
        // Every size at which a pass has no columns, no rows or neither.
        for (var width = 1; width <= 9; width++)
        {
            for (var height = 1; height <= 9; height++)
            {
                AssertRead(PlainSamples.Random(random, 0, 2, isInterlaced: true, width, height), random);
            }
        }
    });

    [Theory]
    [InlineData(2, 8, 30_000, 2)]
    [InlineData(6, 8, 20_000, 3)]
    [InlineData(6, 16, 10_000, 2)]
    [InlineData(0, 1, 3, 40_000)]
    public void Read_OfRowsBeyondABlock_GivesTheExactPixels(int colourType, int depth, int width, int height) =>
        Seeded.Run(1, random => AssertRead(PlainSamples.Random(random, colourType, depth, isInterlaced: false, width, height), random));

    [Fact]
    public void Reduce_OfEachSample_IsTheNearest()
    {
        for (var value = 0; value <= ushort.MaxValue; value++)
        {
            Assert.Equal(Math.Round(value * 255m / 65535m, MidpointRounding.AwayFromZero), PngRowConverter.Reduce((ushort)value));
        }
    }

    [Fact]
    public void Read_OfAStreamThatGivesAByteAtATime_IsTheSame() => Seeded.Run(20, random =>
    {
        var samples = PlainSamples.Random(random, 6, 8, isInterlaced: true, 9, 7);
        Assert.Equal(samples.ToImage().Pixels, PngReader.Read(new SlowStream(PlainPng.Encode(samples, random))).Pixels);
    });

    [Fact]
    public void Read_WithinALongerStream_EndsBehindTheImage()
    {
        var samples = PlainSamples.Random(new(1), 2, 8, isInterlaced: false, 5, 5);
        var file = PlainPng.Encode(samples, new(1));
        using var stream = new MemoryStream([1, 2, 3, .. file, 4, 5]);
        stream.Position = 3;
        Assert.Equal(samples.ToImage().Pixels, PngReader.Read(stream).Pixels);
        Assert.Equal(3 + file.Length, stream.Position);
    }

    [Fact]
    public void Read_WithChunksThatSayNothingOfPixels_IgnoresThem()
    {
        var (samples, data) = Sample(new(1));
        byte[] gamma = PlainPng.Chunk("gAMA", 0, 0, 0, 1);
        byte[] unknown = PlainPng.Chunk("abCd", new byte[10_000]);
        byte[] image = PlainPng.Chunk("IDAT", data);
        var file = File(PlainPng.Head(samples), gamma, unknown, image, unknown, PlainPng.Chunk("tEXt"));
        Assert.Equal(samples.ToImage().Pixels, Read(file).Pixels);
    }

    [Fact]
    public void Read_WithASuggestedPalette_IgnoresIt()
    {
        var (samples, data) = Sample(new(1));
        var head = PlainPng.Head(samples with { Palette = [1, 2, 3] });
        Assert.Equal(samples.ToImage().Pixels, Read(File(head, PlainPng.Chunk("IDAT", data))).Pixels);
    }

    [Fact]
    public void Read_WithATransparencyBesideAlpha_IgnoresIt()
    {
        var (samples, data) = Sample(new(1));
        var head = PlainPng.Head(samples with { Transparency = [1, 2, 3] });
        Assert.Equal(samples.ToImage().Pixels, Read(File(head, PlainPng.Chunk("IDAT", data))).Pixels);
    }

    [Fact]
    public void Read_WithAPaletteBeyondItsIndices_TakesItsBeginning()
    {
        var palette = Enumerable.Range(0, 768).Select(i => (byte)i).ToArray();
        var samples = PlainSamples.Random(new(1), 3, 1, isInterlaced: false, 9, 9) with { Palette = palette };
        Assert.Equal(samples.ToImage().Pixels, Read(PlainPng.Encode(samples, new(1))).Pixels);
    }

    [Fact]
    public void Read_OfUnusedBitsInTransparency_MasksThem()
    {
        var samples = new PlainSamples(2, 1, 0, 2, false, [1, 2]) { Transparency = [0, 1] };
        var file = PlainPng.Encode(samples with { Transparency = [0xFF, 0xFD] }, new(1));
        Assert.Equal(samples.ToImage().Pixels, Read(file).Pixels);
        Assert.Equal(0, samples.ToImage().Pixels[3]);
    }

    [Fact]
    public void ReadHeader_SaysWhatTheImageIs()
    {
        var file = PlainPng.Encode(PlainSamples.Random(new(1), 2, 16, isInterlaced: true, 7, 3), new(1));
        var header = PngReader.ReadHeader(new MemoryStream(file, 0, 33));
        Assert.Equal(new(7, 3, 16, PngColourType.Rgb, true), header);
        Assert.Equal((3, 48), (header.Channels, header.BitsPerPixel));
    }

    [Fact]
    public void IsPng_KnowsTheSignatureOnly()
    {
        Assert.True(PngReader.IsPng([.. PlainPng.Signature, 1]));
        Assert.False(PngReader.IsPng(PlainPng.Signature.AsSpan(0, 7)));
        Assert.False(PngReader.IsPng([.. "\uFFFDPNG\r\n\x1a\n"u8]));
    }

    [Fact]
    public void Read_OfAStreamThatFails_PassesTheErrorOn() =>
        Assert.Equal("the disk is gone", Assert.Throws<IOException>(() => PngReader.Read(new FailingStream(PlainPng.Signature))).Message);

    [Fact]
    public void Read_WithALimitOfNothing_IsRefused() =>
        Assert.Throws<ArgumentOutOfRangeException>(() => PngReader.Read(new MemoryStream(), 0));

    private static byte[] File(params byte[][] chunks) =>
        [.. PlainPng.Signature, .. chunks.SelectMany(chunk => chunk), .. PlainPng.Chunk("IEND")];

    private static PixelImage Read(byte[] file) => PngReader.Read(new MemoryStream(file));

    private static (PlainSamples Samples, byte[] Data) Sample(Random random)
    {
        var samples = PlainSamples.Random(random, 6, 8, isInterlaced: false, 6, 5);
        return (samples, PlainPng.Compress(PlainPng.Filtered(samples, random), random));
    }

    private static void AssertRead(PlainSamples samples, Random random, int? filter = null)
    {
        var image = Read(PlainPng.Encode(samples, random, filter));
        Assert.Equal((samples.Width, samples.Height), (image.Width, image.Height));
        Assert.True(samples.ToImage().Pixels.AsSpan().SequenceEqual(image.Pixels), $"{samples}");
    }

    private sealed class SlowStream(byte[] bytes) : MemoryStream(bytes)
    {
        public override int Read(Span<byte> buffer) => base.Read(buffer[..Math.Min(1, buffer.Length)]);
    }

    private sealed class FailingStream(byte[] bytes) : MemoryStream(bytes)
    {
        public override int Read(Span<byte> buffer) => Position < Length ? base.Read(buffer) : throw new IOException("the disk is gone");
    }
}
