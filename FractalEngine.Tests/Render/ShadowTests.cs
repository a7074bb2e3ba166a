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

/// <summary>Shadows of a cube over a floor, seen from straight above, where they are known in closed form.</summary>
[Collection(GlTests.Name)]
public sealed class ShadowTests
{
    private const int Size = 200;

    // Half the width that the image shows at the floor: the camera stands 10 above it and sees an angle of 60°.
    private static readonly double HalfWidth = 10 * Math.Tan(Math.PI / 6);

    public static TheoryData<string, double, double> Places => new()
    {
        { "sun", 1, 0 },
        { "sun", 1, 1e6 },
        { "spot", 1, 0 },
        { "point", 1e5, 0 },
    };

    [SkippableTheory]
    [MemberData(nameof(Places))]
    public void Cube_OverAFloor_ShadesItsProjection(string kind, double scale, double away) => CheckProjection(kind, scale, away);

    [SkippableTheory]
    [InlineData("sun", 1e-6, 0)]
    [InlineData("sun", 1e6, 0)]
    [InlineData("spot", 1e-5, 0)]
    [InlineData("point", 1, 0)]
    [InlineData("point", 1, 1e5)]
    [Trait("Category", "Soak")]
    public void Cube_OfOtherSizesOverAFloor_ShadesItsProjection(string kind, double scale, double away) =>
        CheckProjection(kind, scale, away);

    private static void CheckProjection(string kind, double scale, double away)
    {
        // A cube from −0.5 to 0.5 at heights from 1 to 2.
        var origin = new Vector(away, 0, away);
        var scene = CubeOverFloor(LightOf(kind, scale, origin), scale, origin);
        foreach (var fitsToView in (bool[])[true, false])
        {
            var image = RenderScenes.Draw(scene, FromAbove(scale, origin), Size, Size, new() { FitShadowsToView = fitsToView });
            var (wrong, shaded) = CountWrong(image, kind);
            // Texels of a shadow's edge, and pixels of the cube's own outline.
            Assert.InRange(wrong, 0, 0.004 * Size * Size);
            Assert.InRange(shaded, 300, 10_000);
        }
    }

    [SkippableFact]
    public void Lamp_FarBeyondAllOthers_CastsParallelShadows()
    {
        // So far away that the lamp has one map, beside a dim one that has a cube of them: programs know which is which.
        var distance = 1e5 * new Vector(-1, 1, 0);
        var scene = CubeOverFloor(new PointLight(distance, Colour.White, 2, 10 * distance.Length()), 1, Vector.Zero);
        var near = new PointLight(5 * Vector.J, Colour.White, 1e-3, 60);
        scene = scene with { Scene = scene.Scene with { Lights = [near, .. scene.Scene.Lights] } };
        foreach (var fitsToView in (bool[])[true, false])
        {
            var image = RenderScenes.Draw(scene, FromAbove(1, Vector.Zero), Size, Size, new() { FitShadowsToView = fitsToView });
            var (wrong, shaded) = CountWrong(image, "sun");
            Assert.InRange(wrong, 0, 0.004 * Size * Size);
            Assert.InRange(shaded, 300, 10_000);
        }
    }

    [SkippableFact]
    public void Floor_WithoutAnythingAbove_HasNoSpot()
    {
        // Neither acne nor anything else: also where light grazes.
        foreach (var height in (double[])[4, 1, 0.1])
        {
            var light = new SunLight(new(1, -height, 0.3), Colour.White, 1, 0);
            var scene = RenderScenes.Scene(
                new() { Lights = [light], Background = Colour.Black }, (Floor(1, Vector.Zero), Transformation.Identity, Colour.White));
            var view = FromAbove(1, Vector.Zero);
            var shaded = RenderScenes.Draw(scene, view, Size, Size);
            Assert.Equal(RenderScenes.Draw(scene, view, Size, Size, new() { Shadows = false }).Pixels, shaded.Pixels);
        }
    }

    [SkippableFact]
    public void Cube_OnAFloor_LeavesNoGapOfLight()
    {
        // The light comes from the right and is low: left of the cube the floor is dark from the very edge on.
        var scene = RenderScenes.Scene(
            new() { Lights = [new SunLight(new(-1, -0.5, 0), Colour.White, 1, 0)], Background = Colour.Black },
            (Floor(1, Vector.Zero), Transformation.Identity, Colour.White),
            (RenderScenes.Model(RenderScenes.Cube(0.5)), RenderScenes.TranslatedTo(0, 0.5, 0), Colour.White));
        var image = RenderScenes.Draw(scene, new(new(new(0, 30, 0), new(-Math.PI / 2, 0, 0), 4), Projection.Perspective), Size, Size);
        var halfWidth = 30 * Math.Tan(2 * Math.PI / 180);
        for (var x = -0.53; x > -1.0; x -= 0.01)
        {
            var pixel = image[(int)(0.5 * Size * (1 + (x / halfWidth))), Size / 2];
            Assert.InRange(pixel.Red, 0, 40);
        }
    }

    [SkippableTheory]
    [InlineData(true)]
    [InlineData(false)]
    public void Foliage_WithAnOpacityTexture_CastsItsCutOut(bool hasHole)
    {
        // A leaf from −1 to 1 lies at the height 1.5, and the light travels to the right as fast as down. Its left half is a hole.
        using var textures = new TexturedScenes();
        var opacity = textures.CreateTexture("leaf.png", 16, 16, static (x, _) => (255, 255, 255, (byte)(x < 8 ? 0 : 255)));
        var leaf = TexturedScenes.CreateSquare(1, new("leaf") { OpacityTexture = hasHole ? opacity : null });
        var scene = RenderScenes.Scene(
            new() { Lights = [LightOf("sun", 1, Vector.Zero)], Background = Colour.Black },
            (Floor(1, Vector.Zero), Transformation.Identity, Colour.White),
            (leaf, new(1.5 * Vector.J, new(90, 0, 0), Vector.One), Colour.White));
        var image = RenderScenes.Draw(scene, FromAbove(1, Vector.Zero), Size, Size);
        // Beside the leaf itself, before and behind the middle of its shadow.
        foreach (var x in (double[])[1.3, 1.4, 1.6, 1.8, 2, 2.2, 2.4])
        {
            var isLit = image[(int)(0.5 * Size * (1 + (x / HalfWidth))), Size / 2].Red > 60;
            Assert.Equal(hasHole && x < 1.5, isLit);
        }

        var tracer = new PathTracer(scene, FromAbove(1, Vector.Zero), 64, 64);
        tracer.AddSample(null);
        foreach (var x in (double[])[1.3, 1.35, 1.7, 1.9, 2.1, 2.3])
        {
            var isLit = tracer.RadianceAt((int)(32 * (1 + (x / HalfWidth))), 32).X > 0.05;
            Assert.Equal(hasHole && x < 1.5, isLit);
        }
    }

    [SkippableFact]
    public void Maps_WhileNothingMoves_AreKept()
    {
        var scene = CubeOverFloor(LightOf("sun", 1, Vector.Zero), 1, Vector.Zero);
        using var context = new SharedContext();
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, new()));
        using var frame = new FrameRenderer(context);
        var (view, settings) = (FromAbove(1, Vector.Zero), new RenderSettings { FitShadowsToView = false });
        int Drawn(View shown)
        {
            frame.Draw(renderer, shown, 100, 100, settings);
            return (int)renderer.Statistics.Optimisations.ShadowMaps.Performed;
        }

        Assert.Equal(1, Drawn(view));
        Assert.Equal(0, Drawn(view));
        // The camera moves: the map of the whole scene serves.
        Assert.Equal(0, Drawn(view with { Camera = view.Camera with { Position = new(1, 9, 1) } }));
        renderer.Move(1, AffineMap.Translate(new(1, 2, 1)));
        Assert.Equal(1, Drawn(view));
    }

    /// <summary>Also high above the bounds of the scene, on its way towards the light.</summary>
    [SkippableTheory]
    [InlineData(0)]
    [InlineData(30)]
    public void Body_ThatMoves_TakesItsShadowWithIt(double towardsLight)
    {
        var light = LightOf("sun", 1, Vector.Zero);
        var body = new PlacedModel(new PhysicsObject("cube.obj", RenderScenes.TranslatedTo(-2, 1.5, 0), 1) { Colour = Colour.White },
            RenderScenes.Model(RenderScenes.Cube(0.5)));
        var standing = CubeOverFloor(light, 1, Vector.Zero);
        var scene = standing with { Objects = [standing.Objects[0], body] };
        using var context = new SharedContext();
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, new()));
        using var frame = new FrameRenderer(context);
        foreach (var x in (double[])[-2, 1, 0.5, 0])
        {
            renderer.Move(1, AffineMap.Translate(new(x - towardsLight, 1.5 + towardsLight, 0)));
            frame.Draw(renderer, FromAbove(1, Vector.Zero), Size, Size, new());
        }

        // The places that it has left are lit again.
        var (wrong, _) = CountWrong(frame.Capture(), "sun");
        Assert.InRange(wrong, 0, 0.004 * Size * Size);
    }

    [SkippableFact]
    public void Lights_ThatCastNothing_CostNoMap()
    {
        foreach (var lights in (Light[][])[[new AmbientLight(Colour.White, 1)], [new DirectionalLight(-Vector.J, Colour.White, 0)]])
        {
            var scene = CubeOverFloor(lights[0], 1, Vector.Zero);
            using var context = new SharedContext();
            using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, new()));
            using var frame = new FrameRenderer(context);
            frame.Draw(renderer, FromAbove(1, Vector.Zero), 50, 50, new());
            Assert.Equal(0, renderer.Statistics.Optimisations.ShadowMaps.Performed);
        }
    }

    private static LoadedScene CubeOverFloor(Light light, double scale, Vector origin) => RenderScenes.Scene(
        new() { Lights = [light], Background = Colour.Black },
        (Floor(scale, origin), Transformation.Identity, Colour.White),
        (
            RenderScenes.Model(RenderScenes.Cube(0.5 * scale)), new(origin + (1.5 * scale * Vector.J), Vector.Zero, Vector.One),
            Colour.Black));

    private static Model Floor(double scale, Vector origin)
    {
        var (x, z, half) = (origin.X, origin.Z, 20 * scale);
        return RenderScenes.Model(
            new([x - half, 0, z - half, x - half, 0, z + half, x + half, 0, z + half, x + half, 0, z - half], [0, 1, 2, 0, 2, 3]),
            "floor.obj");
    }

    private static Light LightOf(string kind, double scale, Vector origin) => kind switch
    {
        "sun" => new SunLight(new(1, -1, 0), Colour.White, 1, 0),
        "spot" => new SpotLight(origin + (5 * scale * Vector.J), -Vector.J, 100, Colour.White, 1, 60 * scale),
        _ => new PointLight(origin + (5 * scale * Vector.J), Colour.White, 1, 60 * scale),
    };

    private static View FromAbove(double scale, Vector origin) =>
        new(new(origin + (10 * scale * Vector.J), new(-Math.PI / 2, 0, 0), 60), Projection.Perspective);

    /// <summary>Counts the pixels of the floor that are dark where they should be lit, or lit where they should be dark.</summary>
    private static (int Wrong, int Shaded) CountWrong(PixelImage image, string kind)
    {
        var (wrong, shaded) = (0, 0);
        for (var y = 0; y < Size; y++)
        {
            for (var x = 0; x < Size; x++)
            {
                var floorX = ((((x + 0.5) / Size) * 2) - 1) * HalfWidth;
                var floorZ = (1 - (((y + 0.5) / Size) * 2)) * HalfWidth;
                // At the edge of the cone the light fades.
                var coneRadius = 5 * Math.Tan(0.85 * 50 * Math.PI / 180);
                var beyondCone = kind == "spot" && (floorX * floorX) + (floorZ * floorZ) > coneRadius * coneRadius;
                if (IsBehindCube(floorX, floorZ) || beyondCone)
                {
                    continue;
                }

                var isShaded = kind == "sun"
                    // The light travels to the right as fast as down.
                    ? floorX is > 0.5 and < 2.5 && Math.Abs(floorZ) < 0.5
                    // From a height of 5 the top at 2 and the bottom at 1 project to the floor.
                    : Math.Max(Math.Abs(floorX), Math.Abs(floorZ)) < 0.5 * 5 / 3;
                shaded += isShaded ? 1 : 0;
                wrong += isShaded == image[x, y].Red > 60 ? 1 : 0;
            }
        }

        return (wrong, shaded);
    }

    /// <summary>From a height of 10, the top at 2 hides this part of the floor.</summary>
    private static bool IsBehindCube(double x, double z) => Math.Max(Math.Abs(x), Math.Abs(z)) < 0.5 * 10 / 8;
}
