using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Render.Preparation;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Support;
using static System.FormattableString;

namespace FractalEngine.Tests.Render;

/// <summary>
/// Pictures for which instances are chosen, beside those of every instance and those of the truth: the same with 36 samples a pixel.
/// </summary>
[Collection(GlTests.Name)]
public sealed class DetailDrawingTests
{
    private const int Width = 400;
    private const int Height = 300;
    private const int Supersampling = 6;

    // Decibels by which a picture may be farther from the truth than that of every instance.
    private const double NoFarther = 0.3;

    private static readonly RenderSettings Chosen = new() { Samples = 0 };
    private static readonly RenderSettings All = Chosen with { Culling = null };
    private static readonly Camera Aside = new(new(-3.2, 2.6, -4), CameraFraming.LookRotation(new(3.2, -2.6, 4)), 45);

    /// <summary>
    /// Each fractal of the assets at a depth where half of the instances are larger than two pixels; −1 for what has no depth.
    /// </summary>
    public static TheoryData<string, int> Large => new()
    {
        { "appendix-b", 1 }, { "appendix-b-structure", 2 }, { "diamond", 2 }, { "fern", 1 }, { "googol", 3 }, { "infinite-menger", 2 },
        { "menger", 3 }, { "menger-3", 2 }, { "menger-4", 2 },
        { "romanesco", 2 }, { "shell", -1 }, { "sierpinski", 3 }, { "terrain", 4 }, { "tetrahedron", 4 }, { "tree", 5 },
        { "tree-leaves", 5 },
    };

    /// <summary>Some with smaller instances.</summary>
    public static TheoryData<string, int> Small => new() { { "appendix-b", 2 }, { "snowflake", -1 }, { "tetrahedron", 7 } };

    /// <summary>The rest, and deeper ones, up to 200,000 instances.</summary>
    public static TheoryData<string, int> SmallForSoak => new()
    {
        { "appendix-b-structure", 3 }, { "appendix-b", 3 }, { "diamond", 3 }, { "fern", 2 }, { "fern", 3 }, { "googol", 5 },
        { "menger-3", 3 }, { "menger-4", 4 }, { "romanesco", 3 }, { "sierpinski", 5 }, { "sierpinski", 6 }, { "terrain", 8 },
        { "tetrahedron", 8 }, { "tree", 7 },
        { "tree-leaves", 7 },
    };

    [SkippableTheory]
    [MemberData(nameof(Large))]
    public void Picture_OfLargeInstances_IsThatOfEveryInstance(string name, int depth)
    {
        var model = ModelOf(name, depth);
        foreach (var projection in (Projection[])[Projection.Perspective, Projection.Orthographic])
        {
            AssertSame(RenderScenes.Scene(new Scene { Projection = projection }, (model, Transformation.Identity, null)));
        }
    }

    [SkippableTheory]
    [MemberData(nameof(Small))]
    public void Picture_OfSmallInstances_IsNoFartherFromTheTruth(string name, int depth) => CheckSmall(name, depth);

    [SkippableTheory]
    [Trait("Category", "Soak")]
    [MemberData(nameof(SmallForSoak))]
    public void Picture_OfManySmallInstances_IsNoFartherFromTheTruth(string name, int depth) => CheckSmall(name, depth);

    [SkippableTheory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void Picture_FromWithin_IsThatOfEveryInstance(Projection projection)
    {
        // In a hole of the sponge, in one of its cubes, and with planes that cut it.
        var scene = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(3), Transformation.Identity, null));
        var eyes = (Vector[])[new(0.02, 0.03, -0.1), new(0.95, 0.95, 0.95), new(-0.4, 0.1, -0.9)];
        View[] views =
        [
            .. eyes.Select(eye => new View(new(eye, new(0.2, 0.4, 0), 60), projection) { OrthographicHeight = 1.5 }),
            new View(Aside, projection) { Clip = (4.5, 6.2), OrthographicHeight = 4 },
            new View(Aside, projection) { Aspect = 1, OrthographicHeight = 4 },
        ];
        foreach (var view in views)
        {
            AssertSame(scene, view);
        }
    }

    [SkippableFact]
    public void Picture_OfObjectsBeforeEachOther_IsThatOfEveryInstance()
    {
        // Two that pass through each other, one of them mirrored and skewed, one behind both, one that is a plain mesh, and a large one.
        var scene = RenderScenes.Scene(
            new Scene(),
            (RenderScenes.Menger(2), RenderScenes.At(0, 0, 3), new Colour(1, 0.5, 0)),
            (RenderScenes.Menger(3), Transformation.Identity with { Scale = new(-1, 1.3, 0.8), Rotation = new(20, 30, 40) },
            new Colour(0, 0.5, 1)),
            (ModelOf("tree", 4), new Transformation(new(0.5, -1, -1), new(0, 30, 0), new(1, 1, -1)), new Colour(0, 1, 0)),
            (RenderScenes.Model(RenderScenes.Ball(6)), RenderScenes.At(-1, 0.8, -1), null),
            (RenderScenes.Model(RenderScenes.Ball(40), "large.obj"), RenderScenes.At(1.5, 1, 0.5), null));
        AssertSame(scene, new(Aside, Projection.Perspective));
        AssertSame(scene, new(Aside, Projection.Orthographic) { OrthographicHeight = 5 });
    }

    [SkippableTheory]
    [InlineData(2, 3)]
    [InlineData(3, 200)]
    [InlineData(7, 5)]
    [InlineData(200, 1)]
    [InlineData(9, 9)]
    public void Picture_OfFewPixels_IsThatOfEveryInstance(int width, int height)
    {
        var scene =
            RenderScenes.Scene(new Scene { Background = Colour.Black }, (RenderScenes.Menger(2), Transformation.Identity, Colour.White));
        var view = View.Of(scene, (double)width / height);
        // Of a picture of few pixels, the sponge as a whole is what is small.
        var (all, chosen) =
            (RenderScenes.Draw(scene, view, width, height, All),
            RenderScenes.Draw(scene, view, width, height, Chosen with { Culling = new() { MinProjectedSize = 0 } }));
        Assert.True(Pictures.Ratio(chosen, all) >= Pictures.Same, Invariant($"{Pictures.Ratio(chosen, all):F1} dB"));
        RenderScenes.Draw(scene, view, width, height, Chosen with { Samples = 4 });
    }

    [SkippableFact]
    public void Transparent_ObjectBeforeAFractal_HidesNothing()
    {
        var glass = TexturedScenes.Of(RenderScenes.Cube(1), new("glass") { Diffuse = new(1, 0, 0), Opacity = 0.4 });
        var scene = RenderScenes.Scene(
            new Scene { Background = Colour.Black },
            (glass, Transformation.Identity with { Position = new(0, 0, -2), Scale = new(3, 3, 0.1) }, null),
            (RenderScenes.Menger(2), Transformation.Identity, Colour.White));
        AssertSame(scene, RenderScenes.FrontView);
        // Behind the glass the sponge is seen: about as many pixels with blue in them as without the glass.
        var alone =
            RenderScenes.Scene(new Scene { Background = Colour.Black }, (RenderScenes.Menger(2), Transformation.Identity, Colour.White));
        var (through, without) = (RenderScenes.Draw(scene, RenderScenes.FrontView, settings: Chosen),
            RenderScenes.Draw(alone, RenderScenes.FrontView, settings: Chosen));
        Assert.InRange(CountBlue(through), 0.99 * CountBlue(without), CountBlue(without));
    }

    [SkippableFact]
    public void Transparent_FractalBeforeAFractal_IsThatOfEveryInstance()
    {
        var glass = TexturedScenes.Of(RenderScenes.Cube(1), new("glass") { Diffuse = new(1, 0, 0), Opacity = 0.4 });
        var fractal =
            new FractalModel(new(RenderScenes.Menger(1).Fractal.Description, glass.Mesh)) { SourcePath = "glass.fdo", Materials = glass.Materials };
        // Transparent instances are drawn in no stated order, so those of the fractal are side by side.
        var scene = RenderScenes.Scene(
            new Scene { Background = Colour.Black },
            (fractal, Transformation.Identity with { Position = new(0, 0, -2), Scale = new(1, 1, 0.01) }, null),
            (RenderScenes.Menger(2), Transformation.Identity, Colour.White));
        var (all, chosen) =
            (RenderScenes.Draw(scene, RenderScenes.FrontView, settings: All),
            RenderScenes.Draw(scene, RenderScenes.FrontView, settings: Chosen));
        Assert.InRange(CountBlue(chosen), 0.99 * CountBlue(all), 1.01 * CountBlue(all));
    }

    [SkippableFact]
    public void Move_OfAnObject_DrawsItInItsNewPlace()
    {
        var scene = RenderScenes.Scene(
            new Scene(), (RenderScenes.Menger(2), RenderScenes.At(-1, 0, 0), null),
            (RenderScenes.Menger(2), RenderScenes.At(1.5, 0, 0), null));
        var view = new View(Aside, Projection.Perspective) { Clip = (1, 20) };
        var places = (Vector[])[new(2, 1, 1), new(-1, 0, 0.5), new(-1, 0, 0)];
        var there = places.Select(place => RenderScenes.Draw(
            scene with { Objects =
            RenderScenes.Scene(new Scene(), (scene.Objects[0].Model, RenderScenes.At(place.X, place.Y, place.Z), null),
            (scene.Objects[1].Model, RenderScenes.At(1.5, 0, 0), null)).Objects },
            view, Width, Height, All)).ToArray();
        using var context = GlTests.Open();
        using var frame = new FrameRenderer(context);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, Chosen));
        frame.Draw(renderer, view, Width, Height, Chosen);
        var before = frame.Capture();
        for (var i = 0; i < places.Length; i++)
        {
            renderer.Move(0, AffineMap.Translate(places[i]));
            frame.Draw(renderer, view, Width, Height, Chosen);
            var moved = frame.Capture();
            Assert.True(Pictures.Ratio(moved, there[i]) >= Pictures.Same,
                Invariant($"{Pictures.Ratio(moved, there[i]):F1} dB at {places[i]}"));
            // At the end it is back where it was.
            Assert.Equal(i == places.Length - 1, before.Pixels.AsSpan().SequenceEqual(moved.Pixels));
        }
    }

    [SkippableFact]
    public void Draw_WithNothingChanged_ChoosesAndUploadsNothing()
    {
        var scene = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(3), Transformation.Identity, null),
            (ModelOf("tree", 5), RenderScenes.At(0, 0, 2), null));
        var view = new View(Aside, Projection.Perspective);
        using var context = GlTests.Open();
        using var frame = new FrameRenderer(context);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, Chosen));
        frame.Draw(renderer, view, Width, Height, Chosen);
        var first = renderer.Statistics;
        Assert.Equal(1, first.CullCount);
        Assert.Equal(first.UploadedBytes, first.InstanceCount * (long)VisibleSet.FloatsPerInstance * sizeof(float));
        void AssertKept()
        {
            var now = renderer.Statistics;
            Assert.Equal(first with { Optimisations = default }, now with { Optimisations = default });
            // The instances of both objects, both objects, the lights.
            Assert.Equal(new(0, 5), now.Optimisations.Uploads);
        }

        // What does not change the choice: colours, shading, and settings of the same values.
        foreach (var same in (RenderSettings[])[Chosen, Chosen with { Shading = Shading.PerPixel },
            new() { Samples = 0, Background = Colour.White }])
        {
            frame.Draw(renderer, view with { }, Width, Height, same);
            AssertKept();
        }

        renderer.Move(0, renderer.MapOf(0));
        frame.Draw(renderer, view, Width, Height, Chosen);
        AssertKept();
        // What does: the camera, the size, the projection, the samples, the settings, a moved object.
        var choices = 1;
        void AssertNew(View seen, int width, RenderSettings settings)
        {
            frame.Draw(renderer, seen, width, Height, settings);
            Assert.Equal(++choices, renderer.Statistics.CullCount);
            frame.Draw(renderer, seen, width, Height, settings);
            Assert.Equal(choices, renderer.Statistics.CullCount);
        }

        AssertNew(view with { Camera = Aside with { Position = Aside.Position + (1e-9 * Vector.I) } }, Width, Chosen);
        AssertNew(view, Width + 1, Chosen);
        AssertNew(view with { Projection = Projection.Orthographic }, Width, Chosen);
        AssertNew(view, Width, Chosen with { Samples = 4 });
        AssertNew(view, Width, Chosen with { Culling = new() { MinProjectedSize = 3 } });
        AssertNew(view, Width, Chosen with { Wireframe = true });
        renderer.Move(1, AffineMap.Translate(Vector.I));
        AssertNew(view, Width, Chosen);
    }

    [SkippableFact]
    public void Wireframe_OfAFractal_ShowsWhatIsBehind()
    {
        // Behind a cube that fills the picture.
        var scene = RenderScenes.Scene(
            new Scene { Background = Colour.Black },
            (RenderScenes.Model(RenderScenes.Cube(1)), Transformation.Identity with { Scale = new(4, 4, 0.1) }, Colour.White),
            (RenderScenes.Menger(2), RenderScenes.At(0, 0, 3), Colour.White));
        var view = RenderScenes.FrontView;
        var (all, chosen) = (RenderScenes.Draw(scene, view, Width, Height, All with { Wireframe = true }),
            RenderScenes.Draw(scene, view, Width, Height, Chosen with { Wireframe = true }));
        Assert.True(Pictures.Ratio(chosen, all) >= Pictures.Same, Invariant($"{Pictures.Ratio(chosen, all):F1} dB"));
        Assert.True(RenderScenes.CountOther(chosen, (0, 0, 0, 255)) > 2000);
        AssertSame(scene, view);
    }

    [SkippableTheory]
    [InlineData(2)]
    [InlineData(20)]
    public void Picture_OfABaseBesideItsFractal_IsNoFartherFromTheTruth(double distance)
    {
        // A Sierpiński triangle whose maps shrink towards points far from the base mesh, so that the base at a level stands beside what is
        // below it.
        var set = new TransformationSet([
            Samples.MoveAndScale(distance, 0, 0, 0.5), Samples.MoveAndScale(distance + 1, 0, 0, 0.5),
            Samples.MoveAndScale(distance, 1, 0, 0.5)]);
        var fractal = new Fractal(new([new Repetition([set], 9)]), RenderScenes.Cube(1));
        var model = new FractalModel(fractal) { SourcePath = "beside.fdo" };
        var scene = RenderScenes.Scene(new Scene { Background = Colour.Black }, (model, Transformation.Identity, Colour.White));
        var view = View.Of(scene, (double)Width / Height);
        var (all, chosen) =
            (RenderScenes.Draw(scene, view, 3 * Width, 3 * Height, All), RenderScenes.Draw(scene, view, Width, Height, Chosen));
        var (missing, beside) =
            (Pictures.ShareNotNear(Pictures.Shrunk(all, 3), chosen), Pictures.ShareNotNear(chosen, Pictures.Shrunk(all, 3)));
        Assert.True(missing < 0.02
            && beside < 0.02,
            Invariant($"{missing:P1} of the pixels have nothing near them in the picture, {beside:P1} of the picture's are near nothing"));
        AssertNoFarther(model, Projection.Perspective, $"base {distance} units beside the fractal");
    }

    [SkippableFact]
    public void Picture_OfDust_IsNoFartherFromTheTruth()
    {
        // Copies so small that all of them are less than a pixel, far from each other.
        var random = new Random(7);
        var set =
            new TransformationSet(
                [.. Enumerable.Range(0, 60).Select(_ => new Transformation(random.Vector(), Vector.Zero, 0.002 * Vector.One))]);
        AssertNoFarther(new FractalModel(new(new([set]), RenderScenes.Cube(1))) { SourcePath = "dust.fdo" }, Projection.Perspective, "dust");
    }

    [SkippableFact]
    public void Picture_OfAnInfiniteFractal_IsThatOfADeepOne()
    {
        // At depth 5 the cubes are below a pixel, at the corner nearest to the camera too.
        var infinite = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(null), Transformation.Identity, null));
        var deep = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(8), Transformation.Identity, null));
        var view = new View(Aside, Projection.Perspective) { Clip = (1, 20) };
        var (picture1, picture2) =
            (RenderScenes.Draw(infinite, view, Width, Height, Chosen), RenderScenes.Draw(deep, view, Width, Height, Chosen));
        Assert.True(Pictures.Ratio(picture1, picture2) >= Pictures.Same, Invariant($"{Pictures.Ratio(picture1, picture2):F1} dB"));
    }

    [SkippableFact]
    public void Prepare_OfAnyFractalThatWasDrawnBefore_StillWorks()
    {
        // What has no levels to choose from is drawn in full, with a notice: one that grows, and one with a flat map.
        foreach (var transformation in (Transformation[])[Samples.MoveAndScale(1, 0, 0, 1.5), new(Vector.I, Vector.Zero, new(0.5, 0.5, 0))])
        {
            var set = new TransformationSet(ImmutableArray.Create(transformation, Samples.MoveAndScale(0, 1, 0, 0.5)));
            var model = new FractalModel(new(new([new Repetition([set], 3)]), RenderScenes.Cube(1))) { SourcePath = "odd.fdo" };
            AssertSame(RenderScenes.Scene(new Scene(), (model, Transformation.Identity, null)));
        }
    }

    private static FractalModel ModelOf(string name, int depth) =>
        new(depth < 0 ? AssetFractals.Load(name) : AssetFractals.Load(name, depth)) { SourcePath = name };

    private static void CheckSmall(string name, int depth)
    {
        foreach (var projection in (Projection[])[Projection.Perspective, Projection.Orthographic])
        {
            AssertNoFarther(ModelOf(name, depth), projection, $"{name} at depth {depth}");
        }
    }

    private static void AssertNoFarther(FractalModel model, Projection projection, string what)
    {
        foreach (var (samples, difference, toAll) in DifferencesToTruth(model, projection))
        {
            Assert.True(difference >= -NoFarther,
                Invariant(
                    $"{what}, {projection}, {samples} samples: {difference:F2} dB; {toAll:F1} dB from the picture of every instance"));
        }
    }

    /// <summary>
    /// By how much the picture is nearer to the truth than that of every instance is, decibels; and how far it is from that one.
    /// </summary>
    private static List<(int Samples, double Difference, double ToAll)> DifferencesToTruth(FractalModel model, Projection projection)
    {
        var scene = RenderScenes.Scene(new Scene { Projection = projection }, (model, Transformation.Identity, null));
        var view = View.Of(scene, (double)Width / Height);
        using var context = GlTests.Open();
        using var frame = new FrameRenderer(context);
        using var every = new SceneRenderer(context, DrawableScene.Prepare(scene, All));
        using var some = new SceneRenderer(context, DrawableScene.Prepare(scene, Chosen));
        Assert.Empty(every.Scene.Notices);
        frame.Draw(every, view, Supersampling * Width, Supersampling * Height, All);
        var truth = Pictures.Shrunk(frame.Capture(), Supersampling);
        var differences = new List<(int, double, double)>();
        foreach (var samples in (int[])[0, 4])
        {
            frame.Draw(every, view, Width, Height, All with { Samples = samples });
            var all = frame.Capture();
            frame.Draw(some, view, Width, Height, Chosen with { Samples = samples });
            var picture = frame.Capture();
            differences.Add((samples, Pictures.Ratio(picture, truth) - Pictures.Ratio(all, truth), Pictures.Ratio(picture, all)));
        }

        return differences;
    }

    private static void AssertSame(LoadedScene scene, View? view = null)
    {
        view ??= View.Of(scene, (double)Width / Height);
        using var context = GlTests.Open();
        using var frame = new FrameRenderer(context);
        using var every = new SceneRenderer(context, DrawableScene.Prepare(scene, All));
        using var some = new SceneRenderer(context, DrawableScene.Prepare(scene, Chosen));
        foreach (var samples in (int[])[0, 4])
        {
            frame.Draw(every, view, Width, Height, All with { Samples = samples });
            var all = frame.Capture();
            frame.Draw(some, view, Width, Height, Chosen with { Samples = samples });
            var ratio = Pictures.Ratio(frame.Capture(), all);
            Assert.True(ratio >= Pictures.Same, Invariant($"{view.Projection}, {samples} samples: {ratio:F1} dB, {some.Statistics}"));
        }

        context.Resources.ThrowOnError("drawing");
    }

    private static int CountBlue(PixelImage image) =>
        Enumerable.Range(0, image.Width * image.Height).Count(i => image.Pixels[(4 * i) + 2] > 0);
}
