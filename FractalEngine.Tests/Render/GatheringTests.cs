using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render;

/// <summary>The mean of frames that are moved by parts of a pixel.</summary>
[Collection(GlTests.Name)]
public sealed class GatheringTests
{
    private const int Width = 120;
    private const int Height = 80;

    [SkippableTheory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void Gather_EdgeBetweenPixels_IsThatOfAPixelBehindATent(Projection projection)
    {
        // The right edge of a square stands a third of a pixel to the right of a pixel's centre.
        const double Edge = 80.5 + (1.0 / 3);
        var view = new View(new Camera(new(0, 0, -1), Vector.Zero, 90), projection) { OrthographicHeight = 2 };
        var half = 2 * (Edge - (Width / 2.0)) / Height;
        var image = Draw(RenderScenes.WhiteOnBlack(RenderScenes.Square(half), Transformation.Identity), view, 64);
        foreach (var x in (int[])[77, 78, 79, 80, 81, 82, 83])
        {
            var expected = CoverageBefore(Edge - (x + 0.5));
            Assert.Equal(expected, Linear(image[x, Height / 2].Green), 0.03);
            // And the upper edge alike.
            Assert.Equal(expected, Linear(image[Width / 2, (Height / 2) - 1 - (x - (Width / 2))].Green), 0.03);
        }
    }

    [SkippableFact]
    public void Gather_TurnedByAnEighthOfAPixel_HardlyChanges()
    {
        var scene = LoadedScene.Of(new Scene { Objects = [new(RenderScenes.Menger(3).Fractal) { Colour = Colour.White }] });
        var view = View.Of(scene, (double)Width / Height);
        var angle = 2 * view.HalfHeight / Height / 8;
        var turned = view with { Camera = view.Camera with { Rotation = view.Camera.Rotation + new Vector(angle, angle, 0) } };
        var plain = CountChanged(Draw(scene, view, 1), Draw(scene, turned, 1));
        var gathered = CountChanged(Draw(scene, view, 16), Draw(scene, turned, 16));
        Assert.InRange(plain, 100, Width * Height);
        Assert.InRange(gathered, 0, plain / 4);
    }

    [SkippableTheory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void Gather_InstancesSmallerThanPixels_CoverAllThatTheyCoverTogether(Projection projection)
    {
        // Nine squares make one, at every level: where none of their samples were drawn, the background would show.
        var parts = Enumerable.Range(0, 9).Select(static i => new Transformation(
            new((i % 3) - 1, (i / 3) - 1, 0), Vector.Zero, new(1.0 / 3, 1.0 / 3, 1.0 / 3))).ToImmutableArray();
        var fractal = new Fractal(
            new FractalDescription([new Repetition([new TransformationSet(parts)], 6)], Composition.Affine), RenderScenes.Square(1.5));
        var scene = RenderScenes.Scene(
            new Scene { Background = Colour.Black, Lights = [RenderScenes.FullLight] },
            (new FractalModel(fractal) { SourcePath = "squares.fdo" }, Transformation.Identity, Colour.White));
        var view = new View(new Camera(new(0, 0, -0.9), Vector.Zero, 90), projection) { OrthographicHeight = 1.8 };
        Assert.Equal(0, RenderScenes.CountDifferent(Draw(scene, view, 8), (255, 255, 255, 255)));
    }

    [SkippableFact]
    public void Gather_EvenBackground_KeepsItsBits()
    {
        using var context = new SharedContext();
        using var frames = new FrameRenderer(context);
        using var scene = new SceneRenderer(context, DrawableScene.Prepare(LoadedScene.Of(new Scene()), new()));
        foreach (var grey in Enumerable.Range(0, 16).Select(static i => i * 17 / 255.0))
        {
            var view = RenderScenes.FrontView with { Background = new(grey, 1 - grey, 0.5) };
            frames.Draw(scene, view, 8, 8, new());
            var before = frames.Capture();
            for (var i = 1; i < 20; i++)
            {
                frames.Gather(scene, view, new());
            }

            Assert.Equal(20, frames.GatheredCount);
            Assert.Equal(before.Pixels, frames.Capture().Pixels);
        }
    }

    [SkippableFact]
    public void Gather_LargerPixels_KeepsTheSizeOfTheFrame()
    {
        using var context = new SharedContext();
        using var frames = new FrameRenderer(context);
        using var scene = new SceneRenderer(
            context, DrawableScene.Prepare(RenderScenes.WhiteOnBlack(RenderScenes.Sphere(9), Transformation.Identity), new()));
        var settings = new RenderSettings { PixelSize = 3, Samples = 0 };
        frames.Draw(scene, RenderScenes.FrontView, Width, Height, settings);
        var first = frames.Capture();
        for (var i = 1; i < 8; i++)
        {
            frames.Gather(scene, RenderScenes.FrontView, settings);
        }

        var gathered = frames.Capture();
        Assert.Equal((Width, Height), (gathered.Width, gathered.Height));
        var (mean, _) = RenderScenes.Difference(first, gathered);
        Assert.InRange(mean, 1e-3, 3);
    }

    [SkippableFact]
    public void Gather_ThenAnotherFrame_ShowsThatAlone()
    {
        using var context = new SharedContext();
        using var frames = new FrameRenderer(context);
        using var scene = new SceneRenderer(
            context, DrawableScene.Prepare(RenderScenes.WhiteOnBlack(RenderScenes.Sphere(9), Transformation.Identity), new()));
        Assert.Throws<InvalidOperationException>(() => frames.Gather(scene, RenderScenes.FrontView, new()));
        frames.Draw(scene, RenderScenes.FrontView, 40, 30, new());
        var first = frames.Capture();
        frames.Gather(scene, RenderScenes.FrontView, new());
        frames.Gather(scene, RenderScenes.FrontView, new());
        var gathered = frames.Capture();
        Assert.NotEqual(first.Pixels, gathered.Pixels);
        // Another size, too.
        frames.Draw(scene, RenderScenes.FrontView, 20, 30, new());
        frames.Gather(scene, RenderScenes.FrontView, new());
        frames.Draw(scene, RenderScenes.FrontView, 40, 30, new());
        Assert.Equal(1, frames.GatheredCount);
        Assert.Equal(first.Pixels, frames.Capture().Pixels);
        frames.Gather(scene, RenderScenes.FrontView, new());
        frames.Gather(scene, RenderScenes.FrontView, new());
        Assert.Equal(gathered.Pixels, frames.Capture().Pixels);
    }

    private static PixelImage Draw(LoadedScene scene, View view, int frames)
    {
        using var context = new SharedContext();
        using var renderer = new FrameRenderer(context);
        var settings = new RenderSettings();
        using var sceneRenderer = new SceneRenderer(context, DrawableScene.Prepare(scene, settings));
        renderer.Draw(sceneRenderer, view, Width, Height, settings);
        while (renderer.GatheredCount < frames)
        {
            renderer.Gather(sceneRenderer, view, settings);
        }

        return renderer.Capture();
    }

    private static int CountChanged(PixelImage first, PixelImage second) =>
        Enumerable.Range(0, Width * Height).Count(
            i => Math.Abs(first[i % Width, i / Width].Green - second[i % Width, i / Width].Green) > 25);

    private static double Linear(byte component) => new Colour(component / 255.0, 0, 0).ToLinear().Red;

    /// <summary>The part of a pixel behind a tent of two pixels that lies before a distance from its centre.</summary>
    private static double CoverageBefore(double distance)
    {
        const int Steps = 2000;
        var sum = 0.0;
        for (var i = 0; i < Steps; i++)
        {
            var moved = (2 * (i + 0.5) / Steps) - 1;
            sum += (1 - Math.Abs(moved)) * Math.Clamp(distance - moved + 0.5, 0, 1) * 2 / Steps;
        }

        return sum;
    }
}
