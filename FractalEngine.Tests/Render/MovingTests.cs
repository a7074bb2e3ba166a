using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;

namespace FractalEngine.Tests.Render;

/// <summary>What physics moves: it is drawn as if it stood there, and what stands is not chosen again.</summary>
[Collection(GlTests.Name)]
public sealed class MovingTests
{
    private const int Width = 320;
    private const int Height = 240;

    private static readonly Camera Camera = new(new(0, 2, -8), new(0.2, 0, 0), 50);
    private static readonly RenderSettings Settings = new();

    [SkippableFact]
    public void Picture_OfMovedBodies_IsThatOfObjectsWhichStandThere()
    {
        using var context = GlTests.Open();
        using var frame = new FrameRenderer(context);
        var (first, second) = (RenderScenes.At(-2, 0.5, -1), RenderScenes.At(1.5, 0.5, -2));
        using var moved = new SceneRenderer(context, DrawableScene.Prepare(SceneOf(first, isBody: true), Settings));
        Draw(frame, moved);
        moved.Move(1, second.ToAffineMap());
        var picture = Draw(frame, moved);
        using var standing = new SceneRenderer(context, DrawableScene.Prepare(SceneOf(second, isBody: false), Settings));
        Assert.True(Pictures.Ratio(picture, Draw(frame, standing)) >= Pictures.Same);
    }

    [SkippableFact]
    public void Picture_WhileOnlyBodiesMove_ChoosesNothingAgain()
    {
        using var context = GlTests.Open();
        using var frame = new FrameRenderer(context);
        using var renderer =
            new SceneRenderer(context, DrawableScene.Prepare(SceneOf(RenderScenes.At(-2, 0.5, -1), isBody: true), Settings));
        var before = Draw(frame, renderer);
        var choices = renderer.Statistics.CullCount;
        for (var i = 0; i < 5; i++)
        {
            // Also out of the scene, and out of sight.
            renderer.Move(1, AffineMap.Translate(new(-2 + i, 0.5 - (30 * i), -1)));
            Draw(frame, renderer);
        }

        Assert.Equal(choices, renderer.Statistics.CullCount);
        renderer.Move(1, AffineMap.Translate(new(-2, 0.5, -1)));
        Assert.Equal(before.Pixels, Draw(frame, renderer).Pixels);
    }

    [SkippableFact]
    public void Balls_AreRoundAndWhereTheyAre()
    {
        using var context = GlTests.Open();
        using var frame = new FrameRenderer(context);
        using var renderer =
            new SceneRenderer(context, DrawableScene.Prepare(SceneOf(RenderScenes.At(-2, 0.5, -1), isBody: true), Settings));
        var without = Draw(frame, renderer);
        var (centre, radius) = (new Vector(2, 2.5, -3), 0.5);
        renderer.Spheres = [new(centre, radius)];
        var with = Draw(frame, renderer);
        var changed = 0;
        var view = View.Of(renderer.Scene.Source, (double)Width / Height, Camera);
        for (var y = 0; y < Height; y++)
        {
            for (var x = 0; x < Width; x++)
            {
                changed += without.Pixels.AsSpan(4 * ((y * Width) + x), 4).SequenceEqual(with.Pixels.AsSpan(4 * ((y * Width) + x), 4))
                    ? 0
                    : 1;
            }
        }

        // The disc of a ball at this depth; what it covers beside its edge changes.
        var depth = view.Camera.ToCameraSpace(centre).Z;
        var pixels = radius / depth / view.Camera.HalfHeightAtUnitDepth * 0.5 * Height;
        Assert.InRange(changed, 0.9 * Math.PI * pixels * pixels, 1.25 * Math.PI * (pixels + 1) * (pixels + 1));
        renderer.Spheres = [];
        Assert.Equal(without.Pixels, Draw(frame, renderer).Pixels);
    }

    private static PixelImage Draw(FrameRenderer frame, SceneRenderer renderer)
    {
        frame.Draw(renderer, View.Of(renderer.Scene.Source, (double)Width / Height, Camera), Width, Height, Settings);
        return frame.Capture();
    }

    /// <summary>A sponge, and a cube before it.</summary>
    private static LoadedScene SceneOf(Transformation placement, bool isBody)
    {
        var scene = new Scene { Camera = Camera, Lights = [RenderScenes.FullLight], Clip = (0.1, 100) };
        var cube = isBody ? new PhysicsObject("cube.obj", placement, 0.5) : new SceneObject("cube.obj", placement);
        return new(scene,
        [
            new(new("menger.fdo", RenderScenes.At(0, 0, 1)), RenderScenes.Menger(3)),
            new(cube with { Colour = new Colour(0.9, 0.2, 0.2) }, RenderScenes.Model(RenderScenes.Cube(0.5), "cube.obj")),
        ]);
    }
}
