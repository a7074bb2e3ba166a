using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render;

/// <summary>Objects in drawn mirrors, which a reflection probe sees, against traced images of the same scene.</summary>
[Collection(GlTests.Name)]
public sealed class ReflectionProbeTests
{
    private const int Width = 80;
    private const int Height = 60;

    private static readonly Material Mirror = new("m") { Diffuse = Colour.Black, Specular = Colour.White, SpecularExponent = 5000 };

    private static readonly View Inside = new(new(new(0.3, 0.4, -2.6), new(-0.15, -0.1, 0), 55), Projection.Perspective);

    [SkippableTheory]
    [InlineData(Handedness.Left, Tone.None, 1, 0)]
    [InlineData(Handedness.Right, Tone.Filmic, 0.6, 0)]
    [InlineData(Handedness.Left, Tone.Filmic, 2, 0.05)]
    public void Ball_InARoom_MirrorsItAsItIsTraced(Handedness handedness, Tone tone, double exposure, double fog)
    {
        var scene = Room(new()
        {
            Handedness = handedness, Tone = tone, Exposure = exposure, Fog = fog > 0 ? new(fog, Colour.White) : null,
            Background = Colour.White, Probe = new(0.1, -0.2, 0.3),
        }, Mirror);
        var position = handedness.Mirror(Inside.Camera.Position);
        var view = Inside with { Camera = Inside.Camera with { Handedness = handedness, Position = position } };
        var traced = Trace(scene, view, 8);
        var (drawn, alone) = (RenderScenes.Draw(scene, view, Width, Height), RenderScenes.Draw(WithoutProbe(scene), view, Width, Height));

        var difference = MirrorDifference(traced, drawn);
        Assert.True(difference < 4, $"{difference}");
        Assert.InRange(MirrorDifference(traced, alone), 15, 255);
    }

    [SkippableTheory]
    [InlineData(0.1, 4)]
    [InlineData(0.3, 6)]
    [InlineData(0.6, 14)]
    public void RoughBall_InARoom_IsAsBrightAsTraced(double roughness, double limit)
    {
        var scene = Room(new() { Background = Colour.White, Probe = new(0.1, -0.2, 0.3) }, Mirror with
        {
            Diffuse = Colour.White,
            Roughness = roughness,
            Metalness = 1,
        });
        var difference = MirrorDifference(Trace(scene, Inside, 16), RenderScenes.Draw(scene, Inside, Width, Height));

        Assert.True(difference < limit, $"{difference}");
    }

    [SkippableFact]
    public void FlatMirror_FarFromTheProbe_ShowsABallInItsPlace()
    {
        var scene = RenderScenes.Scene(
            new() { Background = Colour.Black, Probe = new(0.5, 0.4, -0.5), Lights = [] },
            (TexturedScenes.WithMaterial(Shapes.Box(new(new(-3, -0.1, -3), new(3, 0, 3))), Mirror), Transformation.Identity, null),
            (Glowing(RenderScenes.Sphere(24), new(1, 0.9, 0.8)), RenderScenes.TranslatedTo(-0.5, 2.5, 2), null));
        // The ball itself is above the image.
        var view = new View(new(new(-0.2, 1.5, -4), new(-0.4, 0, 0), 40), Projection.Perspective);

        var traced = RenderScenes.Centroid(Trace(scene, view, 8));
        var drawn = RenderScenes.Centroid(RenderScenes.Draw(scene, view, Width, Height));
        Assert.InRange(Math.Abs(traced.X - drawn.X), 0, 1.2);
        Assert.InRange(Math.Abs(traced.Y - drawn.Y), 0, 1.2);
    }

    [SkippableFact]
    public void Probe_WhenAnObjectMoves_IsDrawnAnew()
    {
        var scene = Room(new() { Background = Colour.White, Probe = new(0.1, -0.2, 0.3) }, Mirror);
        using var context = new SharedContext();
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, new()));
        using var frame = new FrameRenderer(context);
        frame.Draw(renderer, Inside, Width, Height, new());
        var first = frame.Capture();
        var moved = AffineMap.Translate(new(0, 0, -4));
        renderer.Move(1, moved);
        frame.Draw(renderer, Inside, Width, Height, new());
        var second = frame.Capture();
        renderer.Move(1, AffineMap.Identity);
        frame.Draw(renderer, Inside, Width, Height, new());

        Assert.True(MirrorDifference(first, second) > 1);
        Assert.Equal(first.Pixels, frame.Capture().Pixels);
    }

    [SkippableFact]
    public void Probe_InASceneWithoutMirrors_ChangesNothing()
    {
        var sky = new ColourSky(Colour.White, Colour.White);
        var scene = Room(new() { Background = Colour.White, Probe = new(0.1, -0.2, 0.3), Sky = sky }, new("m"));
        Assert.Equal(RenderScenes.Draw(WithoutProbe(scene), Inside).Pixels, RenderScenes.Draw(scene, Inside).Pixels);
    }

    private static LoadedScene WithoutProbe(LoadedScene scene) => scene with { Scene = scene.Scene with { Probe = null } };

    private static Model Glowing(Mesh mesh, Colour colour) =>
        TexturedScenes.WithMaterial(mesh, new("glow") { Diffuse = Colour.Black, Emission = colour });

    /// <summary>A ball around the probe, and six walls of other colours, in which the ball stands out of the middle.</summary>
    private static LoadedScene Room(Scene scene, Material material)
    {
        (Vector Low, Vector High, Colour Colour)[] walls =
        [
            (new(2, -2, -3), new(2.1, 2, 3), new(0.9, 0.1, 0.1)), (new(-2.1, -2, -3), new(-2, 2, 3), new(0.1, 0.8, 0.2)),
            (new(-2, 2, -3), new(2, 2.1, 3), new(0.5, 0.6, 0.9)), (new(-2, -2.1, -3), new(2, -2, 3), new(0.4, 0.3, 0.2)),
            (new(-2, -2, 3), new(2, 2, 3.1), new(0.8, 0.8, 0.1)), (new(-2, -2, -3.1), new(2, 2, -3), new(0.6, 0.1, 0.7)),
        ];
        return RenderScenes.Scene(scene,
        [
            (TexturedScenes.WithMaterial(Shapes.Sphere(4), material), RenderScenes.TranslatedTo(0.1, -0.2, 0.3), null),
            .. walls.Select(wall => (Glowing(Shapes.Box(new(wall.Low, wall.High)), wall.Colour), Transformation.Identity, (Colour?)null)),
        ]);
    }

    private static PixelImage Trace(LoadedScene scene, View view, int samples)
    {
        var tracer = new PathTracer(scene, view, Width, Height);
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample();
        }

        return tracer.ToImage();
    }

    /// <summary>Mean difference of all components in the middle of the image, where the ball is.</summary>
    private static double MirrorDifference(PixelImage image1, PixelImage image2)
    {
        var (sum, count) = (0.0, 0);
        for (var y = 20; y < 46; y++)
        {
            for (var x = 27; x < 53; x++)
            {
                var (a, b) = (image1[x, y], image2[x, y]);
                sum += Math.Abs(a.Red - b.Red) + Math.Abs(a.Green - b.Green) + Math.Abs(a.Blue - b.Blue);
                count += 3;
            }
        }

        return sum / count;
    }
}
