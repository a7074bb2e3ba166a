using FractalEngine.App.Window;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;
using FractalEngine.Tests.Fractals;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility;
using static System.FormattableString;

namespace FractalEngine.Tests.Render;

/// <summary>
/// Pictures from deep in a fractal, beside those that world space still can tell, and beside each other at different depths.
/// </summary>
[Collection(GlTests.Name)]
public sealed class DeepZoomDrawingTests
{
    private const int Width = 160;
    private const int Height = 120;
    private const int MaxAncestors = 30;

    private static readonly RenderSettings Settings = new() { Samples = 0 };
    private static readonly Light[] Directions =
        [new AmbientLight(Colour.White, 0.1), new DirectionalLight(new(0.3, -0.5, 0.9), Colour.White, 0.9),
        new DirectionalLight(new(0.9, 0.4, 0.2), new(0.4, 0.6, 1), 0.5)];

    [SkippableTheory]
    [InlineData("menger", 0)]
    [InlineData("sierpinski", 3)]
    [InlineData("turned", 0)]
    public void Frame_NotDeep_IsTheOrdinaryOne(string name, int mapIndex)
    {
        foreach (var placement in (Transformation[])[Transformation.Identity, new(new(1, -2, 0.5), new(20, 30, 40), new(2, 2, -2))])
        {
            var map = placement.ToAffineMap();
            // A light with a place, too.
            var light = new PointLight(map * new Vector(-2, -1.5, -3), new(1, 0.9, 0.8), 1, 30);
            using var stage = new Stage(name, placement, [.. Directions, light]);
            var dive = new FractalDive(stage.Hierarchy, mapIndex, map, Direction(name));
            foreach (var depth in placement.IsIdentity ? (int[])[1, 2, 3, 4, 5] : [2, 5])
            {
                dive.GoToDepth(depth, 0.2);
                var camera = stage.CreateCamera(dive);
                var (near, far) = (0.01 * dive.LocateTarget(Vector.Zero).Length(), 100.0);
                var unit = Math.Exp(dive.Address.LogUnit);
                var ordinary = stage.Draw(new(camera, Projection.Perspective) { Clip = (near * unit, far) });
                var zoomed =
                    stage.Draw(
                        new(camera, Projection.Perspective) { Clip = (near, far / unit), DeepZoom = stage.CreateDeepZoom(dive.Address) });
                var ratio = ImageComparison.PeakSignalToNoiseRatio(zoomed, ordinary);
                var (_, share) = RenderScenes.Difference(zoomed, ordinary);
                Assert.True(ratio >= ImageComparison.MinSameDecibels
                    || share < 0.01,
                    Invariant($"{name}, {placement}, depth {dive.Address.Depth}: {ratio:F1} dB, {share:P2} of the pixels"));
                Assert.True(RenderScenes.CountDifferent(zoomed, (0, 0, 0, 255)) > 50, "there is nothing to see");
            }
        }
    }

    [SkippableTheory]
    [InlineData("menger", 0)]
    [InlineData("sierpinski", 0)]
    public void Frame_AtAFixedPoint_IsTheSameAtEachLevel(string name, int mapIndex)
    {
        using var stage = new Stage(name, Transformation.Identity, Directions);
        var dive = new FractalDive(stage.Hierarchy, mapIndex, AffineMap.Identity, Direction(name));
        foreach (var depth in (int[])[20, 100, 1000, 10_000])
        {
            var first = DrawAtLevel(stage, dive, depth);
            var next = DrawAtLevel(stage, dive, depth + 1);
            Assert.Equal(depth + 1, dive.Address.Depth);
            Assert.True(RenderScenes.CountDifferent(first, (0, 0, 0, 255)) > 500, "there is nothing to see");
            Assert.Equal(first.Pixels, next.Pixels);
        }
    }

    [SkippableFact]
    public void Frame_OfACameraThatHardlyMoves_DoesNotJitter()
    {
        // World space still tells places at depth 8; there the same steps are drawn for comparison.
        using var stage = new Stage("menger", Transformation.Identity, [RenderScenes.FullLight]);
        var shallow = new FractalDive(stage.Hierarchy, 0, AffineMap.Identity, Direction("menger"));
        var deep = new FractalDive(stage.Hierarchy, 0, AffineMap.Identity, Direction("menger"));
        DrawAtLevel(stage, shallow, 8);
        DrawAtLevel(stage, deep, 1000);
        var settings = Settings with { Samples = 4 };
        var camera = stage.CreateCamera(shallow);
        var distance = deep.LocateTarget(Vector.Zero).Length();
        // A hundredth of a pixel at the distance of the corner.
        var step = 0.01 * distance * 2 * camera.HalfHeightAtUnitDepth / (Height / 2) * camera.LocalAxes.V1;
        var (centroids, expected) = (new List<double>(), new List<double>());
        for (var i = 0; i < 12; i++)
        {
            var unit = Math.Exp(shallow.Address.LogUnit);
            var view = new View(camera with { Position = shallow.Address.WorldPosition(AffineMap.Identity) }, Projection.Perspective);
            expected.Add(
                RenderScenes.Centroid(stage.Draw(view with { Clip = (0.01 * distance * unit, 100) }, settings, Width / 2, Height / 2)).X);
            centroids.Add(RenderScenes.Centroid(stage.Draw(
                view with { Camera = camera with { Position = deep.Address.WorldPosition(AffineMap.Identity) },
                Clip = (0.01 * distance, 100 / unit), DeepZoom = stage.CreateDeepZoom(deep.Address) }, settings, Width / 2, Height / 2)).X);
            shallow.Move(step);
            deep.Move(step);
        }

        for (var i = 0; i < centroids.Count; i++)
        {
            Assert.True(Math.Abs(centroids[i] - expected[i]) < 0.25, Invariant($"step {i}: {centroids[i]} for {expected[i]}"));
            Assert.True(i == 0 || Math.Abs(centroids[i] - centroids[i - 1]) < 0.5,
                Invariant($"step {i}: from {centroids[Math.Max(0, i - 1)]} to {centroids[i]}"));
        }
    }

    [SkippableFact]
    public void Light_WithAPosition_ShinesTheSameAtAnyDepth()
    {
        using var stage =
            new Stage("menger", Transformation.Identity,
            [new PointLight(new(-2, -1.5, -4), Colour.White, 1, 40),
            new SpotLight(new(-5, -4, -3), new(4, 3, 2), 60, new(1, 0.5, 0.2), 1, 80)]);
        var dive = new FractalDive(stage.Hierarchy, 0, AffineMap.Identity, Direction("menger"));
        PixelImage? last = null;
        foreach (var depth in (int[])[10, 11, 12, 13, 14, 50, 700, 2000])
        {
            var image = DrawAtLevel(stage, dive, depth);
            Assert.True(RenderScenes.CountDifferent(image, (0, 0, 0, 255)) > 500, "there is nothing to see");
            if (last is not null)
            {
                // At depth 10 the light is 59,049 times as far away as the corner: its direction differs by 1e-4.
                var (mean, share) = RenderScenes.Difference(last, image);
                Assert.True(mean < 0.1 && share < 0.001, Invariant($"depth {depth}: mean {mean}, share {share}"));
            }

            last = image;
        }
    }

    [SkippableTheory]
    [InlineData(0.8)]
    [InlineData(0.9)]
    public void Frame_DeepInWhatHardlyShrinks_IsTheOrdinaryOne(double scale)
    {
        // After 50 levels of 0.8 what world space tells has ten digits left: nothing but what is left out further out can make a
        // difference.
        var placement = Transformation.Identity;
        var fractal = new Fractal(
            new(
            [new Repetition(
                [new TransformationSet(
                    [Samples.MoveAndScale(0, 0, 0, scale), Samples.MoveAndScale(3, 0.5, 4, 0.1), Samples.MoveAndScale(-2, 1, 3, 0.1)])],
                    null)]), CullingViews.Cube);
        using var stage = new Stage(fractal, placement, Directions);
        var hierarchy = stage.Hierarchy;
        var camera = new Camera(new(0, 0, -5), Vector.Zero, 60);
        var controls = new CameraControls(hierarchy.NodeAt(hierarchy.LevelCount).Box, camera, Projection.Perspective, null,
            new(0, hierarchy, AffineMap.Identity));
        for (var i = 0; i < 400 && controls.Depth < 50; i++)
        {
            controls.Handle(new WheelTurned(1, KeyModifiers.None), (double)Width / Height);
        }

        Assert.True(controls.Depth >= 35, Invariant($"only {controls.Depth} levels"));
        // About turned: what one comes from.
        foreach (var yaw in (double[])[0, 180])
        {
            var looking = controls.Camera with { Rotation = new(0, yaw * Math.PI / 180, 0) };
            var zoomed = controls.WithDeepZoom(new(looking, Projection.Perspective));
            var unit = Math.Exp(zoomed.DeepZoom!.LogUnit);
            var ordinary = stage.Draw(new(looking, Projection.Perspective) { Clip = (zoomed.Clip!.Value.Near * unit, 100) });
            var ratio = ImageComparison.PeakSignalToNoiseRatio(stage.Draw(zoomed), ordinary);
            Assert.True(ratio >= ImageComparison.MinSameDecibels, Invariant($"depth {controls.Depth}, turned by {yaw}: {ratio:F1} dB"));
        }
    }

    [SkippableFact]
    public void Gradient_WithDeepZoom_IsThatOfTheOrdinaryFrame()
    {
        foreach (var kind in (GradientKind[])[GradientKind.Level, GradientKind.Path])
        {
            using var stage = new Stage("menger", Transformation.Identity, [RenderScenes.FullLight], new(kind, new(0, 0, 1)));
            var dive = new FractalDive(stage.Hierarchy, 7, AffineMap.Identity, new(-1, 1, 0.8));
            dive.GoToDepth(2, 0.2);
            var camera = stage.CreateCamera(dive);
            var unit = Math.Exp(dive.Address.LogUnit);
            var ordinary = stage.Draw(new(camera, Projection.Perspective) { Clip = (0.01 * unit, 100) });
            var zoomed =
                stage.Draw(
                    new(camera, Projection.Perspective) { Clip = (0.01, 100 / unit), DeepZoom = stage.CreateDeepZoom(dive.Address) });
            var ratio = ImageComparison.PeakSignalToNoiseRatio(zoomed, ordinary);
            Assert.True(ratio >= ImageComparison.MinSameDecibels, Invariant($"by {kind}: {ratio:F1} dB"));
        }
    }

    private static PixelImage DrawAtLevel(Stage stage, FractalDive dive, int depth)
    {
        dive.GoToDepth(depth, 0.2);
        // A place that is in no copy's reach and within the sub-fractal's own: the same at each level.
        dive.ConvergeTo(1.5 * Direction(stage.Name));
        var camera = stage.CreateCamera(dive);
        return stage.Draw(new(camera, Projection.Perspective) { Clip = (0.02, 1e12), DeepZoom = stage.CreateDeepZoom(dive.Address) });
    }

    private static Vector Direction(string name) => name switch
    {
        "menger" => new Vector(-1, -0.8, -0.9).UnitVector(),
        _ => new Vector(-1, -0.7, -0.9).UnitVector(),
    };

    /// <summary>One fractal on black, and what draws it.</summary>
    private sealed class Stage : IDisposable
    {
        private readonly OffscreenContext _context;
        private readonly SceneRenderer _renderer;
        private readonly FrameRenderer _frame;

        public Stage(string name, Transformation placement, Light[] lights, Gradient? gradient = null)
            : this(FractalAddressTests.CreateInfinite(name), placement, lights, gradient) => Name = name;

        public Stage(Fractal fractal, Transformation placement, Light[] lights, Gradient? gradient = null)
        {
            var scene = new LoadedScene(
                new() { Background = Colour.Black, Lights = [.. lights] },
                [new(new SceneObject("a.fdo", placement) { Colour = gradient is null ? Colour.White : new(1, 0, 0), Gradient = gradient },
                new FractalModel(fractal) { SourcePath = "a.fdo" })]);
            var drawable = DrawableScene.Prepare(scene, Settings);
            Hierarchy = drawable.Objects[0].Model.LodHierarchy!;
            _context = GlTests.OpenContext();
            _renderer = new(_context, drawable);
            _frame = new(_context);
            Placement = placement.ToAffineMap();
        }

        public string Name { get; } = "";

        public LodHierarchy Hierarchy { get; }

        private AffineMap Placement { get; }

        /// <summary>Looks at the fixed point from where the dive is.</summary>
        public Camera CreateCamera(FractalDive dive) =>
            new(dive.Address.WorldPosition(Placement), CameraFraming.LookRotation(dive.LocateTarget(Vector.Zero)), 50);

        public PixelImage Draw(View view, RenderSettings? settings = null, int width = Width, int height = Height)
        {
            _frame.Draw(_renderer, view, width, height, settings ?? Settings);
            _context.Resources.ThrowOnError("drawing");
            return _frame.Capture();
        }

        public void Dispose()
        {
            _frame.Dispose();
            _renderer.Dispose();
            _context.Dispose();
        }

        public DeepZoom CreateDeepZoom(FractalAddress address) => new(0, address.CollectRoots(MaxAncestors), address.LogUnit);
    }
}
