using System.Text;
using FractalEngine.Core;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using StbImageSharp;

namespace FractalEngine.Tests.Images;

/// <summary>Images of Radiance, against another library and against bytes made by hand.</summary>
public sealed class RadianceFileTests
{
    [Theory]
    [InlineData(1, 1)]
    [InlineData(7, 3)]
    [InlineData(8, 2)]
    [InlineData(300, 20)]
    public void Write_OfAnyWidth_IsReadByStbAndByItself(int width, int height)
    {
        var image = Random(width, height);
        using var stream = new MemoryStream();
        RadianceFile.Write(image, stream);
        var read = RadianceFile.Read(stream.ToArray(), 1 << 20);

        Assert.Equal((width, height), (read.Width, read.Height));
        // The library takes a row that is not compressed from a wrong place, unless it is the first.
        if (width >= 8 || height == 1)
        {
            Assert.Equal(ImageResultFloat.FromMemory(stream.ToArray(), ColorComponents.RedGreenBlue).Data, read.Pixels);
        }

        for (var i = 0; i < image.Pixels.Length; i++)
        {
            // Half of a step of a mantissa that is at least 128; the greatest one is cut.
            var brightest = image.Pixels.AsSpan(i / 3 * 3, 3).ToArray().Max();
            Assert.Equal(image.Pixels[i], read.Pixels[i], brightest / 255);
        }

        using var again = new MemoryStream();
        RadianceFile.Write(read, again);
        Assert.Equal(stream.ToArray(), again.ToArray());
    }

    [Fact]
    public void Read_OfAFileMadeByHand_HasItsLight()
    {
        // Eight pixels: runs and single bytes. 128 · 2^(129 − 136) is 1.
        byte[] file =
        [
            .. Encoding.ASCII.GetBytes("#?RGBE\n# by hand\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\r\n\n-Y 2 +X 8\n"),
            2, 2, 0, 8, 128 + 8, 128, 4, 64, 0, 1, 2, 128 + 4, 255, 128 + 8, 0, 128 + 8, 129,
            .. Enumerable.Repeat((byte[])[128, 64, 32, 130], 8).SelectMany(static pixel => pixel),
        ];
        var image = RadianceFile.Read(file, 16);

        Assert.Equal(new Vector(1, 0.5, 0), image[0, 0]);
        Assert.Equal(new Vector(1, 2 / 128.0, 0), image[3, 0]);
        Assert.Equal(new Vector(1, 255 / 128.0, 0), image[7, 0]);
        Assert.Equal(new Vector(2, 1, 0.5), image[3, 1]);
    }

    [Fact]
    public void Write_OfEqualPixels_IsShort()
    {
        using var stream = new MemoryStream();
        RadianceFile.Write(new(1024, 512, [.. Enumerable.Repeat(0.3f, 3 * 1024 * 512)]), stream);
        Assert.InRange(stream.Length, 1, 1024 * 512 / 10);
    }

    [Fact]
    public void Write_OfWhatIsNoLight_IsBlackAndOfTheGreatestIsNearlyIt()
    {
        using var stream = new MemoryStream();
        RadianceFile.Write(new(3, 1, [0, -1, 0, float.PositiveInfinity, 0, 0, 1.6e38f, 0, 1e-40f]), stream);
        var image = RadianceFile.Read(stream.ToArray(), 3);
        Assert.Equal([0, 0, 0, 0, 0, 0], image.Pixels[..6]);
        Assert.Equal(1.6e38f, image.Pixels[6], 1e36f);
    }

    [Theory]
    [InlineData("P6\n", "is no image of Radiance: it does not begin with #?RADIANCE", ErrorKind.Input)]
    [InlineData("", "is no image of Radiance: it does not begin with #?RADIANCE", ErrorKind.Input)]
    [InlineData("#?RADIANCE\nFORMAT", "is cut off", ErrorKind.Input)]
    [InlineData("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd", "is not in the FORMAT=32-bit_rle_rgbe", ErrorKind.Input)]
    [InlineData("#?RADIANCE\n\n+Y 1 +X 1\nabcd", "has no size of the form -Y height +X width", ErrorKind.Input)]
    [InlineData("#?RADIANCE\n\n-Y 0 +X 1\nabcd", "has no size of the form -Y height +X width", ErrorKind.Input)]
    [InlineData("#?RADIANCE\n\n-Y 1 +X 2\nabcdefg", "is cut off", ErrorKind.Input)]
    [InlineData("#?RADIANCE\n\n-Y 2000000000 +X 2000000000\nabcd", "is cut off", ErrorKind.Input)]
    [InlineData("#?RADIANCE\n\n-Y 1 +X 5\nabcdefg", "has 5×1 pixels, more than the limit of 4", ErrorKind.Limit)]
    [InlineData("#?RADIANCE\n\n-Y 1 +X 2", "is cut off", ErrorKind.Input)]
    public void Read_OfAFaultyFile_SaysWhatIsWrong(string file, string message, ErrorKind kind)
    {
        var exception = Assert.Throws<FractalEngineException>(() => RadianceFile.Read(Encoding.Latin1.GetBytes(file), 4));
        Assert.Equal((message, kind), (exception.Message, exception.Kind));
    }

    [Fact]
    public void Read_OfRowsOfAnotherLength_IsRefused()
    {
        byte[] file = [.. "#?RADIANCE\n\n-Y 1 +X 8\n"u8, 2, 2, 0, 8, 128 + 9, 0, 0, 0];
        var exception = Assert.Throws<FractalEngineException>(() => RadianceFile.Read(file, 8));
        Assert.Equal("is damaged: a row has another length than the image", exception.Message);
    }

    [Fact]
    public void Read_OfAnyDamage_EndsWithAnImageOrAFault()
    {
        using var stream = new MemoryStream();
        RadianceFile.Write(Random(40, 5), stream);
        var random = new Random(3);
        for (var i = 0; i < 2000; i++)
        {
            var file = stream.ToArray()[..random.Next(1, (int)stream.Length + 1)];
            file[random.Next(file.Length)] = (byte)random.Next(256);
            try
            {
                Assert.NotNull(RadianceFile.Read(file, 1000));
            }
            catch (FractalEngineException)
            {
                // As it should be.
            }
        }
    }

    private static FloatImage Random(int width, int height)
    {
        var random = new Random(width);
        // Runs of equal pixels among others, over many exponents.
        var pixels = new float[3 * width * height];
        for (var i = 0; i < pixels.Length; i++)
        {
            pixels[i] = i >= 3 && random.Next(3) > 0 ? pixels[i - 3] : (float)(random.NextDouble() * Math.Pow(10, random.Next(-6, 6)));
        }

        return new(width, height, pixels);
    }
}
