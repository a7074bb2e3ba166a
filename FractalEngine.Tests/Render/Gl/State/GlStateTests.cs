using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render.Gl.State;

[Collection(GlTests.Name)]
public sealed class GlStateTests
{
    [SkippableFact]
    public void Binding_OfADeletedObject_IsForgotten()
    {
        using var context = GlTests.OpenContext();
        var state = context.Resources.State;
        // GL gives the names of deleted objects to new ones.
        for (var i = 0; i < 5; i++)
        {
            var before = state.Filter.Counts;
            using var array = new VertexArray(context.Resources, "array");
            using var texture = new AlphaTexture(context.Resources, "texture", 1, 1, [1]);
            array.Bind();
            texture.Bind();
            // A texture is bound when it is made.
            Assert.Equal(new(2, 1), state.Filter.Counts - before);
            array.Bind();
            texture.Bind();
            Assert.Equal(new(2, 3), state.Filter.Counts - before);
        }

        context.Resources.ThrowOnError("binding");
    }

    [SkippableTheory]
    [InlineData(true)]
    public void Scenes_OneAfterTheOtherInOneContext_LookAsInTheirOwn(bool isFiltering)
    {
        using var textures = new TexturedScenes();
        var settings = new RenderSettings { FilterRedundantState = isFiltering, ReuseBuffers = isFiltering };
        var glass = TexturedScenes.WithMaterial(RenderScenes.Cube(1), new("glass") { Diffuse = new(1, 0, 0), Opacity = 0.4 });
        var checks = textures.CreateTexture("a.png", 2, 2, (x, y) => ((byte)(255 * x), (byte)(255 * y), 90, 255));
        LoadedScene[] scenes =
        [
            RenderScenes.Scene(
                new Scene(),
                (RenderScenes.Menger(2), Transformation.Identity, null),
                (glass, RenderScenes.TranslatedTo(1, 1, -1), null)),
            RenderScenes.Scene(
                new Scene(),
                (TexturedScenes.CreateSquare(1, new("m") { Texture = checks }), Transformation.Identity, null),
                (RenderScenes.Model(RenderScenes.Sphere(9)), RenderScenes.TranslatedTo(-1, 0, 1), null)),
            RenderScenes.Scene(
                new Scene { Lights = [RenderScenes.FullLight] },
                (RenderScenes.Model(RenderScenes.Cube(0.7)), Transformation.Identity, Colour.White)),
        ];
        var expected = scenes.Select(scene => RenderScenes.Draw(scene, RenderScenes.FrontView, settings: new())).ToArray();
        using var context = GlTests.OpenContext();
        using var frame = new FrameRenderer(context);
        for (var i = 0; i < 4; i++)
        {
            using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scenes[i % 3], settings));
            // Lines and text between the frames bind objects of their own, which the second frame finds bound.
            for (var round = 0; round < 2; round++)
            {
                frame.Draw(renderer, RenderScenes.FrontView, 200, 150, settings with { Grid = true, Axes = true, Wireframe = round == 0 });
                frame.Capture(overlay: OverlayPanel.OfText(OverlayAnchor.TopLeft, "text"));
                frame.Draw(renderer, RenderScenes.FrontView, 200, 150, settings);
                context.Resources.ThrowOnError("drawing");
                Assert.Equal(expected[i % 3].Pixels, frame.Capture().Pixels);
            }
        }
    }

    [SkippableTheory]
    [InlineData(false)]
    [Trait("Category", "Soak")]
    public void Scenes_OneAfterTheOtherInOneContextInOtherCases_LookAsInTheirOwn(bool isFiltering) =>
        Scenes_OneAfterTheOtherInOneContext_LookAsInTheirOwn(isFiltering);
}
