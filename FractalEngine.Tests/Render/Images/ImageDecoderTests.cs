using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Images;

/// <summary>Files of every kind in the standard, written by <see cref="PlainPng"/> from random samples: each pixel is exact.</summary>
public class ImageDecoderTests
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
    public void Read_WithAPaletteBeyondItsIndices_TakesItsBeginning()
    {
        var palette = Enumerable.Range(0, 768).Select(i => (byte)i).ToArray();
        var samples = PlainSamples.Random(new(1), 3, 1, isInterlaced: false, 9, 9) with { Palette = palette };
        Assert.Equal(samples.ToImage().Pixels, Read(PlainPng.Encode(samples, new(1))).Pixels);
    }

    [Fact]
    public void Read_OfAnIndexBeyondThePalette_IsBlackAndInvisible()
    {
        var samples = new PlainSamples(2, 1, 3, 8, false, [0, 1]) { Palette = [1, 2, 3] };
        Assert.Equal([1, 2, 3, 255, 0, 0, 0, 0], Read(PlainPng.Encode(samples, new(1))).Pixels);
    }

    [Fact]
    public void Read_OfAnAnimation_GivesItsFirstImage()
    {
        var animation = new ApngAnimation(10);
        animation.Add(new(1, 1, [1, 2, 3, 4]));
        animation.Add(new(1, 1, [5, 6, 7, 8]));
        using var file = new MemoryStream();
        animation.Write(file);
        Assert.Equal([1, 2, 3, 4], Read(file.ToArray()).Pixels);
    }

    [Fact]
    public void Read_OfAJpeg_GivesItsColours()
    {
        var image = Read(Jpeg);
        Assert.Equal((8, 8), (image.Width, image.Height));
        Assert.All(Enumerable.Range(0, 64), i =>
        {
            var (red, green, blue, alpha) = image[i % 8, i / 8];
            Assert.InRange(red, 197, 203);
            Assert.InRange(green, 97, 103);
            Assert.InRange(blue, 47, 53);
            Assert.Equal(255, alpha);
        });
    }

    [Theory]
    [InlineData(24, new byte[] { 10, 20, 30, 40, 50, 60, 0, 0 }, new byte[] { 30, 20, 10, 255, 60, 50, 40, 255 })]
    [InlineData(32, new byte[] { 10, 20, 30, 99, 40, 50, 60, 0 }, new byte[] { 30, 20, 10, 99, 60, 50, 40, 0 })]
    [InlineData(16, new byte[] { 0x00, 0x7C, 0x1F, 0x00 }, new byte[] { 255, 0, 0, 255, 0, 0, 255, 255 })]
    public void Read_OfABmp_GivesItsPixels(byte bits, byte[] row, byte[] pixels)
    {
        byte[] header = [.. "BM"u8, 62, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 1, 0, bits, 0];
        Assert.Equal(pixels, Read([.. header, .. new byte[24], .. row]).Pixels);
    }

    [Theory]
    [InlineData(2, 24, new byte[] { 1, 2, 3, 4, 5, 6 }, new byte[] { 3, 2, 1, 255, 6, 5, 4, 255 })]
    [InlineData(2, 32, new byte[] { 1, 2, 3, 9, 4, 5, 6, 8 }, new byte[] { 3, 2, 1, 9, 6, 5, 4, 8 })]
    [InlineData(3, 8, new byte[] { 7, 8 }, new byte[] { 7, 7, 7, 255, 8, 8, 8, 255 })]
    [InlineData(10, 24, new byte[] { 0x81, 1, 2, 3 }, new byte[] { 3, 2, 1, 255, 3, 2, 1, 255 })]
    public void Read_OfATga_GivesItsPixels(byte type, byte bits, byte[] data, byte[] pixels) =>
        Assert.Equal(pixels, Read([0, 0, type, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, bits, 0, .. data], isTga: true).Pixels);

    [Fact]
    public void Read_OfATgaWithAPalette_TakesItsFirstColourForThoseThatItLacks() => Assert.Equal(
        [3, 2, 1, 255, 6, 5, 4, 255, 3, 2, 1, 255],
        Read([0, 1, 1, 0, 0, 2, 0, 24, 0, 0, 0, 0, 3, 0, 1, 0, 8, 0, 1, 2, 3, 4, 5, 6, 0, 1, 2], isTga: true).Pixels);

    /// <summary>An image of 8×8 pixels of one colour, (200, 100, 50), without subsampling.</summary>
    internal static byte[] Jpeg => Convert.FromBase64String(
        "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMUFRUVDA8XGBYUGBIUFRT/"
        + "2wBDAQMEBAUEBQkFBQkUDQsNFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBT/wAARCAAIAAgDAREAAhEBAxEB/8QA"
        + "FAABAAAAAAAAAAAAAAAAAAAABP/EABQQAQAAAAAAAAAAAAAAAAAAAAD/xAAVAQEBAAAAAAAAAAAAAAAAAAAHCP/EABQRAQAAAAAAAAAAAAAAAAAAAAD/2gAM"
        + "AwEAAhEDEQA/ACA9SD//2Q==");

    private static byte[] File(params byte[][] chunks) =>
        [.. PlainPng.Signature, .. chunks.SelectMany(chunk => chunk), .. PlainPng.Chunk("IEND")];

    private static PixelImage Read(byte[] file, bool isTga = false) => ImageFile.Load(new MemoryStream(file), isTga);

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
}
