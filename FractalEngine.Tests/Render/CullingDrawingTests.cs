using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Support;
using static System.FormattableString;

namespace FractalEngine.Tests.Render;

/// <summary>
/// Pictures for which instances are chosen, beside those of every instance and those of the truth: the same with 36 samples a pixel.
/// </summary>
[Collection(GlTests.Name)]
public sealed class CullingDrawingTests
{
    private const int Width = 400;
    private const int Height = 300;
    private const int Supersampling = 6;

    // Decibels by which a picture may be farther from the truth than that of every instance.
    private const double MaxLossDecibels = 0.3;

    private static readonly RenderSettings Culled = new() { Samples = 0 };
    private static readonly RenderSettings EveryInstance = Culled with { Culling = null };
    private static readonly Camera ObliqueCamera = new(new(-3.2, 2.6, -4), CameraFraming.LookRotation(new(3.2, -2.6, 4)), 45);

    /// <summary>
    /// Each fractal of the assets at a depth where half of the instances are larger than two pixels; −1 for what has no depth.
    /// </summary>
    public static TheoryData<string, int> LargeInstances => new()
    {
        { "appendix-b", 1 }, { "appendix-b-structure", 2 }, { "diamond", 2 }, { "fern", 1 }, { "googol", 3 }, { "infinite-menger", 2 },
        { "menger", 3 }, { "menger-3", 2 }, { "menger-4", 2 },
        { "romanesco", 2 }, { "shell", -1 }, { "sierpinski", 3 }, { "terrain", 4 }, { "tetrahedron", 4 }, { "tree", 5 },
        { "tree-leaves", 5 },
    };

    /// <summary>Some with smaller instances.</summary>
    public static TheoryData<string, int> SmallInstances => new() { { "appendix-b", 2 }, { "snowflake", -1 }, { "tetrahedron", 7 } };

    /// <summary>The rest, and deeper ones, up to 200,000 instances.</summary>
    public static TheoryData<string, int> SmallInstancesForSoak => new()
    {
        { "appendix-b-structure", 3 }, { "appendix-b", 3 }, { "diamond", 3 }, { "fern", 2 }, { "fern", 3 }, { "googol", 5 },
        { "menger-3", 3 }, { "menger-4", 4 }, { "romanesco", 3 }, { "sierpinski", 5 }, { "sierpinski", 6 }, { "terrain", 8 },
        { "tetrahedron", 8 }, { "tree", 7 },
        { "tree-leaves", 7 },
    };

    [SkippableTheory]
    [MemberData(nameof(LargeInstances))]
    public void Frame_OfLargeInstances_IsThatOfEveryInstance(string name, int depth)
    {
        var model = LoadModel(name, depth);
        foreach (var projection in (Projection[])[Projection.Perspective, Projection.Orthographic])
        {
            AssertSameImage(RenderScenes.Scene(new Scene { Projection = projection }, (model, Transformation.Identity, null)));
        }
    }

    [SkippableTheory]
    [MemberData(nameof(SmallInstances))]
    public void Frame_OfSmallInstances_IsNoFartherFromTheReference(string name, int depth) => CheckSmallInstances(name, depth);

    [SkippableTheory]
    [Trait("Category", "Soak")]
    [MemberData(nameof(SmallInstancesForSoak))]
    public void Frame_OfManySmallInstances_IsNoFartherFromTheReference(string name, int depth) => CheckSmallInstances(name, depth);

    [SkippableTheory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void Frame_FromInside_IsThatOfEveryInstance(Projection projection)
    {
        // In a hole of the sponge, in one of its cubes, and with planes that cut it.
        var scene = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(3), Transformation.Identity, null));
        var eyes = (Vector[])[new(0.02, 0.03, -0.1), new(0.95, 0.95, 0.95), new(-0.4, 0.1, -0.9)];
        View[] views =
        [
            .. eyes.Select(eye => new View(new(eye, new(0.2, 0.4, 0), 60), projection) { OrthographicHeight = 1.5 }),
            new View(ObliqueCamera, projection) { Clip = (4.5, 6.2), OrthographicHeight = 4 },
            new View(ObliqueCamera, projection) { Aspect = 1, OrthographicHeight = 4 },
        ];
        foreach (var view in views)
        {
            AssertSameImage(scene, view);
        }
    }

    [SkippableFact]
    public void Frame_OfOverlappingObjects_IsThatOfEveryInstance()
    {
        // Two that pass through each other, one of them mirrored and skewed, one behind both, one that is a plain mesh, and a large one.
        var scene = RenderScenes.Scene(
            new Scene(),
            (RenderScenes.Menger(2), RenderScenes.TranslatedTo(0, 0, 3), new Colour(1, 0.5, 0)),
            (RenderScenes.Menger(3), Transformation.Identity with { Scale = new(-1, 1.3, 0.8), Rotation = new(20, 30, 40) },
            new Colour(0, 0.5, 1)),
            (LoadModel("tree", 4), new Transformation(new(0.5, -1, -1), new(0, 30, 0), new(1, 1, -1)), new Colour(0, 1, 0)),
            (RenderScenes.Model(RenderScenes.Sphere(6)), RenderScenes.TranslatedTo(-1, 0.8, -1), null),
            (RenderScenes.Model(RenderScenes.Sphere(40), "large.obj"), RenderScenes.TranslatedTo(1.5, 1, 0.5), null));
        AssertSameImage(scene, new(ObliqueCamera, Projection.Perspective));
        AssertSameImage(scene, new(ObliqueCamera, Projection.Orthographic) { OrthographicHeight = 5 });
    }

    [SkippableTheory]
    [InlineData(2, 3)]
    [InlineData(3, 200)]
    [InlineData(7, 5)]
    [InlineData(200, 1)]
    [InlineData(9, 9)]
    public void Frame_OfFewPixels_IsThatOfEveryInstance(int width, int height)
    {
        var scene =
            RenderScenes.Scene(new Scene { Background = Colour.Black }, (RenderScenes.Menger(2), Transformation.Identity, Colour.White));
        var view = View.Of(scene, (double)width / height);
        // Of a picture of few pixels, the sponge as a whole is what is small.
        var (all, culled) =
            (RenderScenes.Draw(scene, view, width, height, EveryInstance),
            RenderScenes.Draw(scene, view, width, height, Culled with { Culling = new() { MinProjectedSize = 0 } }));
        Assert.True(ImageComparison.PeakSignalToNoiseRatio(culled, all) >= ImageComparison.MinSameDecibels,
            Invariant($"{ImageComparison.PeakSignalToNoiseRatio(culled, all):F1} dB"));
        RenderScenes.Draw(scene, view, width, height, Culled with { Samples = 4 });
    }

    [SkippableFact]
    public void Transparent_ObjectBeforeAFractal_HidesNothing()
    {
        var glass = TexturedScenes.WithMaterial(RenderScenes.Cube(1), new("glass") { Diffuse = new(1, 0, 0), Opacity = 0.4 });
        var scene = RenderScenes.Scene(
            new Scene { Background = Colour.Black },
            (glass, Transformation.Identity with { Position = new(0, 0, -2), Scale = new(3, 3, 0.1) }, null),
            (RenderScenes.Menger(2), Transformation.Identity, Colour.White));
        AssertSameImage(scene, RenderScenes.FrontView);
        // Behind the glass the sponge is seen: about as many pixels with blue in them as without the glass.
        var alone =
            RenderScenes.Scene(new Scene { Background = Colour.Black }, (RenderScenes.Menger(2), Transformation.Identity, Colour.White));
        var (through, without) = (RenderScenes.Draw(scene, RenderScenes.FrontView, settings: Culled),
            RenderScenes.Draw(alone, RenderScenes.FrontView, settings: Culled));
        Assert.InRange(CountBlue(through), 0.99 * CountBlue(without), CountBlue(without));
    }

    [SkippableFact]
    public void Transparent_FractalBeforeAFractal_IsThatOfEveryInstance()
    {
        var glass = TexturedScenes.WithMaterial(RenderScenes.Cube(1), new("glass") { Diffuse = new(1, 0, 0), Opacity = 0.4 });
        var fractal =
            new FractalModel(new(RenderScenes.Menger(1).Fractal.Description, glass.Mesh)) { SourcePath = "glass.fdo",
            Materials = glass.Materials };
        // Transparent instances are drawn in no stated order, so those of the fractal are side by side.
        var scene = RenderScenes.Scene(
            new Scene { Background = Colour.Black },
            (fractal, Transformation.Identity with { Position = new(0, 0, -2), Scale = new(1, 1, 0.01) }, null),
            (RenderScenes.Menger(2), Transformation.Identity, Colour.White));
        var (all, culled) =
            (RenderScenes.Draw(scene, RenderScenes.FrontView, settings: EveryInstance),
            RenderScenes.Draw(scene, RenderScenes.FrontView, settings: Culled));
        Assert.InRange(CountBlue(culled), 0.99 * CountBlue(all), 1.01 * CountBlue(all));
    }

    [SkippableFact]
    public void Move_OfAnObject_DrawsItAtItsNewPosition()
    {
        var scene = RenderScenes.Scene(
            new Scene(), (RenderScenes.Menger(2), RenderScenes.TranslatedTo(-1, 0, 0), null),
            (RenderScenes.Menger(2), RenderScenes.TranslatedTo(1.5, 0, 0), null));
        var view = new View(ObliqueCamera, Projection.Perspective) { Clip = (1, 20) };
        var positions = (Vector[])[new(2, 1, 1), new(-1, 0, 0.5), new(-1, 0, 0)];
        var expected = positions.Select(position => RenderScenes.Draw(
            scene with { Objects =
            RenderScenes.Scene(new Scene(), (scene.Objects[0].Model, RenderScenes.TranslatedTo(position.X, position.Y, position.Z), null),
            (scene.Objects[1].Model, RenderScenes.TranslatedTo(1.5, 0, 0), null)).Objects },
            view, Width, Height, EveryInstance)).ToArray();
        using var context = GlTests.OpenContext();
        using var frame = new FrameRenderer(context);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, Culled));
        frame.Draw(renderer, view, Width, Height, Culled);
        var before = frame.Capture();
        for (var i = 0; i < positions.Length; i++)
        {
            renderer.Move(0, AffineMap.Translate(positions[i]));
            frame.Draw(renderer, view, Width, Height, Culled);
            var moved = frame.Capture();
            Assert.True(ImageComparison.PeakSignalToNoiseRatio(moved, expected[i]) >= ImageComparison.MinSameDecibels,
                Invariant($"{ImageComparison.PeakSignalToNoiseRatio(moved, expected[i]):F1} dB at {positions[i]}"));
            // At the end it is back where it was.
            Assert.Equal(i == positions.Length - 1, before.Pixels.AsSpan().SequenceEqual(moved.Pixels));
        }
    }

    [SkippableFact]
    public void Draw_WithNothingChanged_CullsAndUploadsNothing()
    {
        var scene = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(3), Transformation.Identity, null),
            (LoadModel("tree", 5), RenderScenes.TranslatedTo(0, 0, 2), null));
        var view = new View(ObliqueCamera, Projection.Perspective);
        using var context = GlTests.OpenContext();
        using var frame = new FrameRenderer(context);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, Culled));
        frame.Draw(renderer, view, Width, Height, Culled);
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
        foreach (var same in (RenderSettings[])[Culled, Culled with { Shading = Shading.PerPixel },
            new() { Samples = 0, Background = Colour.White }])
        {
            frame.Draw(renderer, view with { }, Width, Height, same);
            AssertKept();
        }

        renderer.Move(0, renderer.MapOf(0));
        frame.Draw(renderer, view, Width, Height, Culled);
        AssertKept();
        // What does: the camera, the size, the projection, the samples, the settings, a moved object.
        var cullCount = 1;
        void AssertNew(View seen, int width, RenderSettings settings)
        {
            frame.Draw(renderer, seen, width, Height, settings);
            Assert.Equal(++cullCount, renderer.Statistics.CullCount);
            frame.Draw(renderer, seen, width, Height, settings);
            Assert.Equal(cullCount, renderer.Statistics.CullCount);
        }

        AssertNew(view with { Camera = ObliqueCamera with { Position = ObliqueCamera.Position + (1e-9 * Vector.I) } }, Width, Culled);
        AssertNew(view, Width + 1, Culled);
        AssertNew(view with { Projection = Projection.Orthographic }, Width, Culled);
        AssertNew(view, Width, Culled with { Samples = 4 });
        AssertNew(view, Width, Culled with { Culling = new() { MinProjectedSize = 3 } });
        AssertNew(view, Width, Culled with { Wireframe = true });
        renderer.Move(1, AffineMap.Translate(Vector.I));
        AssertNew(view, Width, Culled);
    }

    [SkippableFact]
    public void Wireframe_OfAFractal_ShowsWhatIsBehind()
    {
        // Behind a cube that fills the picture.
        var scene = RenderScenes.Scene(
            new Scene { Background = Colour.Black },
            (RenderScenes.Model(RenderScenes.Cube(1)), Transformation.Identity with { Scale = new(4, 4, 0.1) }, Colour.White),
            (RenderScenes.Menger(2), RenderScenes.TranslatedTo(0, 0, 3), Colour.White));
        var view = RenderScenes.FrontView;
        var (all, culled) = (RenderScenes.Draw(scene, view, Width, Height, EveryInstance with { Wireframe = true }),
            RenderScenes.Draw(scene, view, Width, Height, Culled with { Wireframe = true }));
        Assert.True(ImageComparison.PeakSignalToNoiseRatio(culled, all) >= ImageComparison.MinSameDecibels,
            Invariant($"{ImageComparison.PeakSignalToNoiseRatio(culled, all):F1} dB"));
        Assert.True(RenderScenes.CountDifferent(culled, (0, 0, 0, 255)) > 2000);
        AssertSameImage(scene, view);
    }

    [SkippableTheory]
    [InlineData(2)]
    [InlineData(20)]
    public void Frame_OfABaseOutsideItsFractal_IsNoFartherFromTheReference(double distance)
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
        var (all, culled) =
            (RenderScenes.Draw(scene, view, 3 * Width, 3 * Height, EveryInstance), RenderScenes.Draw(scene, view, Width, Height, Culled));
        var (missing, extra) =
            (ImageComparison.FractionWithoutNeighbour(ImageComparison.Downsample(all, 3), culled),
            ImageComparison.FractionWithoutNeighbour(culled, ImageComparison.Downsample(all, 3)));
        Assert.True(missing < 0.02
            && extra < 0.02,
            Invariant($"{missing:P1} of the pixels have nothing near them in the picture, {extra:P1} of the picture's are near nothing"));
        AssertNotFartherFromReference(model, Projection.Perspective, $"base {distance} units beside the fractal");
    }

    [SkippableFact]
    public void Frame_OfDust_IsNoFartherFromTheReference()
    {
        // Copies so small that all of them are less than a pixel, far from each other.
        var random = new Random(7);
        var set =
            new TransformationSet(
                [.. Enumerable.Range(0, 60).Select(_ => new Transformation(random.Vector(), Vector.Zero, 0.002 * Vector.One))]);
        AssertNotFartherFromReference(new FractalModel(new(new([set]), RenderScenes.Cube(1))) { SourcePath = "dust.fdo" },
            Projection.Perspective, "dust");
    }

    [SkippableFact]
    public void Frame_OfAnInfiniteFractal_IsThatOfADeepOne()
    {
        // At depth 5 the cubes are below a pixel, at the corner nearest to the camera too.
        var infinite = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(null), Transformation.Identity, null));
        var deep = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(8), Transformation.Identity, null));
        var view = new View(ObliqueCamera, Projection.Perspective) { Clip = (1, 20) };
        var (infiniteImage, deepImage) =
            (RenderScenes.Draw(infinite, view, Width, Height, Culled), RenderScenes.Draw(deep, view, Width, Height, Culled));
        Assert.True(ImageComparison.PeakSignalToNoiseRatio(infiniteImage, deepImage) >= ImageComparison.MinSameDecibels,
            Invariant($"{ImageComparison.PeakSignalToNoiseRatio(infiniteImage, deepImage):F1} dB"));
    }

    [SkippableFact]
    public void Prepare_OfAnyFractalThatWasDrawnBefore_StillWorks()
    {
        // What has no levels to choose from is drawn in full, with a notice: one that grows, and one with a flat map.
        foreach (var transformation in (Transformation[])[Samples.MoveAndScale(1, 0, 0, 1.5), new(Vector.I, Vector.Zero, new(0.5, 0.5, 0))])
        {
            var set = new TransformationSet(ImmutableArray.Create(transformation, Samples.MoveAndScale(0, 1, 0, 0.5)));
            var model = new FractalModel(new(new([new Repetition([set], 3)]), RenderScenes.Cube(1))) { SourcePath = "odd.fdo" };
            AssertSameImage(RenderScenes.Scene(new Scene(), (model, Transformation.Identity, null)));
        }
    }

    private static FractalModel LoadModel(string name, int depth) =>
        new(depth < 0 ? AssetFractals.Load(name) : AssetFractals.Load(name, depth)) { SourcePath = name };

    private static void CheckSmallInstances(string name, int depth)
    {
        foreach (var projection in (Projection[])[Projection.Perspective, Projection.Orthographic])
        {
            AssertNotFartherFromReference(LoadModel(name, depth), projection, $"{name} at depth {depth}");
        }
    }

    private static void AssertNotFartherFromReference(FractalModel model, Projection projection, string description)
    {
        foreach (var (samples, difference, toAll) in MeasureGains(model, projection))
        {
            Assert.True(difference >= -MaxLossDecibels,
                Invariant(
                    $"{description}, {projection}, {samples} samples: {difference:F2} dB; {toAll:F1} dB from the picture of every instance"));
        }
    }

    /// <summary>
    /// By how much the picture is nearer to the truth than that of every instance is, decibels; and how far it is from that one.
    /// </summary>
    private static List<(int Samples, double Difference, double ToAll)> MeasureGains(FractalModel model, Projection projection)
    {
        var scene = RenderScenes.Scene(new Scene { Projection = projection }, (model, Transformation.Identity, null));
        var view = View.Of(scene, (double)Width / Height);
        using var context = GlTests.OpenContext();
        using var frame = new FrameRenderer(context);
        using var everyInstance = new SceneRenderer(context, DrawableScene.Prepare(scene, EveryInstance));
        using var culled = new SceneRenderer(context, DrawableScene.Prepare(scene, Culled));
        Assert.Empty(everyInstance.Scene.Notices);
        frame.Draw(everyInstance, view, Supersampling * Width, Supersampling * Height, EveryInstance);
        var truth = ImageComparison.Downsample(frame.Capture(), Supersampling);
        var differences = new List<(int, double, double)>();
        foreach (var samples in (int[])[0, 4])
        {
            frame.Draw(everyInstance, view, Width, Height, EveryInstance with { Samples = samples });
            var all = frame.Capture();
            frame.Draw(culled, view, Width, Height, Culled with { Samples = samples });
            var image = frame.Capture();
            differences.Add(
                (samples, ImageComparison.PeakSignalToNoiseRatio(image, truth) - ImageComparison.PeakSignalToNoiseRatio(all, truth),
                ImageComparison.PeakSignalToNoiseRatio(image, all)));
        }

        return differences;
    }

    private static void AssertSameImage(LoadedScene scene, View? view = null)
    {
        view ??= View.Of(scene, (double)Width / Height);
        using var context = GlTests.OpenContext();
        using var frame = new FrameRenderer(context);
        using var everyInstance = new SceneRenderer(context, DrawableScene.Prepare(scene, EveryInstance));
        using var culled = new SceneRenderer(context, DrawableScene.Prepare(scene, Culled));
        foreach (var samples in (int[])[0, 4])
        {
            frame.Draw(everyInstance, view, Width, Height, EveryInstance with { Samples = samples });
            var all = frame.Capture();
            frame.Draw(culled, view, Width, Height, Culled with { Samples = samples });
            var ratio = ImageComparison.PeakSignalToNoiseRatio(frame.Capture(), all);
            Assert.True(ratio >= ImageComparison.MinSameDecibels,
                Invariant($"{view.Projection}, {samples} samples: {ratio:F1} dB, {culled.Statistics}"));
        }

        context.Resources.ThrowOnError("drawing");
    }

    private static int CountBlue(PixelImage image) =>
        Enumerable.Range(0, image.Width * image.Height).Count(i => image.Pixels[(4 * i) + 2] > 0);
}
