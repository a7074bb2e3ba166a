using FractalEngine.App.Jobs;
using FractalEngine.App.Shell;
using FractalEngine.Core.Images;

namespace FractalEngine.Tests.App.Jobs;

/// <summary>Tests how the difference of two images is measured and drawn.</summary>
public sealed class ImageDifferenceTests
{
    private static readonly PixelImage Image = new(2, 1, [10, 20, 30, 255, 40, 50, 60, 7]);

    /// <summary>The mean of the squares is that of the three colours alone: 6 components here.</summary>
    [Theory]
    [InlineData(new byte[] { 40, 20, 30, 255, 40, 50, 60, 7 }, new byte[] { 30, 0, 0, 255, 0, 0, 0, 255 }, 900 / 6.0)]
    [InlineData(new byte[] { 10, 20, 30, 9, 36, 53, 60, 200 }, new byte[] { 0, 0, 0, 255, 4, 3, 0, 255 }, 25 / 6.0)]
    [InlineData(new byte[] { 5, 25, 25, 255, 45, 45, 65, 7 }, new byte[] { 5, 5, 5, 255, 5, 5, 5, 255 }, 25)]
    [InlineData(new byte[] { 255, 20, 30, 255, 40, 50, 60, 7 }, new byte[] { 245, 0, 0, 255, 0, 0, 0, 255 }, 60_025 / 6.0)]
    public void Between_TwoImages_IsThePeakRatioOfTheirColours(byte[] reference, byte[] differences, double meanSquare)
    {
        var difference = ImageDifference.Between(Image, new(2, 1, reference));
        Assert.Equal(10 * Math.Log10(255 * 255 / meanSquare), difference.PeakSignalToNoise, 1e-12);
        Assert.Equal((2, 1), (difference.Image.Width, difference.Image.Height));
        Assert.Equal(differences, difference.Image.Pixels);
    }

    [Fact]
    public void Between_EqualColours_IsInfinite() => Assert.Equal(
        double.PositiveInfinity, ImageDifference.Between(Image, new(2, 1, [10, 20, 30, 0, 40, 50, 60, 0])).PeakSignalToNoise);

    [Theory]
    [InlineData(1, 2, "the reference has 1×2 pixels, and the image 2×1")]
    [InlineData(2, 2, "the reference has 2×2 pixels, and the image 2×1")]
    [InlineData(1, 1, "the reference has 1×1 pixels, and the image 2×1")]
    public void Between_ImagesOfOtherSizes_NamesBoth(int width, int height, string message) => Assert.Equal(
        message,
        Assert.Throws<UsageException>(() => ImageDifference.Between(Image, new(width, height, new byte[4 * width * height]))).Message);
}
