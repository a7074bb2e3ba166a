using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render.Preparation;

[Collection(GlTests.Name)]
public sealed class ScenePreparationTests
{
    // The camera is at (0, 0, −5) and looks along z. The first model is before it, the second behind, with two objects.
    private static readonly Model VisibleModel = RenderScenes.Model(RenderScenes.Sphere(8), "before.obj");
    private static readonly Model HiddenModel = RenderScenes.Model(RenderScenes.Sphere(6), "behind.obj");
    private static readonly LoadedScene Scene = RenderScenes.Scene(
        new Scene(), (VisibleModel, Transformation.Identity, null), (HiddenModel, RenderScenes.TranslatedTo(0, 0, -12), null),
        (HiddenModel, RenderScenes.TranslatedTo(3, 0, -12), null));

    private static readonly View ViewBackwards = new(Camera.Default with { Rotation = new(0, Math.PI, 0) }, Projection.Perspective);

    [Fact]
    public void PrepareVisible_ModelBehindTheCamera_StaysAPlaceholder()
    {
        var preparation = new ScenePreparation(Scene, new());
        Assert.True(preparation.HasUnpreparedVisibleModels(RenderScenes.FrontView, 1.5));
        Assert.True(preparation.PrepareVisible(RenderScenes.FrontView, 1.5));
        Assert.Equal([false, true], preparation.Scene.Models.Select(model => model.IsPlaceholder));
        Assert.Equal(12, preparation.Scene.Models[1].Indices.Length / 3);
        Assert.False(preparation.IsComplete);
        Assert.False(preparation.HasUnpreparedVisibleModels(RenderScenes.FrontView, 1.5));
        Assert.False(preparation.PrepareVisible(RenderScenes.FrontView, 1.5));
    }

    [Fact]
    public void PrepareVisible_AfterTurningRound_PreparesEachFileOnce()
    {
        var preparation = new ScenePreparation(Scene, new());
        preparation.PrepareVisible(RenderScenes.FrontView, 1.5);
        var first = preparation.Scene.Models[0];
        Assert.True(preparation.HasUnpreparedVisibleModels(ViewBackwards, 1.5));
        Assert.True(preparation.PrepareVisible(ViewBackwards, 1.5));
        Assert.True(preparation.IsComplete);
        Assert.Same(first, preparation.Scene.Models[0]);
        Assert.Same(preparation.Scene.Objects[1].Model, preparation.Scene.Objects[2].Model);
        Assert.All(preparation.Scene.Models, model => Assert.False(model.IsPlaceholder));
    }

    [SkippableFact]
    public void Update_WithAModelThatBecameVisible_DrawsAsIfPreparedAtOnce()
    {
        using var context = new SharedContext();
        using var frame = new FrameRenderer(context);
        var preparation = new ScenePreparation(Scene, new());
        preparation.PrepareVisible(RenderScenes.FrontView, 1.5);
        using var renderer = new SceneRenderer(context, preparation.Scene);
        renderer.Move(1, AffineMap.Translate(new(-1, 1, -11)));
        frame.Draw(renderer, ViewBackwards, 150, 100, new());
        var box = frame.Capture();

        preparation.PrepareVisible(ViewBackwards, 1.5);
        renderer.Update(preparation.Scene);
        frame.Draw(renderer, ViewBackwards, 150, 100, new());
        var late = frame.Capture();
        using var atOnce = new SceneRenderer(context, DrawableScene.Prepare(Scene, new()));
        atOnce.Move(1, AffineMap.Translate(new(-1, 1, -11)));
        frame.Draw(atOnce, ViewBackwards, 150, 100, new());
        Assert.Equal(frame.Capture().Pixels, late.Pixels);
        Assert.NotEqual(late.Pixels, box.Pixels);
        // The box encloses the sphere, so that it covers more.
        var background = late[0, 0];
        Assert.True(RenderScenes.CountDifferent(box, background) > RenderScenes.CountDifferent(late, background));
        context.Resources.ThrowOnError("drawing");
    }
}
