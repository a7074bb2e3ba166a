using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Core.Images;

namespace FractalEngine.Tests.Benchmarks;

public class ImageErrorTests
{
    [Fact]
    public void PeakSignalToNoiseRatio_OfEqualImages_IsInfinite() =>
        Assert.Equal(double.PositiveInfinity, ImageError.PeakSignalToNoiseRatio(Grey(4, 3, 100), Grey(4, 3, 100)));

    [Theory]
    // 20·log₁₀(255 / difference).
    [InlineData(0, 255, 0)]
    [InlineData(255, 0, 0)]
    [InlineData(100, 101, 48.130803608679)]
    [InlineData(60, 9, 13.979400086720)]
    public void PeakSignalToNoiseRatio_OfImagesThatDifferEverywhere_IsTheLogarithmOfTheDifference(
        byte grey1, byte grey2, double decibels) =>
        Assert.Equal(decibels, ImageError.PeakSignalToNoiseRatio(Grey(3, 2, grey1), Grey(3, 2, grey2)), 1e-11);

    [Fact]
    public void PeakSignalToNoiseRatio_OfImagesThatDifferInOneComponent_IsOfTheMeanSquare()
    {
        var image = Grey(10, 10, 50);
        // One of 300 components is off by 30: the mean square is 3.
        image.Pixels[(4 * 37) + 1] += 30;
        var ratio = ImageError.PeakSignalToNoiseRatio(Grey(10, 10, 50), image);
        Assert.Equal(20 * Math.Log10(255 / Math.Sqrt(3)), ratio, 1e-12);
        Assert.Equal(ratio, ImageError.PeakSignalToNoiseRatio(image, Grey(10, 10, 50)));
    }

    [Fact]
    public void PeakSignalToNoiseRatio_OfImagesThatDifferInAlpha_IsInfinite()
    {
        var image = Grey(2, 2, 50);
        image.Pixels[3] = 0;
        Assert.Equal(double.PositiveInfinity, ImageError.PeakSignalToNoiseRatio(Grey(2, 2, 50), image));
    }

    /// <summary>The mean of the squares is that of the three colours alone: 6 components here.</summary>
    [Theory]
    [InlineData(new byte[] { 40, 20, 30, 255, 40, 50, 60, 7 }, new byte[] { 30, 0, 0, 255, 0, 0, 0, 255 }, 900 / 6.0)]
    [InlineData(new byte[] { 13, 20, 26, 9, 40, 50, 60, 77 }, new byte[] { 3, 0, 4, 255, 0, 0, 0, 255 }, 25 / 6.0)]
    [InlineData(new byte[] { 10, 20, 30, 9, 36, 53, 60, 200 }, new byte[] { 0, 0, 0, 255, 4, 3, 0, 255 }, 25 / 6.0)]
    [InlineData(new byte[] { 5, 25, 25, 255, 45, 45, 65, 7 }, new byte[] { 5, 5, 5, 255, 5, 5, 5, 255 }, 25)]
    [InlineData(new byte[] { 255, 20, 30, 255, 40, 50, 60, 7 }, new byte[] { 245, 0, 0, 255, 0, 0, 0, 255 }, 60_025 / 6.0)]
    public void AbsoluteDifference_OfTwoImages_IsThatOfTheirColours(byte[] reference, byte[] differences, double meanSquare)
    {
        var image = new PixelImage(2, 1, [10, 20, 30, 255, 40, 50, 60, 7]);
        Assert.Equal(
            10 * Math.Log10(255 * 255 / meanSquare), ImageError.PeakSignalToNoiseRatio(image, new(2, 1, reference)), 1e-12);
        var difference = ImageError.AbsoluteDifference(image, new(2, 1, reference));
        Assert.Equal((2, 1), (difference.Width, difference.Height));
        Assert.Equal(differences, difference.Pixels);
    }

    [Theory]
    [InlineData(3, 2)]
    [InlineData(2, 3)]
    // As many pixels.
    [InlineData(1, 4)]
    public void PeakSignalToNoiseRatio_OfImagesOfTwoSizes_Throws(int width, int height) =>
        Assert.Throws<ArgumentException>("image2", () => ImageError.PeakSignalToNoiseRatio(Grey(2, 2, 0), Grey(width, height, 0)));

    [Fact]
    public void Downsample_OfBlackAndWhite_IsHalfTheLightNotHalfTheValue()
    {
        var image = new PixelImage(2, 1, [.. Grey(1, 1, 0).Pixels, .. Grey(1, 1, 255).Pixels]);
        image = new(2, 2, [.. image.Pixels, .. image.Pixels]);
        // This is the sRGB value of half the light of white. The mean of the values would be 128.
        Assert.Equal((188, 188, 188, 255), ImageError.Downsample(image, 2)[0, 0]);
    }

    [Fact]
    public void Downsample_OfOneColour_IsTheSameColour()
    {
        for (var grey = 0; grey < 256; grey++)
        {
            Assert.Equal(Grey(2, 1, (byte)grey).Pixels, ImageError.Downsample(Grey(6, 3, (byte)grey), 3).Pixels);
        }
    }

    [Fact]
    public void DownsampleAsTraced_OfAnEdge_SpreadsItOverTheNeighbours()
    {
        // Twelve pixels, six of them white, become three: a tent has an eighth of its area beyond the border of its pixel. The middle pixel
        // has the edge in its middle.
        byte[] row = [.. Enumerable.Range(0, 12).SelectMany(static x => Grey(1, 1, (byte)(x < 6 ? 0 : 255)).Pixels)];
        var image = new PixelImage(12, 12, [.. Enumerable.Repeat(row, 12).SelectMany(static pixels => pixels)]);
        Assert.Equal(188, ImageError.DownsampleAsTraced(image, 4)[1, 1].Red);
        var shifted = new PixelImage(8, 8, [.. Enumerable.Repeat(row[8..40], 8).SelectMany(static pixels => pixels)]);
        // sRGB of an eighth, and of seven eighths.
        Assert.Equal((99, 240), (ImageError.DownsampleAsTraced(shifted, 4)[0, 1].Red, ImageError.DownsampleAsTraced(shifted, 4)[1, 1].Red));
    }

    [Fact]
    public void Difference_IsGreyWhereNothingDiffers()
    {
        var difference = ImageError.Difference(Grey(2, 1, 100), Grey(2, 1, 101), 8);
        Assert.Equal((120, 120, 120, 255), difference[0, 0]);
        Assert.Equal((128, 128, 128, 255), ImageError.Difference(Grey(1, 1, 7), Grey(1, 1, 7), 8)[0, 0]);
        Assert.Equal(255, ImageError.Difference(Grey(1, 1, 255), Grey(1, 1, 0), 8)[0, 0].Red);
    }

    [Fact]
    public void Downsample_OfFourColours_KeepsTheirPlaces()
    {
        // Each colour fills 2 × 2 pixels.
        byte[][] colours = [[10, 20, 30, 255], [40, 50, 60, 255], [70, 80, 90, 255], [100, 110, 120, 255]];
        byte[] Row(int left, int right) => [.. colours[left], .. colours[left], .. colours[right], .. colours[right]];
        var shrunk = ImageError.Downsample(new(4, 4, [.. Row(0, 1), .. Row(0, 1), .. Row(2, 3), .. Row(2, 3)]), 2);
        Assert.Equal((2, 2), (shrunk.Width, shrunk.Height));
        Assert.Equal(colours.SelectMany(colour => colour), shrunk.Pixels);
    }

    private static PixelImage Grey(int width, int height, byte value) =>
        new(width, height, [.. Enumerable.Range(0, 4 * width * height).Select(i => i % 4 == 3 ? byte.MaxValue : value)]);
}
