using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Render.Images;

namespace FractalEngine.Tests.Render.Images;

/// <summary>Tests what two images on black and on white say about the opacity of each pixel, against the blending that made them.</summary>
public class MattingTests
{
    [Fact]
    public void Combine_OfEqualPixels_IsOpaqueAndUnchanged()
    {
        byte[] pixels = [.. Enumerable.Range(0, 256).SelectMany(level => new[] { (byte)level, (byte)(255 - level), (byte)(level ^ 7),
            (byte)255 })];
        var image = new PixelImage(16, 16, pixels);
        Assert.Equal(pixels, Matting.Combine(image, image).Pixels);
    }

    [Fact]
    public void Combine_OfNothing_IsClear()
    {
        var combined = Matting.Combine(new(2, 1, [0, 0, 0, 255, 0, 0, 0, 255]), new(2, 1, [255, 255, 255, 255, 255, 255, 255, 255]));
        Assert.Equal(new byte[8], combined.Pixels);
        Assert.Equal((2, 1), (combined.Width, combined.Height));
    }

    /// <summary>
    /// The colour and the opacity of a surface come back from its two blends. Rounding to 256 values leaves less of a dark colour behind
    /// little opacity: the tolerance is what half a value on either side makes of it.
    /// </summary>
    [Fact]
    public void Combine_OfBlends_FindsColourAndOpacity()
    {
        byte[] levels = [0, 1, 20, 90, 128, 200, 254, 255];
        foreach (byte red in levels)
        {
            foreach (byte green in levels)
            {
                foreach (double opacity in (double[])[0.25, 0.5, 0.75, 0.95])
                {
                    byte[] colour = [red, green, 60];
                    byte[] black = [.. colour.Select(level => Blend(level, 0, opacity)), 255];
                    byte[] white = [.. colour.Select(level => Blend(level, 1, opacity)), 255];
                    byte[] combined = [.. Matting.Combine(new(1, 1, black), new(1, 1, white)).Pixels];
                    // A value of white is up to 0.009 of light.
                    Assert.InRange(combined[3], (255 * opacity) - 3, (255 * opacity) + 3);
                    for (int channel = 0; channel < 3; channel++)
                    {
                        double step = Math.Max(Linear(Math.Min(255, black[channel] + 1)) - Linear(black[channel]), 1e-4);
                        double slack = ((step / opacity) + (0.02 * Linear(colour[channel]))) + (0.009 * Linear(colour[channel]) / opacity);
                        Assert.InRange(Linear(combined[channel]), Linear(colour[channel]) - slack, Linear(colour[channel]) + slack);
                    }
                }
            }
        }
    }

    /// <summary>The channel that lets through most decides, whichever it is.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(2)]
    public void Combine_OfOneChannelThatDiffers_TakesItsOpacity(int channel)
    {
        byte[] black = [0, 0, 0, 255];
        byte[] white = [9, 9, 9, 255];
        white[channel] = 188;
        // 188 is half of the light of white.
        Assert.Equal([0, 0, 0, 128], Matting.Combine(new(1, 1, black), new(1, 1, white)).Pixels.Select(value => (int)value), (a,
            b) => Math.Abs(a - b) <= 1);
    }

    /// <summary>The stored value is the nearest in linear light, from the darkest to the brightest.</summary>
    [Fact]
    public void Combine_OfHalfOpacity_RoundsToTheNearestValue()
    {
        for (int level = 0; level < 188; level++)
        {
            // White more by half of its light, in one channel that decides.
            byte[] combined = [.. Matting.Combine(new(1, 1, [(byte)level, 0, 0, 255]), new(1, 1, [(byte)level, 188, 0, 255])).Pixels];
            double light = Linear(level) / (1 - Linear(188));
            int nearest = Enumerable.Range(0, 256).MinBy(value => Math.Abs(Linear(value) - light));
            Assert.Equal((level, nearest), (level, combined[0]));
        }
    }

    private static double Linear(int level) => new Colour(level / 255.0, 0, 0).ToLinear().Red;

    private static byte Blend(byte level, double background, double opacity)
    {
        double light = (opacity * Linear(level)) + ((1 - opacity) * background);
        return (byte)Enumerable.Range(0, 256).MinBy(value => Math.Abs(Linear(value) - light));
    }
}
