using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render;

[Collection(GlTests.Name)]
public sealed class ScenePreparationTests
{
    // The camera is at (0, 0, −5) and looks along z: the first is before it, the second behind, and shown twice.
    private static readonly Model VisibleModel = RenderScenes.Model(RenderScenes.Sphere(8), "before.obj");
    private static readonly Model HiddenModel = RenderScenes.Model(RenderScenes.Sphere(6), "behind.obj");
    private static readonly LoadedScene Scene = RenderScenes.Scene(
        new Scene(), (VisibleModel, Transformation.Identity, null), (HiddenModel, RenderScenes.TranslatedTo(0, 0, -12), null),
        (HiddenModel, RenderScenes.TranslatedTo(3, 0, -12), null));

    private static readonly View ViewBackwards = new(Camera.Default with { Rotation = new(0, Math.PI, 0) }, Projection.Perspective);

    [Fact]
    public void PrepareVisible_OfWhatIsBehindTheCamera_LeavesAPlaceholder()
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
    public void Update_WithWhatBecameVisible_DrawsAsIfPreparedAtOnce()
    {
        using var context = GlTests.OpenContext();
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
        // The box is about the ball, so it covers more.
        var background = late[0, 0];
        Assert.True(RenderScenes.CountDifferent(box, background) > RenderScenes.CountDifferent(late, background));
        context.Resources.ThrowOnError("drawing");
    }

    [Theory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void MayIntersectFrustum_OfBoxesThatReachIntoTheFrame_IsTrue(Projection projection) => Seeded.Run(300, random =>
    {
        var view = new View(new(random.Vector(3), random.Vector(3), 20 + (100 * random.NextDouble())), projection) { OrthographicHeight = 1
            + (5 * random.NextDouble()) };
        var (corner1, corner2) = (random.Vector(8), random.Vector(8));
        var box = Core.Geometry.BoundingBox.Empty.Including(corner1).Including(corner2);
        for (var i = 0; i < 20; i++)
        {
            var point = box.Minimum + box.Size.Stretch(new(random.NextDouble(), random.NextDouble(), random.NextDouble()));
            if (view.Project(point, 300, 200) is var (x, y, depth) && depth > 0 && x is > 0 and < 300 && y is > 0 and < 200)
            {
                Assert.True(view.MayIntersectFrustum(box, 1.5), $"{point} of {box}");
            }
        }
    });
}
