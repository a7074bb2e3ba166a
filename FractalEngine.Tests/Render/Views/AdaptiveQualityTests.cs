using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Colliders;
using static System.FormattableString;

namespace FractalEngine.Tests.Render.Views;

/// <summary>Detail of frames that take long while the camera or bodies move.</summary>
[Collection(GlTests.Name)]
public sealed class AdaptiveQualityTests
{
    private const int Width = 1280;
    private const int Height = 720;

    [Theory]
    [InlineData(true, 8)]
    [InlineData(false, 24)]
    public void Detail_OfSlowFrames_EndsWhereItsProxiesAreStillRight(bool hasShadows, double coarsest)
    {
        Assert.Equal(coarsest, CoarsestOf(new() { Shadows = hasShadows }).Culling!.MinProjectedSize);
        // Whoever switches shadows on has what they need at once.
        var quality = new AdaptiveQuality();
        Coarsen(quality, new() { Shadows = false });
        Assert.Equal(8, quality.Adapt(new()).Culling!.MinProjectedSize);
    }

    [Theory]
    [InlineData(3, 1, 0.02, 1)]
    // Nine times as many take 0.27 s, and 9 / 4 times 0.0675 s.
    [InlineData(3, 1, 0.03, 2)]
    [InlineData(3, 1, 0.2, 3)]
    [InlineData(6, 2, 0.02, 2)]
    [InlineData(2, 1, 0.0625, 1)]
    [InlineData(1, 1, 9, 1)]
    public void Refine_OfACoarseFrame_HasPixelsThatTakeAQuarterOfASecond(int size, int smallest, double seconds, int expected) =>
        Assert.Equal(expected, AdaptiveQuality.Refine(
            new() { PixelSize = size }, smallest, TimeSpan.FromSeconds(seconds), TimeSpan.FromSeconds(0.25)).PixelSize);

    [Fact]
    public void Pixels_OfSlowFrames_BecomeLargerWhereTheyMay_AndSmallerAgain()
    {
        var (quality, settings) = (new AdaptiveQuality(), new RenderSettings());
        Assert.Equal([1, 1, 1], PixelSizes(mayEnlarge: false, 0.08, 3));
        Assert.Equal([2, 3, 3], PixelSizes(mayEnlarge: true, 0.06, 3));
        // Detail as it was: larger pixels come first.
        Assert.Equal(3, quality.Adapt(settings, mayEnlarge: true).Culling!.MinProjectedSize);
        Assert.Equal(0, quality.Adapt(settings, mayEnlarge: true).Samples);
        // Bodies that move are shown with all pixels.
        Assert.Equal(1, quality.Adapt(settings).PixelSize);
        // Nine times 30 ms would be slow, four times 10 ms are not.
        Assert.Equal([3, 3], PixelSizes(mayEnlarge: true, 0.03, 2));
        Assert.Equal([2, 1, 1], PixelSizes(mayEnlarge: true, 0.01, 3));

        int[] PixelSizes(bool mayEnlarge, double seconds, int count) => [.. Enumerable.Range(0, count).Select(_ =>
        {
            for (var i = 0; i < 4; i++)
            {
                quality.Adapt(settings, mayEnlarge);
                quality.RecordFrameTime(TimeSpan.FromSeconds(seconds));
            }

            return quality.Adapt(settings, mayEnlarge).PixelSize;
        })];
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Mountain_InSlowFrames_HasHardlyADotOfShadow()
    {
        // As in the playground, from where the dots were seen.
        var scene = RenderScenes.Scene(
            new() { Lights = [new SunLight(new(0.7, -0.8, 0.3), Colour.White, 1, 0)], Background = Colour.Black },
            (new FractalModel(AssetFractals.Load("terrain")) { SourcePath = "terrain.fdo" },
                new(new(0, 1.1, 5), Vector.Zero, new(15, 7, 12)), Colour.White));
        var view = new View(new(new(-9, 8.2, -24), CameraFraming.LookRotation(new(9, -5.2, 29)), 44), Projection.Perspective);
        var slow = CoarsestOf(new() { AmbientOcclusion = false });
        var (fine, shown, tooCoarse) = (Dots(3), Dots(slow.Culling!.MinProjectedSize), Dots(24));
        // What there is in fine frames too are mostly gaps between tiles, which are dark in traced images as well.
        Assert.True(
            tooCoarse > fine + 200 && shown - fine < 0.2 * (tooCoarse - fine),
            Invariant($"{shown} dots, {fine} with fine detail, {tooCoarse} with coarser"));

        int Dots(double minProjectedSize)
        {
            var settings = slow with { Culling = slow.Culling! with { MinProjectedSize = minProjectedSize } };
            return CountDots(
                RenderScenes.Draw(scene, view, Width, Height, settings),
                RenderScenes.Draw(scene, view, Width, Height, settings with { Shadows = false }));
        }
    }

    private static RenderSettings CoarsestOf(RenderSettings settings)
    {
        var quality = new AdaptiveQuality();
        Coarsen(quality, settings);
        return quality.Adapt(settings);
    }

    private static void Coarsen(AdaptiveQuality quality, RenderSettings settings)
    {
        for (var i = 0; i < 100; i++)
        {
            quality.Adapt(settings);
            quality.RecordFrameTime(TimeSpan.FromSeconds(1));
        }
    }

    /// <summary>Counts dark pixels among lit ones.</summary>
    private static int CountDots(PixelImage image, PixelImage unshaded)
    {
        bool IsDark(int x, int y) => unshaded[x, y].Red - image[x, y].Red > 40;
        var dots = 0;
        for (var y = 3; y < Height - 3; y++)
        {
            for (var x = 3; x < Width - 3; x++)
            {
                var neighbours = 0;
                for (var i = 0; IsDark(x, y) && i < 49; i++)
                {
                    neighbours += IsDark(x - 3 + (i % 7), y - 3 + (i / 7)) ? 1 : 0;
                }

                dots += neighbours is > 0 and <= 5 ? 1 : 0;
            }
        }

        return dots;
    }
}
