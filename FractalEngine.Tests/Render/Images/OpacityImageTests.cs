using FractalEngine.Core.Images;
using FractalEngine.Render.Images;

namespace FractalEngine.Tests.Render.Images;

/// <summary>Opacity of one image in the colours of another, texel by texel.</summary>
public class OpacityImageTests
{
    [Theory]
    [InlineData(1, 1)]
    [InlineData(3, 2)]
    [InlineData(7, 12)]
    [InlineData(16, 5)]
    public void Combine_OfAnyTwoSizes_TakesTheOpacityAtTheSamePlace(int opacityWidth, int opacityHeight)
    {
        const int Width = 6;
        const int Height = 10;
        var colours = Image(Width, Height, static (x, y) => ((byte)x, (byte)y, 77, 255));
        var opacity = Image(opacityWidth, opacityHeight, static (x, y) => (9, 9, 9, (byte)(10 + (20 * x) + y)));

        var combined = OpacityImage.Combine(colours, opacity);

        Assert.Equal((Width, Height), (combined.Width, combined.Height));
        for (var y = 0; y < Height; y++)
        {
            for (var x = 0; x < Width; x++)
            {
                var alpha = (byte)(10 + (20 * (x * opacityWidth / Width)) + (y * opacityHeight / Height));
                Assert.Equal([(byte)x, (byte)y, 77, alpha], combined.Pixels.AsSpan(4 * ((y * Width) + x), 4).ToArray());
            }
        }
    }

    [Fact]
    public void Combine_WithoutColours_IsWhiteOfTheSizeOfTheOpacity()
    {
        var combined = OpacityImage.Combine(null, Image(2, 1, static (x, _) => ((byte)(x * 255), 0, 0, 255)));

        // All of it is opaque, so that its lightness counts: 21 % for red.
        Assert.Equal((2, 1), (combined.Width, combined.Height));
        Assert.Equal([255, 255, 255, 0, 255, 255, 255, 54], combined.Pixels);
    }

    [Fact]
    public void Combine_OfTwoOpacities_TakesTheSmaller()
    {
        var colours = Image(2, 1, static (x, _) => (1, 2, 3, (byte)(x == 0 ? 40 : 200)));
        var combined = OpacityImage.Combine(colours, Image(2, 1, static (_, _) => (0, 0, 0, 100)));

        Assert.Equal([1, 2, 3, 40, 1, 2, 3, 100], combined.Pixels);
    }

    private static PixelImage Image(int width, int height, Func<int, int, (byte, byte, byte, byte)> texel)
    {
        var pixels = new byte[4 * width * height];
        for (var i = 0; i < width * height; i++)
        {
            (pixels[4 * i], pixels[(4 * i) + 1], pixels[(4 * i) + 2], pixels[(4 * i) + 3]) = texel(i % width, i / width);
        }

        return new(width, height, pixels);
    }
}
