using FractalEngine.App.Window.Tools;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render;

/// <summary>Tests that a section plane cuts drawn frames, traced images, shadows and picking alike.</summary>
[Collection(GlTests.Name)]
public sealed class SectionTests
{
    private const int Width = 120;
    private const int Height = 90;

    // Dark, so that traced light between surfaces hardly adds to the direct light, which drawn frames have too.
    private static readonly Colour Grey = new(0.35, 0.35, 0.35);

    private static readonly Light Headlight = new SunLight(new(0.2, -0.3, 1), Colour.White, 1, 0);

    public static TheoryData<string, Projection> Shapes => new()
    {
        { "cube", Projection.Orthographic },
        { "mirrored", Projection.Perspective },
        { "sphere", Projection.Perspective },
        { "sponge", Projection.Perspective },
    };

    [SkippableTheory]
    [MemberData(nameof(Shapes))]
    public void Section_OfASolid_IsDrawnAsItIsTraced(string name, Projection projection) => CheckSolid(name, projection);

    [SkippableTheory]
    [InlineData("cube", Projection.Perspective)]
    [InlineData("sponge", Projection.Orthographic)]
    [Trait("Category", "Soak")]
    public void Section_OfASolidInAnyProjection_IsDrawnAsItIsTraced(string name, Projection projection) => CheckSolid(name, projection);

    private static void CheckSolid(string name, Projection projection)
    {
        var scene = SceneOf(name);
        var view = FromFront(projection) with { Section = SectionPlane.Of(new(-0.25, 0.1, -1), 0.13) };
        var (mean, share) = RenderScenes.Difference(RenderScenes.Draw(scene, view, Width, Height), Trace(scene, view, 24));
        // Edges are smoothed differently.
        Assert.InRange(share, 0, name == "sponge" ? 0.12 : 0.04);
        Assert.InRange(mean, 0, name == "sponge" ? 6 : 3);
        var whole = RenderScenes.Draw(scene, view with { Section = null }, Width, Height);
        Assert.True(RenderScenes.Difference(whole, RenderScenes.Draw(scene, view, Width, Height)).Share > 0.03);
    }

    [SkippableFact]
    public void Section_ThroughACube_HasTheColourOfAFaceThatLooksTheSameWay()
    {
        // Straight from the front: the section through the middle looks like the front of a cube that ends there.
        var section = SectionPlane.Of(-Vector.K, 0);
        var view = FromFront(Projection.Perspective) with { Section = section };
        var half = new Transformation(new(0, 0, 0.5), Vector.Zero, new(1, 1, 0.5));
        var expected = RenderScenes.Scene(
            new() { Lights = [Headlight], Background = Colour.Black }, (RenderScenes.Model(RenderScenes.Cube(1)), half, Grey));
        Assert.InRange(
            RenderScenes.Difference(
                RenderScenes.Draw(expected, view with { Section = null }, Width, Height),
                RenderScenes.Draw(SceneOf("cube"), view, Width, Height)).Share,
            0, 0.005);
        Assert.InRange(
            RenderScenes.Difference(
                Trace(expected, view with { Section = null }, 16), Trace(SceneOf("cube"), view, 16)).Share,
            0, 0.005);
        // Hollow it is dark inside: the light comes from the front, and only the far wall is seen.
        var hollow = view with { Section = section with { HasCap = false } };
        var (filled, open) = (
            RenderScenes.Draw(SceneOf("cube"), view, Width, Height), RenderScenes.Draw(SceneOf("cube"), hollow, Width, Height));
        Assert.True(RenderScenes.Difference(filled, open).Share > 0.02);
    }

    [SkippableFact]
    public void Section_OfWhatCastsAShadow_CutsTheShadow()
    {
        // A cube above a floor, cut in half: so is its shadow, drawn and traced.
        var floor = RenderScenes.Model(RenderScenes.Square(6));
        var cube = RenderScenes.Model(RenderScenes.Cube(0.5));
        var scene = RenderScenes.Scene(
            new() { Lights = [new SunLight(new(0, -1, 0), Colour.White, 1, 0)], Background = Colour.Black },
            (floor, new(Vector.Zero, new(90, 0, 0), Vector.One), Grey), (cube, RenderScenes.TranslatedTo(0, 1.5, 0), Grey));
        // From the side and above, beside the cube.
        var camera = CameraFraming.LookAt(new(0, 5, -6), new(0, 0, 0), Vector.J, 40, Handedness.Left);
        var view = new View(camera, Projection.Perspective);
        var cut = view with { Section = SectionPlane.Of(Vector.I, 0) };
        var slanted = view with { Section = SectionPlane.Of(new(1, 1, 0), 1.3) };
        foreach (var draw in (Func<View, PixelImage>[])
            [shown => RenderScenes.Draw(scene, shown, Width, Height), shown => Trace(scene, shown, 8)])
        {
            Assert.True(IsDark(draw(view), view, new(0.45, 0, -0.3)));
            Assert.False(IsDark(draw(view), view, new(-0.8, 0, -0.3)));
            // Where the floor is cut away, there is background.
            Assert.True(IsDark(draw(cut), cut, new(0.8, 0, -0.3)));
            Assert.True(IsDark(draw(cut), cut, new(-0.3, 0, -0.3)));
            // A slanted plane keeps the floor and cuts off the right of the cube, whose shadow is gone there.
            Assert.False(IsDark(draw(slanted), slanted, new(0.45, 0, -0.3)));
            Assert.True(IsDark(draw(slanted), slanted, new(-0.45, 0, -0.3)));
        }
    }

    [SkippableFact]
    public void Section_SwitchedOff_LeavesTheShadowsWhole()
    {
        var view = FromFront(Projection.Perspective);
        using var context = new SharedContext();
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(SceneOf("sponge"), new()));
        using var frame = new FrameRenderer(context);
        var whole = Draw(view);
        Assert.NotEqual(whole.Pixels, Draw(view with { Section = SectionPlane.Of(new(-0.25, 0.1, -1), 0.13) }).Pixels);
        Assert.Equal(whole.Pixels, Draw(view).Pixels);

        PixelImage Draw(View shown)
        {
            frame.Draw(renderer, shown, Width, Height, new());
            return frame.Capture();
        }
    }

    [SkippableFact]
    public void Pick_WithASection_FindsWhatIsDrawn()
    {
        var scene = SceneOf("sponge");
        var section = SectionPlane.Of(new(-0.25, 0.1, -1), 0.13);
        var view = FromFront(Projection.Perspective) with { Section = section };
        var image = RenderScenes.Draw(scene, view, Width, Height, new() { Shadows = false, Samples = 0 });
        var picker = new Picker();
        var different = 0;
        for (var y = 0; y < Height; y += 3)
        {
            for (var x = 0; x < Width; x += 3)
            {
                var picked = picker.Pick(scene, view, (x + 0.5, y + 0.5), (Width, Height));
                Assert.True(picked is null || section.SignedDistance(picked.Point) < 1e-9);
                var isDrawn = image[x, y] != (0, 0, 0, 255);
                different += isDrawn == picked is not null ? 0 : 1;
            }
        }

        // Unlit faces are as black as the background.
        Assert.InRange(different, 0, 0.05 * Width * Height / 9);
    }

    [SkippableFact]
    public void Section_OfAnOpenSurface_IsHollow()
    {
        var scene = RenderScenes.Scene(
            new() { Lights = [RenderScenes.FullLight], Background = Colour.Black },
            (RenderScenes.Model(RenderScenes.Square(1)), Transformation.Identity, Colour.White));
        var view = FromFront(Projection.Perspective) with { Section = SectionPlane.Of(Vector.I, 0) };
        var image = RenderScenes.Draw(scene, view, Width, Height);
        Assert.False(IsDark(image, view, new(-0.1, 0, 0)));
        Assert.True(IsDark(image, view, new(0.1, 0, 0)));
    }

    private static LoadedScene SceneOf(string name) => RenderScenes.Scene(
        new() { Lights = [Headlight], Background = Colour.Black },
        (
            name switch
            {
                "sponge" => RenderScenes.Menger(3),
                "sphere" => RenderScenes.Model(RenderScenes.Sphere(24)),
                _ => RenderScenes.Model(RenderScenes.Cube(1)),
            },
            name == "mirrored" ? new(Vector.Zero, new(0, 30, 0), new(-1, 1, 1)) : Transformation.Identity, Grey));

    private static View FromFront(Projection projection) =>
        new(new(new(0.4, 0.3, -4), new(-0.07, -0.1, 0), 45), projection) { OrthographicHeight = 3.5 };

    private static PixelImage Trace(LoadedScene scene, View view, int samples)
    {
        var tracer = new PathTracer(scene, view, Width, Height);
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample();
        }

        return tracer.ToImage();
    }

    private static bool IsDark(PixelImage image, View view, Vector point)
    {
        var (x, y, _) = view.Project(point, Width, Height)!.Value;
        return image[(int)x, (int)y].Red < 50;
    }
}
