using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Render;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render.Views;

/// <summary>Tests images that are shown over a frame.</summary>
[Collection(GlTests.Name)]
public class ImageLayerTests
{
    private const int Width = 16;
    private const int Height = 16;

    [SkippableFact]
    public void Capture_WithAnOpaqueImage_IsTheImage()
    {
        // Every value of every component, so that no row, column or level is lost.
        var image = Image((x, y) => ((byte)((16 * y) + x), (byte)(255 - (16 * y) - x), (byte)((16 * x) + y)));
        Assert.Equal(image.Pixels, Draw(Colour.White, new(image, 1)).Pixels);
    }

    [SkippableFact]
    public void Capture_WithAHalfTransparentImage_MixesLight()
    {
        // Half of the light of white is the sRGB value 188.
        var mixed = Draw(Colour.Black, new(Image(static (_, _) => (255, 255, 255)), 0.5));
        Assert.InRange(mixed[3, 5].Red, 187, 189);
        Assert.Equal(255, mixed[3, 5].Alpha);
        Assert.Equal((0, 0, 0, 255), Draw(Colour.Black, new(Image(static (_, _) => (255, 255, 255)), 0))[3, 5]);
    }

    [SkippableFact]
    public void Capture_AfterAnImage_IsTheFrameAgain()
    {
        using var context = new SharedContext();
        using var frame = new FrameRenderer(context);
        frame.Draw(null, RenderScenes.FrontView, Width, Height, new() { Background = new(0.2, 0.4, 0.6) });
        var before = frame.Capture();
        frame.Capture(new ImageLayer(Image(static (_, _) => (255, 0, 0)), 1), overlay: OverlayPanel.OfText(OverlayAnchor.TopLeft, "a"));
        Assert.Equal((0, 255, 0, 255), frame.Capture(new ImageLayer(Image(static (_, _) => (0, 255, 0)), 1))[8, 8]);
        Assert.Equal(before.Pixels, frame.Capture().Pixels);
        Assert.Throws<ArgumentException>(() => frame.Capture(new ImageLayer(new(1, 1, new byte[4]), 1)));
    }

    private static PixelImage Draw(Colour background, ImageLayer layer)
    {
        using var context = new SharedContext();
        using var frame = new FrameRenderer(context);
        frame.Draw(null, RenderScenes.FrontView, Width, Height, new() { Background = background });
        var image = frame.Capture(layer);
        context.Resources.ThrowOnError("drawing");
        return image;
    }

    private static PixelImage Image(Func<int, int, (byte Red, byte Green, byte Blue)> colour)
    {
        var pixels = new byte[4 * Width * Height];
        for (var i = 0; i < Width * Height; i++)
        {
            var (red, green, blue) = colour(i % Width, i / Width);
            (pixels[4 * i], pixels[(4 * i) + 1], pixels[(4 * i) + 2], pixels[(4 * i) + 3]) = (red, green, blue, 255);
        }

        return new(Width, Height, pixels);
    }
}
