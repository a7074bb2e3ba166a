using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Render;
using static System.FormattableString;

namespace FractalEngine.Tests.Scenes.Lights;

/// <summary>Light that a scene does not need costs nothing, and leaves the image as it is.</summary>
[Collection(GlTests.Name)]
public sealed class LightSkippingTests
{
    private const int Width = 160;
    private const int Height = 120;

    // As for all optimisations. What differs are edges of shadows, where maps are fewer or lie elsewhere in the texture.
    private const double MinDecibels = 50;

    private static readonly Light Sun = new SunLight(new(1, -2, 0.5), Colour.White, 1, 0);

    [SkippableFact]
    public void Lights_ThatShineOnNothingVisible_HaveNoMap()
    {
        Light[] idle =
        [
            new DirectionalLight(-Vector.J, Colour.White, 0),
            new PointLight(new(0, 80, 0), Colour.White, 1, 40),
            new SpotLight(new(0, 4, 0), Vector.J, 40, Colour.White, 1, 20),
        ];
        foreach (var fitsToView in (bool[])[true, false])
        {
            var settings = new RenderSettings { FitShadowsToView = fitsToView };
            var (image, statistics) = Draw(FloorWith([Sun, .. idle], CubeAt(0, 1, 0)), settings);
            // Maps of the dark light, one for each slice; six sides of the one too far away; that of the spot, which shines upwards.
            Assert.Equal((fitsToView ? 3 : 1) + 6 + 1, statistics.SkippedShadowMaps);
            var (all, without) = Draw(FloorWith([Sun, .. idle], CubeAt(0, 1, 0)), settings with { LightCulling = false });
            Assert.Equal(0, without.SkippedShadowMaps);
            Assert.True(without.ShadowMaps.Performed >= statistics.ShadowMaps.Performed + statistics.SkippedShadowMaps);
            AssertSame(all, image, "idle lights");
        }
    }

    [SkippableFact]
    public void Casters_WhoseShadowIsNotSeen_AreNotDrawn()
    {
        // Behind the camera the light leads away; the floor is below everything; one cube's shadow leaves the frame, two are seen.
        var objects = new[] { CubeAt(0, 1, 0), CubeAt(1.5, 2, 1), CubeAt(15, 1, 0), CubeAt(0, 1, -16) };
        var (image, statistics) = Draw(FloorWith([Sun], objects), new());
        Assert.Equal(3, statistics.SkippedCasters);
        var (all, without) = Draw(FloorWith([Sun], objects), new() { CasterCulling = false });
        Assert.Equal(0, without.SkippedCasters);
        AssertSame(all, image, "casters out of sight");
    }

    [SkippableFact]
    public void Cube_Alone_NeedsNoMap()
    {
        var scene = RenderScenes.Scene(new() { Lights = [Sun], Background = Colour.Black }, CubeAt(0, 0, 0));
        foreach (var fitsToView in (bool[])[true, false])
        {
            var settings = new RenderSettings { FitShadowsToView = fitsToView };
            var (image, statistics) = Draw(scene, settings);
            Assert.Equal((0, 1), (statistics.ShadowMaps.Performed, statistics.SkippedShadowMaps));
            var (all, without) = Draw(scene, settings with { CasterCulling = false });
            Assert.Equal(1, without.ShadowMaps.Performed);
            AssertSame(all, image, "a cube alone");
        }
    }

    [SkippableFact]
    public void Cube_FromWithin_IsDark()
    {
        var scene = RenderScenes.Scene(new() { Lights = [Sun], Background = Colour.White }, CubeAt(0, 0, 0, 10));
        var view = new View(new(Vector.Zero, Vector.Zero, 60), Projection.Perspective);
        var (image, _) = Draw(scene, new(), view);
        Assert.Equal(Width * Height, Width * Height - RenderScenes.CountDifferent(image, (0, 0, 0, 255)));
    }

    [SkippableFact]
    public void Cube_ThatIsEntered_GetsItsMap()
    {
        // From outside the cube needs none; the map of the whole scene is drawn once the camera is within.
        using var context = new SharedContext();
        var settings = new RenderSettings { FitShadowsToView = false };
        using var renderer = new SceneRenderer(
            context, DrawableScene.Prepare(RenderScenes.Scene(new() { Lights = [Sun] }, CubeAt(0, 0, 0, 10)), settings));
        using var frame = new FrameRenderer(context);
        var expected = new[] { 0, 0, 1, 0 };
        var depths = new[] { -40, -30, 0, 1 };
        for (var i = 0; i < depths.Length; i++)
        {
            frame.Draw(renderer, new(new(new(0, 0, depths[i]), Vector.Zero, 60), Projection.Perspective), Width, Height, settings);
            Assert.Equal(expected[i], renderer.Statistics.Optimisations.ShadowMaps.Performed);
        }
    }

    [SkippableFact]
    public void Body_ThatComesIntoView_CastsItsShadow()
    {
        var body = new PlacedModel(
            new PhysicsObject("cube.obj", RenderScenes.TranslatedTo(30, 1.5, 0), 1) { Colour = Colour.White },
            RenderScenes.Model(RenderScenes.Cube(0.5)));
        var standing = FloorWith([Sun], CubeAt(0, 1, 0));
        var scene = standing with { Objects = [.. standing.Objects, body] };
        using var context = new SharedContext();
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, new()));
        using var frame = new FrameRenderer(context);
        PixelImage DrawWith(RenderSettings settings)
        {
            frame.Draw(renderer, View, Width, Height, settings);
            return frame.Capture();
        }

        foreach (var x in (double[])[30, 1.5, 25, -1.5])
        {
            renderer.Move(2, AffineMap.Translate(new(x, 1.5, 0)));
            var image = DrawWith(new());
            Assert.Equal(Math.Abs(x) > 5 ? 2 : 1, renderer.Statistics.Optimisations.SkippedCasters);
            AssertSame(DrawWith(new() { CasterCulling = false }), image, Invariant($"a body at {x}"));
        }
    }

    [SkippableTheory]
    [InlineData(4, 10)]
    public void Frames_OfRandomScenes_AreTheSame(int sceneCount, int minSkipped)
    {
        const int Seed = 20;
        var random = new Random(Seed);
        var skipped = 0;
        for (var i = 0; i < sceneCount; i++)
        {
            Light[] lights =
            [
                new SunLight(new(Next(2), -0.3 - random.NextDouble(), Next(2)), Colour.White, 1, 0),
                new PointLight(new(Next(12), 3 + Next(2), Next(12)), Colour.White, 1, 30),
                new SpotLight(new(Next(12), 6, Next(12)), new(Next(1), -1, Next(1)), 60, Colour.White, 1, 40),
            ];
            var objects = Enumerable.Range(0, 12).Select(_ => CubeAt(Next(20), 1 + Math.Abs(Next(3)), Next(20))).ToArray();
            var scene = FloorWith([.. lights.Where((_, index) => index == i % 4 || i % 4 == 3)], objects);
            var view = new View(new(new(Next(6), 4, -6), new(-0.3 + (0.2 * Next(1)), Next(1), 0), 50), Projection.Perspective);
            var settings = new RenderSettings { FitShadowsToView = i % 2 == 0 };
            var (image, statistics) = Draw(scene, settings, view);
            skipped += statistics.SkippedCasters + statistics.SkippedShadowMaps;
            var (all, _) = Draw(scene, settings with { CasterCulling = false, LightCulling = false }, view);
            AssertSame(all, image, Invariant($"seed {Seed}, scene {i}"));
        }

        Assert.True(skipped > minSkipped, Invariant($"only {skipped} skipped"));
        double Next(double size) => size * ((2 * random.NextDouble()) - 1);
    }

    [SkippableTheory]
    [InlineData(12, 40)]
    [Trait("Category", "Soak")]
    public void Frames_OfMoreRandomScenes_AreTheSame(int sceneCount, int minSkipped) =>
        Frames_OfRandomScenes_AreTheSame(sceneCount, minSkipped);

    [SkippableFact]
    public void Bake_OfAFlatFractal_IsSkipped()
    {
        var lights = ImmutableArray.Create<Light>(new AmbientLight(Colour.White, 1), Sun);
        ImmutableArray<Transformation> corners = [.. new[] { (-1, -1), (1, -1), (-1, 1) }
            .Select(static corner => new Transformation(new(0.5 * corner.Item1, 0.5 * corner.Item2, 0), Vector.Zero, Vector.One / 2))];
        var model = new FractalModel(new Fractal(
            new FractalDescription([new Repetition([new TransformationSet(corners)], 4)], Composition.Affine), RenderScenes.Square(1)))
        {
            SourcePath = "corners.fdo",
        };
        var scene = RenderScenes.Scene(new() { Lights = lights }, (model, Transformation.Identity, Colour.White));
        var (image, statistics) = Draw(scene, new(), View.Of(scene, (double)Width / Height));
        Assert.Equal(1, statistics.SkippedBakes);
        var (all, without) = Draw(scene, new() { BakeSkipping = false }, View.Of(scene, (double)Width / Height));
        Assert.Equal(0, without.SkippedBakes);
        Assert.Equal(all.Pixels, image.Pixels);
        var (_, sponge) = Draw(
            RenderScenes.Scene(new() { Lights = lights }, (RenderScenes.Menger(2), Transformation.Identity, Colour.White)), new());
        Assert.Equal(0, sponge.SkippedBakes);
    }

    private static View View => new(new(new(0, 3, -6), new(-0.4, 0, 0), 50), Projection.Perspective);

    private static (Model Model, Transformation Placement, Colour? Colour) CubeAt(double x, double y, double z, double half = 0.5) =>
        (RenderScenes.Model(RenderScenes.Cube(half)), RenderScenes.TranslatedTo(x, y, z), Colour.White);

    private static LoadedScene FloorWith(
        Light[] lights, params ReadOnlySpan<(Model Model, Transformation Placement, Colour? Colour)> objects) =>
        RenderScenes.Scene(
            new() { Lights = [.. lights], Background = Colour.Black }, [(Floor, Transformation.Identity, Colour.White), .. objects]);

    private static Model Floor => RenderScenes.Model(
        new([-20, 0, -20, -20, 0, 20, 20, 0, 20, 20, 0, -20], [0, 1, 2, 0, 2, 3]), "floor.obj");

    private static (PixelImage Image, OptimisationStatistics Statistics) Draw(LoadedScene scene, RenderSettings settings, View? view = null)
    {
        using var context = new SharedContext();
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, settings));
        using var frame = new FrameRenderer(context);
        frame.Draw(renderer, view ?? View, Width, Height, settings);
        context.Resources.ThrowOnError("drawing");
        return (frame.Capture(), renderer.Statistics.Optimisations);
    }

    private static void AssertSame(PixelImage expected, PixelImage image, string what)
    {
        var decibels = ImageComparison.PeakSignalToNoiseRatio(image, expected);
        Assert.True(decibels >= MinDecibels, Invariant($"{what}: {decibels:F1} dB"));
        Assert.True(RenderScenes.CountDifferent(image, (0, 0, 0, 255)) > 500, "nothing is visible");
    }
}
