using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Preparation;

namespace FractalEngine.Tests.Render;

/// <summary>Tests that a scene which the driver refuses leaves the one before as it was.</summary>
[Collection(GlTests.Name)]
public class RefusedUploadTests
{
    private const int Width = 64;
    private const int Height = 48;

    // Wider than the texture of any driver.
    private const int RefusedWidth = 1 << 20;

    [SkippableFact]
    public void ReplaceAndUpdate_WithATextureThatIsTooWide_KeepTheSceneBefore()
    {
        var cube = DrawableScene.Prepare(SceneOf(RenderScenes.Cube(0.5)), new());
        var refused = DrawableScene.Prepare(SceneOf(RenderScenes.Square(1)), new());
        var texture = new DrawableTexture("wide.png", new PixelImage(RefusedWidth, 1, new byte[4 * RefusedWidth]), false);
        typeof(DrawableScene).GetProperty(nameof(DrawableScene.Textures))!.SetValue(refused, ImmutableArray.Create(texture));

        using var context = GlTests.OpenContext();
        using var renderer = new SceneRenderer(context, cube);
        using var frame = new FrameRenderer(context);
        var before = Draw();
        Assert.True(RenderScenes.CountDifferent(before, (0, 0, 0, 255)) > 50);
        Assert.Throws<GlException>(() => renderer.Replace(refused));
        Assert.Same(cube, renderer.Scene);
        Assert.Equal(before.Pixels, Draw().Pixels);
        Assert.Throws<GlException>(() => renderer.Update(refused));
        Assert.Same(cube, renderer.Scene);
        Assert.Equal(before.Pixels, Draw().Pixels);
        renderer.Replace(DrawableScene.Prepare(SceneOf(RenderScenes.Square(1)), new()));
        Assert.NotEqual(before.Pixels, Draw().Pixels);

        PixelImage Draw()
        {
            frame.Draw(renderer, RenderScenes.FrontView, Width, Height, new());
            context.Resources.ThrowOnError("drawing");
            return frame.Capture();
        }
    }

    private static LoadedScene SceneOf(Mesh mesh) => RenderScenes.WhiteOnBlack(mesh, Transformation.Identity);
}
