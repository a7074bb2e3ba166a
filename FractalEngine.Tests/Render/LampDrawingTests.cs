using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render;

/// <summary>Quads and balls of light in drawn frames, against integrals over their surfaces and traced frames.</summary>
[Collection(GlTests.Name)]
public sealed class LampDrawingTests
{
    private const int Size = 10;

    // An orthographic view of a square floor from the left and above. The upper edge is far away, the right one towards −z.
    private static readonly Vector ToEye = new Vector(-0.7, 0.5, 0).UnitVector();

    private static readonly View Slanted = new(
        new(10 * ToEye, CameraFraming.LookRotation(-ToEye), 60), Projection.Orthographic)
    { OrthographicHeight = 3 * ToEye.Y };

    // The third is large and near, the last two stand in the floor, so that a part of them is below the horizon.
    private static readonly PointLight[] Lamps =
    [
        new QuadLight(new(1.5, 2, 0.3), new(-1, -1.5, 0.2), 1.5, 1, Colour.White, 1, 1e4, 30),
        new BallLight(new(1.5, 1.5, 0.3), 0.7, Colour.White, 1, 1e4),
        new QuadLight(new(0.4, 3, 0.3), new(0, -1, 0), 4, 4, Colour.White, 1, 1e4),
        new BallLight(new(2.5, 1, 0.3), 0.02, Colour.White, 1, 1e4),
        new QuadLight(new(1.2, 0.3, -0.2), new(-1, 0, 0), 2, 2.5, Colour.White, 1, 1e4),
        new BallLight(new(1.2, 0.1, 0.3), 0.6, Colour.White, 1, 1e4),
    ];

    [SkippableTheory]
    [InlineData(null, 0, 0.004)]
    [InlineData(0.3, 1, 0.05)]
    [InlineData(0.3, 0, 0.03)]
    [InlineData(0.6, 0.5, 0.1)]
    [InlineData(1.0, 1, 0.12)]
    public void Floor_UnderALamp_IsDrawnAsTheIntegral(double? roughness, double metalness, double part)
    {
        var material = new Material("m")
        {
            Diffuse = new(0.9, 0.9, 0.9), Roughness = roughness, Metalness = roughness is null ? null : metalness,
        };
        var surface = new TracedSurface(
            Vector.Zero, Vector.J, Vector.J, material.Diffuse.ToLinearVector(), Gloss.Of(material), Vector.Zero, 1);
        for (var lamp = 0; lamp < Lamps.Length; lamp++)
        {
            var expected = new double[Size * Size];
            Parallel.For(0, Size * Size, i => expected[i] = IsHidden(Lamps[lamp], i) ? 0
                : LampIntegral.RadianceOf(Lamps[lamp]) / Math.PI * LampIntegral.Over(
                    Lamps[lamp], PointOf(i, 0.5, 0.5), toLight => Reflection.Evaluate(in surface, ToEye, toLight), 32).X);
            var scale = 0.8 / expected.Max();
            var image = RenderScenes.Draw(
                Scene(Lamps[lamp] with { Intensity = scale }, material), Slanted, Size, Size, new() { Shadows = false });
            var seen = Enumerable.Range(0, Size * Size).Where(i => expected[i] > 0).ToArray();
            var drawn = seen.Sum(i => new Colour(image[i % Size, i / Size].Red / 255.0, 0, 0).ToLinear().Red);
            var ratio = drawn / (scale * seen.Sum(i => expected[i]));

            Assert.True(Math.Abs(ratio - 1) < part, $"{Lamps[lamp].Kind} {lamp}: {ratio}");
            Assert.InRange(seen.Length, 0.3 * Size * Size, Size * Size);
        }
    }

    [SkippableTheory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void Lamps_BeforeAWall_AreDrawnWhereTheyAreTraced(Projection projection)
    {
        // The quad on the left shows its front, the one on the right its back. The balls stand half in the wall, and far
        // behind it.
        var scene = new Scene
        {
            Background = Colour.Black, Fog = new(0.05, Colour.White), Exposure = 0.5,
            Lights =
            [
                new QuadLight(new(-1, 0.5, 0), new(0.5, 0.2, -1), 1, 0.6, new(1, 0.4, 0.1), 1, 4, 25),
                new QuadLight(new(1, 0.5, 0), new(0.5, 0.2, 1), 1, 0.6, Colour.White, 1e-3, 4),
                new BallLight(new(0.2, -0.6, 1), 0.4, new(0.2, 0.6, 1), 1, 4),
                new BallLight(new(-6, -2, 20), 1, new(0.2, 1, 0.3), 1, 10),
            ],
        };
        var loaded = RenderScenes.Scene(
            scene,
            (TexturedScenes.WithMaterial(RenderScenes.Square(1), new("m") { Diffuse = Colour.Black }),
                RenderScenes.TranslatedTo(0, 0, 1), null));
        var view = RenderScenes.FrontView with { Projection = projection, OrthographicHeight = 3 };
        var tracer = new PathTracer(loaded, view, 80, 60);
        for (var i = 0; i < 8; i++)
        {
            tracer.AddSample();
        }

        var drawn = RenderScenes.Draw(loaded, view, 80, 60);
        var difference = RenderScenes.Difference(tracer.ToImage(), drawn);
        Assert.True(difference is { Mean: < 1.5, Share: < 0.06 }, $"{difference}");
        var orange = Enumerable.Range(0, 80 * 60).Count(i => drawn[i % 80, i / 80] is { Red: > 150, Blue: < 140 });
        Assert.InRange(orange, 50, 1000);
    }

    [SkippableFact]
    public void Shadow_OfACubeBelowALamp_IsThatOfItsMiddle()
    {
        var floor = TexturedScenes.WithMaterial(Floor, new("m") { Diffuse = Colour.White });
        byte At(Light light, double x)
        {
            var scene = RenderScenes.Scene(
                new() { Lights = [light], Background = Colour.Black }, (floor, Transformation.Identity, null),
                (RenderScenes.Model(RenderScenes.Cube(0.2)), RenderScenes.TranslatedTo(0, 1, 0), Colour.Black));
            var eye = new Vector(x, 0.5, 0);
            return RenderScenes.Draw(
                scene, new(new(eye, new(-0.5 * Math.PI, 0, 0), 5), Projection.Perspective), 21, 21)[10, 10].Red;
        }

        foreach (var light in (PointLight[])
        [
            new QuadLight(new(0, 3, 0), -Vector.J, 1, 1, Colour.White, 0.6, 30), new BallLight(new(0, 3, 0), 0.4, Colour.White, 0.6, 30),
        ])
        {
            Assert.Equal(0, At(light, 0.2));
            Assert.Equal(0, At(light, 0.25));
            Assert.InRange(At(light, 0.4), 150, 250);
        }
    }

    [SkippableTheory]
    [InlineData(null)]
    [InlineData(0.5)]
    public void Square_LitAtItsVertices_IsAsBrightAsAtItsPixels(double? roughness)
    {
        var material = new Material("m") { Roughness = roughness };
        var scene = RenderScenes.Scene(
            new() { Lights = [new QuadLight(new(1, 2, -3), new(-1, -2, 3), 2, 1, Colour.White, 0.5, 40)], Background = Colour.Black },
            (TexturedScenes.WithMaterial(RenderScenes.Square(0.01), material), Transformation.Identity, null));
        var view = new View(Camera.Default with { FieldOfView = 0.1 }, Projection.Perspective);
        byte Draw(Shading shading) => RenderScenes.Draw(scene, view, 21, 21, new() { Shading = shading })[10, 10].Red;
        Assert.InRange(Draw(Shading.PerPixel), 100, 250);
        Assert.InRange(Draw(Shading.PerVertex) - Draw(Shading.PerPixel), -1, 1);
    }

    private static Mesh Floor => new([-9, 0, -9, -9, 0, 9, 9, 0, 9, 9, 0, -9], [0, 1, 2, 0, 2, 3]);

    private static LoadedScene Scene(Light light, Material material) => RenderScenes.Scene(
        new() { Lights = [light], Background = Colour.Black },
        (TexturedScenes.WithMaterial(Floor, material), Transformation.Identity, null));

    private static Vector PointOf(int pixel, double across, double down) => new(
        1.5 - (((pixel / Size) + down) / Size * 3), 0, (1.5 - (((pixel % Size) + across) / Size * 3)) * ToEye.Y);

    /// <summary>Whether the lamp itself covers a part of a pixel.</summary>
    private static bool IsHidden(PointLight light, int pixel)
    {
        var emitter = light.ToEmitter()!;
        TracedLamp lamp = emitter.Radius > 0 ? new TracedBall(emitter, Vector.Zero, 1) : new TracedQuad(emitter, Vector.Zero, 1);
        return new[] { 0, 0.5, 1 }.Any(across => new[] { 0, 0.5, 1 }.Any(down =>
            double.IsFinite(lamp.DistanceAlong(new(PointOf(pixel, across, down) + (20 * ToEye), -ToEye)))));
    }
}
