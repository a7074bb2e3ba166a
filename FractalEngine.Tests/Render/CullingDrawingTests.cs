using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;
using FractalEngine.Core.Visibility;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;
using static System.FormattableString;

namespace FractalEngine.Tests.Render;

/// <summary>
/// Frames of culled instances, compared with those of every instance and with a reference: every instance at 36 samples a pixel.
/// </summary>
[Collection(GlTests.Name)]
public sealed class CullingDrawingTests
{
    private const int Width = 400;
    private const int Height = 300;
    private const int Supersampling = 6;

    // Decibels by which a frame may be farther from the reference than that of every instance.
    private const double MaxLossDecibels = 0.3;

    // Only culled instances come with what they see of the sky.
    private static readonly RenderSettings Culled = new() { Samples = 0, AmbientOcclusion = false };
    private static readonly RenderSettings EveryInstance = Culled with { Culling = null };
    private static readonly Camera ObliqueCamera = new(new(-3.2, 2.6, -4), CameraFraming.LookRotation(new(3.2, -2.6, 4)), 45);

    /// <summary>
    /// Fractals of the assets, each at a depth where half of the instances are larger than two pixels; −1 for fractals without a depth.
    /// </summary>
    public static TheoryData<string, int> LargeInstances => new()
    {
        { "appendix-b", 1 }, { "infinite-menger", 2 }, { "terrain", 4 },
    };

    /// <summary>Those of the other fractals.</summary>
    public static TheoryData<string, int> LargeInstancesForSoak => new()
    {
        { "appendix-b-structure", 2 }, { "diamond", 2 }, { "googol", 3 }, { "menger", 3 }, { "menger-3", 2 }, { "menger-4", 2 },
        { "tetrahedron", 4 }, { "tree-leaves", 5 }, { "fern", 1 }, { "romanesco", 2 }, { "sierpinski", 3 },
        { "shell", -1 }, { "tree", 5 },
    };

    /// <summary>Fractals at depths with smaller instances.</summary>
    public static TheoryData<string, int> SmallInstances => new() { { "snowflake", -1 } };

    /// <summary>The other fractals, and greater depths, up to 200,000 instances.</summary>
    public static TheoryData<string, int> SmallInstancesForSoak => new()
    {
        { "appendix-b", 2 },
        { "appendix-b-structure", 3 }, { "appendix-b", 3 }, { "diamond", 3 }, { "fern", 2 }, { "fern", 3 }, { "googol", 5 },
        { "menger-3", 3 }, { "menger-4", 4 }, { "romanesco", 3 }, { "sierpinski", 5 }, { "sierpinski", 6 }, { "terrain", 8 },
        { "tetrahedron", 7 }, { "tetrahedron", 8 }, { "tree", 7 }, { "tree-leaves", 7 },
    };

    [SkippableTheory]
    [MemberData(nameof(LargeInstances))]
    public void Frame_OfLargeInstances_IsThatOfEveryInstance(string name, int depth) => CheckLargeInstances(name, depth);

    [SkippableTheory]
    [Trait("Category", "Soak")]
    [MemberData(nameof(LargeInstancesForSoak))]
    public void Frame_OfOtherLargeInstances_IsThatOfEveryInstance(string name, int depth) => CheckLargeInstances(name, depth);

    private static void CheckLargeInstances(string name, int depth)
    {
        var scene = RenderScenes.Scene(new Scene(), (LoadModel(name, depth), Transformation.Identity, null));
        AssertSameImages(
            scene,
            [.. new[] { Projection.Perspective, Projection.Orthographic }.Select(projection =>
                View.Of(scene with { Scene = scene.Scene with { Projection = projection } }, (double)Width / Height))]);
    }

    [SkippableTheory]
    [MemberData(nameof(SmallInstances))]
    public void Frame_OfSmallInstances_IsNoFartherFromTheReference(string name, int depth) => CheckSmallInstances(name, depth);

    [SkippableTheory]
    [Trait("Category", "Soak")]
    [MemberData(nameof(SmallInstancesForSoak))]
    public void Frame_OfManySmallInstances_IsNoFartherFromTheReference(string name, int depth) => CheckSmallInstances(name, depth);

    [SkippableFact]
    public void Frame_FromInside_IsThatOfEveryInstance() => CheckFromInside(Projection.Perspective, step: 3);

    [SkippableTheory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    [Trait("Category", "Soak")]
    public void FrameOfAnyProjection_FromInside_IsThatOfEveryInstance(Projection projection) => CheckFromInside(projection, step: 1);

    private static void CheckFromInside(Projection projection, int step)
    {
        // From a hole of the sponge, from one of its cubes, and with clip planes that cut it.
        var scene = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(3), Transformation.Identity, null));
        var eyes = (Vector[])[new(0.02, 0.03, -0.1), new(0.95, 0.95, 0.95), new(-0.4, 0.1, -0.9)];
        View[] views =
        [
            .. eyes.Select(eye => new View(new(eye, new(0.2, 0.4, 0), 60), projection) { OrthographicHeight = 1.5 }),
            new View(ObliqueCamera, projection) { FixedClipPlanes = (4.5, 6.2), OrthographicHeight = 4 },
            new View(ObliqueCamera, projection) { Aspect = 1, OrthographicHeight = 4 },
        ];
        AssertSameImages(scene, [.. views.Where((_, i) => i % step == 0)]);
    }

    [SkippableTheory]
    [InlineData(Projection.Perspective)]
    public void Frame_OfOverlappingObjects_IsThatOfEveryInstance(Projection projection)
    {
        // Two fractals that intersect, one of them mirrored and skewed, one more fractal, and two meshes, of which one is large.
        var scene = RenderScenes.Scene(
            new Scene(),
            (RenderScenes.Menger(2), RenderScenes.TranslatedTo(0, 0, 3), new Colour(1, 0.5, 0)),
            (RenderScenes.Menger(3), Transformation.Identity with { Scale = new(-1, 1.3, 0.8), Rotation = new(20, 30, 40) },
            new Colour(0, 0.5, 1)),
            (LoadModel("tree", 4), new Transformation(new(0.5, -1, -1), new(0, 30, 0), new(1, 1, -1)), new Colour(0, 1, 0)),
            (RenderScenes.Model(RenderScenes.Sphere(6)), RenderScenes.TranslatedTo(-1, 0.8, -1), null),
            (RenderScenes.Model(RenderScenes.Sphere(40), "large.obj"), RenderScenes.TranslatedTo(1.5, 1, 0.5), null));
        AssertSameImages(scene, [new(ObliqueCamera, projection) { OrthographicHeight = 5 }]);
    }

    [SkippableTheory]
    [InlineData(Projection.Orthographic)]
    [Trait("Category", "Soak")]
    public void Frame_OfOverlappingObjectsInOtherCases_IsThatOfEveryInstance(Projection projection) =>
        Frame_OfOverlappingObjects_IsThatOfEveryInstance(projection);

    [SkippableTheory]
    [InlineData(2, 3)]
    [InlineData(3, 200)]
    [InlineData(7, 5)]
    [InlineData(200, 1)]
    [InlineData(9, 9)]
    public void Frame_OfFewPixels_IsThatOfEveryInstance(int width, int height)
    {
        var scene = WhiteSponge(2);
        var view = View.Of(scene, (double)width / height);
        // In a frame of few pixels the sponge as a whole would be below the minimum size.
        var all = RenderScenes.Draw(scene, view, width, height, EveryInstance);
        var culled = RenderScenes.Draw(scene, view, width, height, Culled with { Culling = new() { MinProjectedSize = 0 } });
        ImageComparison.AssertSame(all, culled, $"{width}×{height}");
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
        // The sponge is visible through the glass: about as many pixels have blue in them as without the glass.
        var through = RenderScenes.Draw(scene, RenderScenes.FrontView, settings: Culled);
        var without = RenderScenes.Draw(WhiteSponge(2), RenderScenes.FrontView, settings: Culled);
        Assert.InRange(CountBlue(through), 0.99 * CountBlue(without), CountBlue(without));
    }

    [SkippableFact]
    public void Transparent_FractalBeforeAFractal_IsThatOfEveryInstance()
    {
        var glass = TexturedScenes.WithMaterial(RenderScenes.Cube(1), new("glass") { Diffuse = new(1, 0, 0), Opacity = 0.4 });
        var fractal = new FractalModel(new(RenderScenes.Menger(1).Fractal.Description, glass.Mesh))
        {
            SourcePath = "glass.fdo",
            Materials = glass.Materials,
        };
        // Transparent instances are drawn in no defined order, so those of this fractal lie side by side.
        var scene = RenderScenes.Scene(
            new Scene { Background = Colour.Black },
            (fractal, Transformation.Identity with { Position = new(0, 0, -2), Scale = new(1, 1, 0.01) }, null),
            (RenderScenes.Menger(2), Transformation.Identity, Colour.White));
        var all = RenderScenes.Draw(scene, RenderScenes.FrontView, settings: EveryInstance);
        var culled = RenderScenes.Draw(scene, RenderScenes.FrontView, settings: Culled);
        Assert.InRange(CountBlue(culled), 0.99 * CountBlue(all), 1.01 * CountBlue(all));
    }

    [SkippableFact]
    public void Move_OfAnObject_DrawsItAtItsNewPosition()
    {
        var (moving, fixedModel) = (RenderScenes.Menger(2), RenderScenes.Menger(2));
        LoadedScene SceneAt(Vector position) => RenderScenes.Scene(
            new Scene(), (moving, RenderScenes.TranslatedTo(position.X, position.Y, position.Z), null),
            (fixedModel, RenderScenes.TranslatedTo(1.5, 0, 0), null));
        var scene = SceneAt(new(-1, 0, 0));
        var view = new View(ObliqueCamera, Projection.Perspective) { FixedClipPlanes = (1, 20) };
        var positions = (Vector[])[new(2, 1, 1), new(-1, 0, 0.5), new(-1, 0, 0)];
        // The bounds stay those of the first scene, and with them the default lights.
        var expected = positions.Select(position => RenderScenes.Draw(
            scene with { Objects = SceneAt(position).Objects }, view, Width, Height, EveryInstance)).ToArray();
        using var context = new SharedContext();
        using var frame = new FrameRenderer(context);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, Culled));
        frame.Draw(renderer, view, Width, Height, Culled);
        var before = frame.Capture();
        for (var i = 0; i < positions.Length; i++)
        {
            renderer.Move(0, AffineMap.Translate(positions[i]));
            frame.Draw(renderer, view, Width, Height, Culled);
            var moved = frame.Capture();
            ImageComparison.AssertSame(expected[i], moved, Invariant($"at {positions[i]}"));
            // The last position is the first one again.
            Assert.Equal(i == positions.Length - 1, before.Pixels.AsSpan().SequenceEqual(moved.Pixels));
        }
    }

    [SkippableFact]
    public void Draw_WithNothingChanged_CullsAndUploadsNothing()
    {
        var scene = RenderScenes.Scene(new Scene(), (LoadModel("sierpinski", 5), Transformation.Identity, null),
            (LoadModel("tree", 5), RenderScenes.TranslatedTo(0, 0, 2), null));
        var view = new View(ObliqueCamera, Projection.Perspective);
        using var context = new SharedContext();
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
            // The instances of both objects, both object blocks, the lights.
            Assert.Equal(new(0, 5), now.Optimisations.Uploads);
        }

        // Visible instances do not depend on colours and shading, nor on the identity of settings.
        RenderSettings[] equivalent =
            [Culled, Culled with { Shading = Shading.PerPixel }, Culled with { Background = Colour.White }];
        foreach (var settings in equivalent)
        {
            frame.Draw(renderer, view with { }, Width, Height, settings);
            AssertKept();
        }

        renderer.Move(0, renderer.Scene.Objects[0].Map);
        frame.Draw(renderer, view, Width, Height, Culled);
        AssertKept();
        // They depend on the camera, the size, the projection, the samples, the culling settings, and moved objects.
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
        // The fractal is behind a cube that fills the frame.
        var scene = RenderScenes.Scene(
            new Scene { Background = Colour.Black },
            (RenderScenes.Model(RenderScenes.Cube(1)), Transformation.Identity with { Scale = new(4, 4, 0.1) }, Colour.White),
            (RenderScenes.Menger(2), RenderScenes.TranslatedTo(0, 0, 3), Colour.White));
        var view = RenderScenes.FrontView;
        var all = RenderScenes.Draw(scene, view, Width, Height, EveryInstance with { Wireframe = true });
        var culled = RenderScenes.Draw(scene, view, Width, Height, Culled with { Wireframe = true });
        ImageComparison.AssertSame(all, culled, "wireframe");
        Assert.True(RenderScenes.CountDifferent(culled, (0, 0, 0, 255)) > 2000);
        AssertSameImage(scene, view);
    }

    [SkippableTheory]
    [InlineData(2)]
    public void Frame_OfABaseOutsideItsFractal_IsNoFartherFromTheReference(double distance)
    {
        // A Sierpiński triangle whose maps shrink towards points far from the base mesh. A proxy then lies beside the instances that it
        // replaces.
        var set = new TransformationSet([
            Samples.MoveAndScale(distance, 0, 0, 0.5), Samples.MoveAndScale(distance + 1, 0, 0, 0.5),
            Samples.MoveAndScale(distance, 1, 0, 0.5)]);
        var fractal = new Fractal(new([new Repetition([set], 9)]), RenderScenes.Cube(1));
        var model = new FractalModel(fractal) { SourcePath = "beside.fdo" };
        var scene = RenderScenes.Scene(new Scene { Background = Colour.Black }, (model, Transformation.Identity, Colour.White));
        var view = View.Of(scene, (double)Width / Height);
        var all = ImageComparison.Downsample(RenderScenes.Draw(scene, view, 3 * Width, 3 * Height, EveryInstance), 3);
        var culled = RenderScenes.Draw(scene, view, Width, Height, Culled);
        var missing = ImageComparison.FractionWithoutNeighbour(all, culled);
        var extra = ImageComparison.FractionWithoutNeighbour(culled, all);
        Assert.True(missing < 0.02 && extra < 0.02, Invariant($"{missing:P1} of the pixels are missing, {extra:P1} are too many"));
        AssertNotFartherFromReference(model, Projection.Perspective, $"base {distance} units beside the fractal");
    }

    [SkippableTheory]
    [InlineData(20)]
    [Trait("Category", "Soak")]
    public void Frame_OfABaseOutsideItsFractalInOtherCases_IsNoFartherFromTheReference(double distance) =>
        Frame_OfABaseOutsideItsFractal_IsNoFartherFromTheReference(distance);

    [SkippableFact]
    public void Frame_OfDust_IsNoFartherFromTheReference()
    {
        // Instances that are all smaller than a pixel, and far from each other.
        var random = new Random(7);
        var set = new TransformationSet(
            [.. Enumerable.Range(0, 60).Select(_ => new Transformation(random.Vector(), Vector.Zero, 0.002 * Vector.One))]);
        var model = new FractalModel(new(new([set]), RenderScenes.Cube(1))) { SourcePath = "dust.fdo" };
        AssertNotFartherFromReference(model, Projection.Perspective, "dust");
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Frame_OfAnInfiniteFractal_IsThatOfADeepOne()
    {
        const int Width = 200;
        const int Height = 150;
        // At depth 5 the cubes are below a pixel, even at the corner closest to the camera.
        var infinite = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(null), Transformation.Identity, null));
        var deep = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(8), Transformation.Identity, null));
        var view = new View(ObliqueCamera, Projection.Perspective) { FixedClipPlanes = (1, 20) };
        var deepImage = RenderScenes.Draw(deep, view, Width, Height, Culled);
        ImageComparison.AssertSame(deepImage, RenderScenes.Draw(infinite, view, Width, Height, Culled), "infinite depth");
    }

    [SkippableFact]
    public void Frame_OfAFractalWithoutAHierarchy_IsThatOfEveryInstance()
    {
        // A fractal that grows, and one with a singular map, are drawn in full, with a notice.
        foreach (var transformation in (Transformation[])[Samples.MoveAndScale(1, 0, 0, 1.5), new(Vector.I, Vector.Zero, new(0.5, 0.5, 0))])
        {
            var set = new TransformationSet(ImmutableArray.Create(transformation, Samples.MoveAndScale(0, 1, 0, 0.5)));
            var model = new FractalModel(new(new([new Repetition([set], 3)]), RenderScenes.Cube(1))) { SourcePath = "odd.fdo" };
            AssertSameImage(RenderScenes.Scene(new Scene(), (model, Transformation.Identity, null)));
        }
    }

    private static LoadedScene WhiteSponge(int depth) =>
        RenderScenes.Scene(new Scene { Background = Colour.Black }, (RenderScenes.Menger(depth), Transformation.Identity, Colour.White));

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
            Assert.True(
                difference >= -MaxLossDecibels,
                Invariant($"{description}, {projection}, {samples} samples: {difference:F2} dB; {toAll:F1} dB from every instance"));
        }
    }

    /// <summary>
    /// Measures by how many decibels a frame is closer to the reference than that of every instance, and how far it is from the latter.
    /// </summary>
    private static List<(int Samples, double Difference, double ToAll)> MeasureGains(FractalModel model, Projection projection)
    {
        var scene = RenderScenes.Scene(new Scene { Projection = projection }, (model, Transformation.Identity, null));
        var view = View.Of(scene, (double)Width / Height);
        using var context = new SharedContext();
        using var frame = new FrameRenderer(context);
        using var everyInstance = new SceneRenderer(context, DrawableScene.Prepare(scene, EveryInstance));
        using var culled = new SceneRenderer(context, DrawableScene.Prepare(scene, Culled));
        Assert.Empty(everyInstance.Scene.Notices);
        frame.Draw(everyInstance, view, Supersampling * Width, Supersampling * Height, EveryInstance);
        var reference = ImageComparison.Downsample(frame.Capture(), Supersampling);
        var differences = new List<(int, double, double)>();
        foreach (var samples in (int[])[0, 4])
        {
            frame.Draw(everyInstance, view, Width, Height, EveryInstance with { Samples = samples });
            var all = frame.Capture();
            frame.Draw(culled, view, Width, Height, Culled with { Samples = samples });
            var image = frame.Capture();
            var gain = ImageComparison.PeakSignalToNoiseRatio(image, reference)
                - ImageComparison.PeakSignalToNoiseRatio(all, reference);
            differences.Add((samples, gain, ImageComparison.PeakSignalToNoiseRatio(image, all)));
        }

        return differences;
    }

    private static void AssertSameImage(LoadedScene scene, View? view = null) =>
        AssertSameImages(scene, [view ?? View.Of(scene, (double)Width / Height)]);

    private static void AssertSameImages(LoadedScene scene, View[] views)
    {
        using var context = new SharedContext();
        using var frame = new FrameRenderer(context);
        using var everyInstance = new SceneRenderer(context, DrawableScene.Prepare(scene, EveryInstance));
        using var culled = new SceneRenderer(context, DrawableScene.Prepare(scene, Culled));
        foreach (var (view, samples) in views.SelectMany(static _ => (int[])[0, 4], static (view, samples) => (view, samples)))
        {
            frame.Draw(everyInstance, view, Width, Height, EveryInstance with { Samples = samples });
            var all = frame.Capture();
            frame.Draw(culled, view, Width, Height, Culled with { Samples = samples });
            ImageComparison.AssertSame(all, frame.Capture(), $"{view.Projection}, {samples} samples, {culled.Statistics}");
        }

        context.Resources.ThrowOnError("drawing");
    }

    private static int CountBlue(PixelImage image) =>
        Enumerable.Range(0, image.Width * image.Height).Count(i => image.Pixels[(4 * i) + 2] > 0);
}
