using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render;

/// <summary>Objects that physics moves: they are drawn like static ones, and static objects are not culled again.</summary>
[Collection(GlTests.Name)]
public sealed class MovingObjectDrawingTests
{
    private const int Width = 320;
    private const int Height = 240;

    private static readonly Camera Camera = new(new(0, 2, -8), new(0.2, 0, 0), 50);
    private static readonly RenderSettings Settings = new();

    [SkippableFact]
    public void Frame_OfMovedBodies_IsThatOfStaticObjectsThere()
    {
        using var context = new SharedContext();
        using var frame = new FrameRenderer(context);
        var first = RenderScenes.TranslatedTo(-2, 0.5, -1);
        var second = RenderScenes.TranslatedTo(1.5, 0.5, -2);
        using var movedRenderer = new SceneRenderer(context, DrawableScene.Prepare(CreateScene(first, isBody: true), Settings));
        Draw(frame, movedRenderer);
        movedRenderer.Move(1, second.ToAffineMap());
        var image = Draw(frame, movedRenderer);
        using var staticRenderer = new SceneRenderer(context, DrawableScene.Prepare(CreateScene(second, isBody: false), Settings));
        ImageComparison.AssertSame(Draw(frame, staticRenderer), image, "moved body");
    }

    [SkippableFact]
    public void Frame_WhileOnlyBodiesMove_DoesNotCullAgain()
    {
        using var context = new SharedContext();
        using var frame = new FrameRenderer(context);
        var scene = CreateScene(RenderScenes.TranslatedTo(-2, 0.5, -1), isBody: true);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, Settings));
        var before = Draw(frame, renderer);
        var cullCount = renderer.Statistics.CullCount;
        for (var i = 0; i < 5; i++)
        {
            // Also out of the scene, and out of view.
            renderer.Move(1, AffineMap.Translate(new(-2 + i, 0.5 - (30 * i), -1)));
            Draw(frame, renderer);
        }

        Assert.Equal(cullCount, renderer.Statistics.CullCount);
        renderer.Move(1, AffineMap.Translate(new(-2, 0.5, -1)));
        Assert.Equal(before.Pixels, Draw(frame, renderer).Pixels);
    }

    /// <summary>The bounds of the scene, of which bodies count half the size around, end at z = ±1.</summary>
    [SkippableTheory]
    [InlineData(Projection.Perspective, 20)]
    [InlineData(Projection.Perspective, -3.5)]
    [InlineData(Projection.Orthographic, 20)]
    [InlineData(Projection.Orthographic, -3.5)]
    public void Frame_OfABodyFarOutOfTheScene_ShowsItWhileItIsInView(Projection projection, double z)
    {
        using var context = new SharedContext();
        using var frame = new FrameRenderer(context);
        var cube = RenderScenes.Model(RenderScenes.Cube(0.5), "cube.obj");
        var scene = new LoadedScene(
            new Scene { Background = Colour.Black, Lights = [RenderScenes.FullLight] },
            [
                new(new SceneObject("cube.obj", RenderScenes.TranslatedTo(-1.5, 0, 0)), cube),
                new(new PhysicsObject("cube.obj", RenderScenes.TranslatedTo(1.5, 0, 0), 0) { Colour = new Colour(1, 0, 0) }, cube),
            ]);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, Settings));
        var view = RenderScenes.FrontView with { Projection = projection, OrthographicHeight = 6 };
        PixelImage DrawAt(double x, double y, double depth)
        {
            renderer.Move(1, AffineMap.Translate(new(x, y, depth)));
            frame.Draw(renderer, view, Width, Height, Settings);
            return frame.Capture();
        }

        var before = DrawAt(1.5, 0, 0);
        var planes = renderer.ClipPlanes(view, Width, Height, Settings);
        Assert.Equal((0, 0, 0, 255), before[Width / 2, Height / 2]);
        Assert.Equal((255, 0, 0, 255), DrawAt(0, 0, z)[Width / 2, Height / 2]);

        // Out of view it moves nothing, and back where it began all is as it was.
        DrawAt(0, -1000, z);
        Assert.Equal(planes, renderer.ClipPlanes(view, Width, Height, Settings));
        Assert.Equal(before.Pixels, DrawAt(1.5, 0, 0).Pixels);
    }

    [SkippableFact]
    public void Spheres_AreRoundAndAtTheirPositions()
    {
        using var context = new SharedContext();
        using var frame = new FrameRenderer(context);
        var scene = CreateScene(RenderScenes.TranslatedTo(-2, 0.5, -1), isBody: true);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, Settings));
        var without = Draw(frame, renderer);
        var centre = new Vector(2, 2.5, -3);
        const double Radius = 0.5;
        renderer.Spheres = [new(centre, Radius)];
        var with = Draw(frame, renderer);
        var changed = 0;
        var view = View.Of(renderer.Scene.Source, (double)Width / Height, Camera);
        for (var y = 0; y < Height; y++)
        {
            for (var x = 0; x < Width; x++)
            {
                changed += without[x, y] == with[x, y] ? 0 : 1;
            }
        }

        // Pixels change in the disc of a sphere at this depth, and along its edge.
        var depth = view.Camera.ToCameraSpace(centre).Z;
        var pixels = Radius / depth / view.Camera.HalfHeightAtUnitDepth * 0.5 * Height;
        Assert.InRange(changed, 0.9 * Math.PI * pixels * pixels, 1.25 * Math.PI * (pixels + 1) * (pixels + 1));
        renderer.Spheres = [];
        Assert.Equal(without.Pixels, Draw(frame, renderer).Pixels);
    }

    [SkippableFact]
    public void Bounds_OfASphereAboveAFlatScene_IncludeIt()
    {
        using var context = new SharedContext();
        var flat = new MeshModel(Shapes.Square());
        var scene = new LoadedScene(new Scene(), [new(new SceneObject("flat", Transformation.Identity), flat)]);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, Settings));
        var size = renderer.Bounds.Diagonal;
        // Clip planes follow from the bounds, so that the sphere would not be drawn.
        renderer.Spheres = [new(new(size, size, size), 0.1)];
        Assert.Equal(0, renderer.Bounds.DistanceSquared(new(size, size, size)));
        renderer.Spheres = [new(new(9 * size, 9 * size, 9 * size), 0.1)];
        Assert.NotEqual(0, renderer.Bounds.DistanceSquared(new(9 * size, 9 * size, 9 * size)));
    }

    private static PixelImage Draw(FrameRenderer frame, SceneRenderer renderer)
    {
        frame.Draw(renderer, View.Of(renderer.Scene.Source, (double)Width / Height, Camera), Width, Height, Settings);
        return frame.Capture();
    }

    /// <summary>Creates a scene of a sponge, and a cube before it.</summary>
    private static LoadedScene CreateScene(Transformation placement, bool isBody)
    {
        var scene = new Scene { Camera = Camera, Lights = [RenderScenes.FullLight], Clip = (0.1, 100) };
        var cube = isBody ? new PhysicsObject("cube.obj", placement, 0.5) : new SceneObject("cube.obj", placement);
        return new(scene,
        [
            new(new("menger.fdo", RenderScenes.TranslatedTo(0, 0, 1)), RenderScenes.Menger(3)),
            new(cube with { Colour = new Colour(0.9, 0.2, 0.2) }, RenderScenes.Model(RenderScenes.Cube(0.5), "cube.obj")),
        ]);
    }
}
