using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render;

/// <summary>What is out of focus is blurred over the circle of confusion of a thin lens, drawn and traced alike.</summary>
[Collection(GlTests.Name)]
public sealed class LensTests
{
    private const int Width = 120;
    private const int Height = 80;

    // Depth of the plate, whose right edge lies 30 pixels to the right of the middle.
    private const double Depth = 2;
    private const double Edge = 30;

    [SkippableTheory]
    [InlineData(0.8, 1, 16)]
    [InlineData(0.8, 5, 9.6)]
    [InlineData(0.3, 1.25, 3.6)]
    [InlineData(0.8, 2, 0)]
    public void Edge_OutOfFocus_IsBlurredOverTheCircleOfConfusion(double aperture, double focus, double pixels)
    {
        // The part of the lens from which a point is seen moves by A·|1/F − 1/D| at unit depth; 40 pixels are a unit.
        Assert.Equal(pixels, 40 * aperture * Math.Abs((1 / focus) - (1 / Depth)), 1e-9);
        var view = ViewOf(aperture, focus);
        var (drawn, traced) = (Draw(view, 65), Trace(view, 64));
        for (var x = 75; x < 105; x++)
        {
            var expected = Coverage(Edge - (x + 0.5 - (Width / 2.0)), pixels / 2);
            Assert.True(Math.Abs(drawn[x] - expected) < 0.06, $"drawn, {x}: {drawn[x]}, not {expected}");
            Assert.True(Math.Abs(traced[x] - expected) < 0.04, $"traced, {x}: {traced[x]}, not {expected}");
        }
    }

    [SkippableFact]
    public void Frame_BeforeOthersAreGathered_IsSharp()
    {
        var sharp = Draw(ViewOf(0, 1), 1);
        Assert.Equal(sharp, Draw(ViewOf(0.8, 1), 1));
        Assert.NotEqual(sharp, Draw(ViewOf(0.8, 1), 2));
    }

    [Fact]
    public void LensPoints_FillTheDiscEvenly()
    {
        var view = ViewOf(3, 1);
        const int Side = 200;
        var points = Enumerable.Range(0, Side * Side)
            .Select(i => view.LensPoint((((i % Side) + 0.5) / Side, ((i / Side) + 0.5) / Side))).ToArray();
        Assert.All(points, point => Assert.InRange(Math.Sqrt((point.Right * point.Right) + (point.Up * point.Up)), 0, 1.5));
        // Parts of the area: a disc within, and a half.
        Assert.Equal(0.25, points.Count(p => (p.Right * p.Right) + (p.Up * p.Up) < 0.75 * 0.75) / (double)points.Length, 0.005);
        Assert.Equal(0.5, points.Count(p => (0.6 * p.Right) + (0.8 * p.Up) < 0) / (double)points.Length, 0.005);
        Assert.Equal((0, 0), view.LensPoint((0.5, 0.5)));
    }

    [Fact]
    public void View_OrthographicOrDeepInAFractal_HasNoLens()
    {
        var view = ViewOf(1, 1);
        Assert.True(view.HasLens);
        Assert.False((view with { Projection = Projection.Orthographic }).HasLens);
        Assert.False((view with { DeepZoom = new(0, [], 0) }).HasLens);
    }

    private static View ViewOf(double aperture, double focus) => new(
        new Camera(new(0, 0, -Depth), Vector.Zero, 90) { Aperture = aperture, FocusDepth = focus }, Projection.Perspective);

    private static LoadedScene Scene =>
        RenderScenes.WhiteOnBlack(RenderScenes.Square(Edge / (Height / 2.0) * Depth), Transformation.Identity);

    /// <summary>The light of the middle row.</summary>
    private static double[] Draw(View view, int frames)
    {
        using var context = new SharedContext();
        using var renderer = new FrameRenderer(context);
        var settings = new RenderSettings { KeepsLight = true };
        using var scene = new SceneRenderer(context, DrawableScene.Prepare(Scene, settings));
        renderer.Draw(scene, view, Width, Height, settings);
        while (renderer.GatheredCount < frames)
        {
            renderer.Gather(scene, view, settings);
        }

        var image = renderer.CaptureLight();
        return [.. Enumerable.Range(0, Width).Select(x => image[x, Height / 2].Y)];
    }

    private static double[] Trace(View view, int samples)
    {
        var tracer = new PathTracer(Scene, view, Width, Height) { BounceLimit = 1 };
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample();
        }

        // Rows in the middle are alike.
        return [.. Enumerable.Range(0, Width).Select(x => Enumerable.Range(30, 20).Average(y => tracer.RadianceAt(x, y).Y))];
    }

    /// <summary>The part of a disc about a pixel, itself behind a tent, that lies before a distance from it.</summary>
    private static double Coverage(double distance, double radius)
    {
        const int Steps = 400;
        var sum = 0.0;
        for (var i = 0; i < Steps; i++)
        {
            var moved = (2 * (i + 0.5) / Steps) - 1;
            var u = Math.Clamp((distance - moved) / Math.Max(radius, 1e-9), -1, 1);
            sum += (1 - Math.Abs(moved)) * 2 / Steps * (0.5 + (((u * Math.Sqrt(1 - (u * u))) + Math.Asin(u)) / Math.PI));
        }

        return sum;
    }
}
