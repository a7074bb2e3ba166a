using FractalEngine.Core;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render;

[Collection(GlTests.Name)]
public sealed class RendererTests
{
    private const int Width = 120;
    private const int Height = 80;

    private static readonly Scene Sponge = new()
    {
        Background = Colour.Black,
        Objects = [new(RenderScenes.Menger(2).Fractal) { Colour = Colour.White }],
    };

    [SkippableFact]
    public void Draw_SceneMadeInCode_IsThatOfTheRenderersBehindIt()
    {
        using var renderer = Open();
        var camera = CameraFraming.Default(Sponge);
        var view = View.Of(LoadedScene.Of(Sponge), (double)Width / Height, camera);
        var image = renderer.Draw(Sponge, camera);
        Assert.Equal((Width, Height), (image.Width, image.Height));
        Assert.Equal(RenderScenes.Draw(LoadedScene.Of(Sponge), view, Width, Height).Pixels, image.Pixels);
        Assert.True(RenderScenes.CountDifferent(image, (0, 0, 0, 255)) > 500, "nothing is visible");
    }

    [SkippableFact]
    public void Draw_WithoutACamera_FramesTheScene()
    {
        using var renderer = Open();
        var expected = renderer.Draw(Sponge, CameraFraming.Default(Sponge, (double)Width / Height));
        Assert.Equal(expected.Pixels, renderer.Draw(Sponge).Pixels);
        Assert.Equal(expected.Pixels, renderer.Draw(LoadedScene.Of(Sponge)).Pixels);
    }

    [SkippableFact]
    public void Draw_SceneWithACamera_UsesItUnlessAnotherIsGiven()
    {
        using var renderer = Open();
        var camera = new Camera(new(0, 0, -6), Vector.Zero, 40);
        var scene = Sponge with { Camera = camera };
        Assert.Equal(renderer.Draw(Sponge, camera).Pixels, renderer.Draw(scene).Pixels);
        Assert.NotEqual(renderer.Draw(scene).Pixels, renderer.Draw(scene, CameraFraming.Default(scene)).Pixels);
    }

    [SkippableFact]
    public void Draw_SameSceneAgain_DoesNotPrepareItAgain()
    {
        // Without culling the budget truncates the sponge, with a notice for each preparation.
        using var renderer = Open(new() { Culling = null, InstanceBudget = 20 });
        renderer.Draw(Sponge);
        var notices = renderer.Notices;
        Assert.Equal("fractal: 400 instances are more than the budget of 20: drawn at depth 1 of 2", Assert.Single(notices));
        renderer.Draw(Sponge, Camera.Default);
        Assert.Same(notices[0], renderer.Notices[0]);
        renderer.Draw(Sponge with { });
        Assert.NotSame(notices[0], renderer.Notices[0]);
    }

    /// <summary>What one renderer deletes may have the same name in GL as what the other one draws with.</summary>
    [SkippableFact]
    public void Draw_OfTwoRenderersInTurn_IsThatOfEachAlone()
    {
        using var first = Open();
        using var second = Open();
        var expected = (first.Draw(Sponge), second.Draw(Sponge));
        for (var round = 0; round < 3; round++)
        {
            Assert.Equal(expected.Item1.Pixels, first.Draw(Sponge with { }).Pixels);
            Assert.Equal(expected.Item2.Pixels, second.Draw(Sponge).Pixels);
        }
    }

    [SkippableFact]
    public void Draw_ScenesInTurn_AreThoseOfRenderersOfTheirOwn()
    {
        using var renderer = Open();
        var sphere = Sponge with { Objects = [new(RenderScenes.Sphere(9)) { Colour = new(1, 0, 0) }] };
        var drawable = DrawableScene.Prepare(LoadedScene.Of(sphere), new());
        var view = View.Of(drawable.Source, (double)Width / Height);
        var sponge = renderer.Draw(Sponge);
        var prepared = renderer.Draw(drawable, view);
        Assert.Equal(prepared.Pixels, renderer.Draw(sphere).Pixels);
        Assert.Equal(prepared.Pixels, renderer.Draw(drawable.Source, view).Pixels);
        Assert.NotEqual(sponge.Pixels, prepared.Pixels);
        Assert.Equal(sponge.Pixels, renderer.Draw(Sponge).Pixels);
    }

    [SkippableFact]
    public void Draw_ObjectWhoseFileIsNotLoaded_IsAnErrorThatNamesIt()
    {
        using var renderer = Open();
        var scene = new Scene { Objects = [new("missing.obj", Transformation.Identity)] };
        var error = Assert.Throws<FractalEngineException>(() => renderer.Draw(scene));
        Assert.Contains("'missing.obj'", error.Message, StringComparison.Ordinal);
        // The renderer stays usable.
        renderer.Draw(Sponge);
    }

    [SkippableFact]
    public void SavePng_OfAnImage_IsReadBack()
    {
        using var folder = new TemporaryFolder();
        using var renderer = Open();
        var image = renderer.Draw(Sponge, CameraFraming.Default(Sponge));
        image.SavePng(folder["sponge.png"]);
        Assert.Equal(image.Pixels, ImageFile.Load(folder["sponge.png"]).Pixels);
    }

    [SkippableFact]
    public void Dispose_Repeated_IsHarmless()
    {
        var renderer = Open();
        renderer.Draw(Sponge);
        renderer.Dispose();
        renderer.Dispose();
        Assert.Throws<ObjectDisposedException>(() => renderer.Draw(Sponge));
    }

    [SkippableFact]
    public void Draw_OnAnotherThread_IsRefused()
    {
        using var renderer = Open();
        Exception? caught = null;
        var other = new Thread(() => caught = Record.Exception(() => renderer.Draw(Sponge)));
        other.Start();
        other.Join();
        Assert.IsType<InvalidOperationException>(caught);
        renderer.Draw(Sponge);
    }

    [Theory]
    [InlineData(0, 10)]
    [InlineData(10, -1)]
    public void Offscreen_SizeWithoutPixels_IsRefused(int width, int height) =>
        Assert.Throws<ArgumentOutOfRangeException>(() => Renderer.Offscreen(width, height));

    private static Renderer Open(RenderSettings? settings = null)
    {
        try
        {
            return Renderer.Offscreen(Width, Height, settings);
        }
        catch (GraphicsUnavailableException exception)
        {
            throw new SkipException(exception.Message);
        }
    }
}
