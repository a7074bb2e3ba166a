using FractalEngine.App.Window.Input;
using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Render;
using FractalEngine.Render.Cameras;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;
using FractalEngine.Tests.Fractals;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;
using static System.FormattableString;

namespace FractalEngine.Tests.Render.Views;

/// <summary>
/// Frames from deep inside a fractal, compared with ordinary ones where doubles still suffice, and with each other at different depths.
/// </summary>
[Collection(GlTests.Name)]
public sealed class DeepZoomDrawingTests
{
    private const int Width = 160;
    private const int Height = 120;
    private const int MaxAncestors = 30;

    // Rounded in another frame, some pixels at edges show what is on the other side: up to 8 of 19,200. Were each of them white for black,
    // so many would leave 30 dB; what differs less, in any number, may not take more.
    private const double MaxFlippedShare = 0.001;
    private const double MinFlippedDecibels = 30;

    // Shadows come from maps that fit each view differently, and levels above a zoom's roots hide no sky from what is below.
    private static readonly RenderSettings Settings = new() { Samples = 0, Shadows = false, AmbientOcclusion = false };
    private static readonly RenderSettings Shaded = Settings with { Shadows = true };

    // So low that the whole of what is seen is full of shadows.
    private static readonly DirectionalLight Grazing = new(new(0.9, 0.3, 0.25), Colour.White, 1);
    private static readonly Light[] Directions =
    [
        new AmbientLight(Colour.White, 0.1),
        new DirectionalLight(new(0.3, -0.5, 0.9), Colour.White, 0.9),
        new DirectionalLight(new(0.9, 0.4, 0.2), new(0.4, 0.6, 1), 0.5),
    ];

    [SkippableTheory]
    [InlineData("menger", 0)]
    [InlineData("sierpinski", 3)]
    [InlineData("turned", 0)]
    public void Frame_NotDeep_IsTheOrdinaryOne(string name, int mapIndex)
    {
        foreach (var placement in (Transformation[])[Transformation.Identity, new(new(1, -2, 0.5), new(20, 30, 40), new(2, 2, -2))])
        {
            var map = placement.ToAffineMap();
            // One of the lights has a position.
            var light = new PointLight(map * new Vector(-2, -1.5, -3), new(1, 0.9, 0.8), 1, 30);
            using var stage = new Stage(name, placement, [.. Directions, light]);
            var dive = new FractalDive(stage.Hierarchy, mapIndex, map, Direction(name));
            foreach (var depth in placement.IsIdentity ? (int[])[1, 2, 3, 4, 5] : [2, 5])
            {
                dive.GoToDepth(depth, 0.2);
                var camera = stage.CreateCamera(dive);
                var near = 0.01 * dive.LocateTarget(Vector.Zero).Length();
                const double Far = 100;
                var unit = Math.Exp(dive.Address.LogUnit);
                var ordinary = stage.Draw(new(camera, Projection.Perspective) { FixedClipPlanes = (near * unit, Far) });
                var zoomed = stage.DrawZoomed(camera, (near, Far / unit), dive.Address);
                var ratio = ImageComparison.PeakSignalToNoiseRatio(zoomed, ordinary);
                var (_, share) = RenderScenes.Difference(zoomed, ordinary);
                Assert.True(
                    share < MaxFlippedShare && ratio >= MinFlippedDecibels,
                    Invariant($"{name}, {placement}, depth {dive.Address.Depth}: {ratio:F1} dB, {share:P2} of the pixels"));
                Assert.True(RenderScenes.CountDifferent(zoomed, (0, 0, 0, 255)) > 50, "nothing is visible");
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
            Assert.True(RenderScenes.CountDifferent(first, (0, 0, 0, 255)) > 500, "nothing is visible");
            Assert.Equal(first.Pixels, next.Pixels);
        }
    }

    [SkippableFact]
    public void Frame_OfACameraThatHardlyMoves_DoesNotJitter()
    {
        // At depth 8 doubles still suffice, and the same steps are drawn in the ordinary way for comparison.
        using var stage = new Stage("menger", Transformation.Identity, [RenderScenes.FullLight]);
        var shallow = new FractalDive(stage.Hierarchy, 0, AffineMap.Identity, Direction("menger"));
        var deep = new FractalDive(stage.Hierarchy, 0, AffineMap.Identity, Direction("menger"));
        DrawAtLevel(stage, shallow, 8);
        DrawAtLevel(stage, deep, 1000);
        var settings = Settings with { Samples = 4 };
        var camera = stage.CreateCamera(shallow);
        var distance = deep.LocateTarget(Vector.Zero).Length();
        // The step is a hundredth of a pixel at the distance of the corner.
        var step = 0.01 * distance * 2 * camera.HalfHeightAtUnitDepth / (Height / 2) * camera.LocalAxes.V1;
        var centroids = new List<double>();
        var expected = new List<double>();
        for (var i = 0; i < 12; i++)
        {
            var unit = Math.Exp(shallow.Address.LogUnit);
            var ordinary = new View(camera with { Position = shallow.Address.WorldPosition(AffineMap.Identity) }, Projection.Perspective)
            {
                FixedClipPlanes = (0.01 * distance * unit, 100),
            };
            var zoomed = ordinary with
            {
                Camera = camera with { Position = deep.Address.WorldPosition(AffineMap.Identity) },
                FixedClipPlanes = (0.01 * distance, 100 / unit),
                DeepZoom = Stage.CreateDeepZoom(deep.Address),
            };
            expected.Add(RenderScenes.Centroid(stage.Draw(ordinary, settings, Width / 2, Height / 2)).X);
            centroids.Add(RenderScenes.Centroid(stage.Draw(zoomed, settings, Width / 2, Height / 2)).X);
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
        Light[] lights =
        [
            new PointLight(new(-2, -1.5, -4), Colour.White, 1, 40),
            new SpotLight(new(-5, -4, -3), new(4, 3, 2), 60, new(1, 0.5, 0.2), 1, 80),
        ];
        using var stage = new Stage("menger", Transformation.Identity, lights);
        var dive = new FractalDive(stage.Hierarchy, 0, AffineMap.Identity, Direction("menger"));
        PixelImage? last = null;
        foreach (var depth in (int[])[10, 11, 12, 13, 14, 50, 700, 2000])
        {
            var image = DrawAtLevel(stage, dive, depth);
            Assert.True(RenderScenes.CountDifferent(image, (0, 0, 0, 255)) > 500, "nothing is visible");
            if (last is not null)
            {
                // At depth 10 the light is 59,049 times as far away as the corner: its direction differs by 1e-4.
                var (mean, share) = RenderScenes.Difference(last, image);
                Assert.True(mean < 0.1 && share < 0.001, Invariant($"depth {depth}: mean {mean}, share {share}"));
            }

            last = image;
        }
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Shadows_AtAFixedPoint_AreTheSameAtAnyDepth() => AssertSameShadows("sierpinski", [21, 10_000]);

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Shadows_AMillionLevelsDeep_AreTheSame() => AssertSameShadows("menger", [21, 1000, 1_000_000]);

    [SkippableTheory]
    [InlineData("menger")]
    public void Shadows_InADeepZoom_AreTheTracedOnes(string name)
    {
        // At depth 5 doubles suffice to trace the same in world space.
        using var stage = new Stage(name, Transformation.Identity, [Grazing]);
        var dive = new FractalDive(stage.Hierarchy, 0, AffineMap.Identity, Direction(name));
        var plain = DrawAtLevel(stage, dive, 5);
        var drawn = DrawAtLevel(stage, dive, 5, Shaded);
        var traced = stage.TraceShadows(stage.CreateCamera(dive), plain, Grazing);
        // Most pixels show many parts, of which both see another one: blocks of pixels are compared. Parts of the size of a texel leave
        // most of the difference, as they have no shadow in a map.
        var difference = BlockDifference(drawn, traced);
        var without = BlockDifference(plain, traced);
        Assert.True(difference < 0.5 * without, Invariant($"{name}: {difference:F1} of 255, and {without:F1} without shadows"));
    }

    [SkippableTheory]
    [InlineData("sierpinski")]
    [Trait("Category", "Soak")]
    public void Shadows_InADeepZoomInOtherCases_AreTheTracedOnes(string name) => Shadows_InADeepZoom_AreTheTracedOnes(name);

    [SkippableTheory]
    [InlineData(0.8)]
    [InlineData(0.9)]
    public void Frame_DeepInAFractalThatHardlyShrinks_IsTheOrdinaryOne(double scale)
    {
        // After 50 levels of 0.8, positions in world space have ten digits left. Only ancestors beyond the limit could make a difference.
        var set = new TransformationSet(
            [Samples.MoveAndScale(0, 0, 0, scale), Samples.MoveAndScale(3, 0.5, 4, 0.1), Samples.MoveAndScale(-2, 1, 3, 0.1)]);
        var fractal = new Fractal(new([new Repetition([set], null)]), CullingViews.Cube);
        using var stage = new Stage(fractal, Transformation.Identity, Directions);
        var hierarchy = stage.Hierarchy;
        var camera = new Camera(new(0, 0, -5), Vector.Zero, 60);
        var flyingCamera = new FlyingCamera(
            hierarchy.NodeAt(hierarchy.LevelCount).Box, camera, Projection.Perspective, null, new(0, hierarchy, AffineMap.Identity));
        var controls = new CameraControls(flyingCamera);
        for (var i = 0; i < 400 && flyingCamera.Depth < 50; i++)
        {
            controls.Handle(new WheelTurned(1, KeyModifiers.None), (double)Width / Height);
        }

        Assert.True(flyingCamera.Depth >= 35, Invariant($"only {flyingCamera.Depth} levels"));
        // Forwards, and back to where the camera came from.
        foreach (var yaw in (double[])[0, 180])
        {
            var looking = flyingCamera.Camera with { Rotation = new(0, yaw * Math.PI / 180, 0) };
            var zoomed = flyingCamera.WithDeepZoom(new(looking, Projection.Perspective));
            var unit = Math.Exp(zoomed.DeepZoom!.LogUnit);
            var near = zoomed.FixedClipPlanes!.Value.Near * unit;
            var ordinary = stage.Draw(new(looking, Projection.Perspective) { FixedClipPlanes = (near, 100) });
            ImageComparison.AssertSame(ordinary, stage.Draw(zoomed), Invariant($"depth {flyingCamera.Depth}, rotated by {yaw}°"));
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
            var ordinary = stage.Draw(new(camera, Projection.Perspective) { FixedClipPlanes = (0.01 * unit, 100) });
            ImageComparison.AssertSame(ordinary, stage.DrawZoomed(camera, (0.01, 100 / unit), dive.Address), $"by {kind}");
        }
    }

    [SkippableFact]
    public void FogAndLamps_WithDeepZoom_AreThoseOfTheOrdinaryFrame()
    {
        // Fog as dense as it takes to hide a part of what is near, and lamps that are large beside it: the unit is a ninth of the scene's.
        Light[] lamps =
        [
            new BallLight(new(-1.02, 1.05, 0.75), 0.04, new(1, 0.4, 0.2), 0.1, 2),
            new QuadLight(new(-1.2, 1.3, 1), new(0.2, -0.6, -0.3), 0.5, 0.2, new(0.3, 1, 0.3), 2, 2),
        ];
        using var stage = new Stage("menger", Transformation.Identity, lamps, fog: new(9, new(0, 0, 1)));
        var dive = new FractalDive(stage.Hierarchy, 7, AffineMap.Identity, new(-1, 1, 0.8));
        dive.GoToDepth(2, 0.2);
        var camera = stage.CreateCamera(dive);
        var unit = Math.Exp(dive.Address.LogUnit);
        var ordinary = stage.Draw(new(camera, Projection.Perspective) { FixedClipPlanes = (0.01 * unit, 100) });
        ImageComparison.AssertSame(ordinary, stage.DrawZoomed(camera, (0.01, 100 / unit), dive.Address), "in fog");
    }

    private static void AssertSameShadows(string name, int[] depths)
    {
        using var stage = new Stage(name, Transformation.Identity, [Grazing]);
        var dive = new FractalDive(stage.Hierarchy, 0, AffineMap.Identity, Direction(name));
        var first = DrawAtLevel(stage, dive, 20, Shaded);
        Assert.True(RenderScenes.Difference(first, DrawAtLevel(stage, dive, 20)).Share > 0.05, "there is hardly a shadow");
        foreach (var depth in depths)
        {
            Assert.Equal(first.Pixels, DrawAtLevel(stage, dive, depth, Shaded).Pixels);
        }
    }

    /// <summary>Root of the mean squared difference of the means of blocks, of 255.</summary>
    private static double BlockDifference(PixelImage image1, PixelImage image2)
    {
        const int BlockSize = 10;
        var sum = 0.0;
        for (var top = 0; top < Height; top += BlockSize)
        {
            for (var left = 0; left < Width; left += BlockSize)
            {
                var difference = 0.0;
                for (var i = 0; i < BlockSize * BlockSize; i++)
                {
                    var (x, y) = (left + (i % BlockSize), top + (i / BlockSize));
                    difference += image1[x, y].Red - image2[x, y].Red;
                }

                sum += Math.Pow(difference / (BlockSize * BlockSize), 2);
            }
        }

        return Math.Sqrt(sum * BlockSize * BlockSize / (Width * Height));
    }

    private static PixelImage DrawAtLevel(Stage stage, FractalDive dive, int depth, RenderSettings? settings = null)
    {
        dive.GoToDepth(depth, 0.2);
        // A position that belongs to the frame of the sub-fractal, not to that of one of its children: the same at each level.
        dive.ConvergeTo(1.5 * Direction(stage.Name));
        var camera = stage.CreateCamera(dive);
        return stage.DrawZoomed(camera, (0.02, 1e12), dive.Address, settings);
    }

    private static Vector Direction(string name) => name switch
    {
        "menger" => new Vector(-1, -0.8, -0.9).UnitVector(),
        _ => new Vector(-1, -0.7, -0.9).UnitVector(),
    };

    /// <summary>One fractal on black, with its renderers.</summary>
    private sealed class Stage : IDisposable
    {
        private readonly SharedContext _context;
        private readonly SceneRenderer _renderer;
        private readonly FrameRenderer _frame;
        private readonly LoadedScene _scene;

        public Stage(string name, Transformation placement, Light[] lights, Gradient? gradient = null, Fog? fog = null)
            : this(FractalAddressTests.CreateInfinite(name), placement, lights, gradient, fog) => Name = name;

        public Stage(Fractal fractal, Transformation placement, Light[] lights, Gradient? gradient = null, Fog? fog = null)
        {
            var declaration = new SceneObject("a.fdo", placement)
            {
                Colour = gradient is null ? Colour.White : new(1, 0, 0),
                Gradient = gradient,
            };
            var scene = new LoadedScene(
                new() { Background = Colour.Black, Lights = [.. lights], Fog = fog },
                [new(declaration, new FractalModel(fractal) { SourcePath = "a.fdo" })]);
            _scene = scene;
            var drawable = DrawableScene.Prepare(scene, Settings);
            Hierarchy = drawable.Objects[0].Model.LodHierarchy!;
            _context = new();
            _renderer = new(_context, drawable);
            _frame = new(_context);
            Placement = placement.ToAffineMap();
        }

        public string Name { get; } = "";

        public LodHierarchy Hierarchy { get; }

        private AffineMap Placement { get; }

        /// <summary>Creates a camera at the position of a dive that looks at the fixed point.</summary>
        public Camera CreateCamera(FractalDive dive) =>
            new(dive.Address.WorldPosition(Placement), CameraFraming.LookRotation(dive.LocateTarget(Vector.Zero)), 50);

        public PixelImage Draw(View view, RenderSettings? settings = null, int width = Width, int height = Height)
        {
            _frame.Draw(_renderer, view, width, height, settings ?? Settings);
            _context.Resources.ThrowOnError("drawing");
            return _frame.Capture();
        }

        /// <summary>Draws with the camera's position relative to a sub-fractal.</summary>
        public PixelImage DrawZoomed(
            Camera camera, (double Near, double Far) clipPlanes, FractalAddress address, RenderSettings? settings = null) =>
            Draw(new(camera, Projection.Perspective) { FixedClipPlanes = clipPlanes, DeepZoom = CreateDeepZoom(address) }, settings);

        /// <summary>Darkens the pixels of an image without shadows that no ray to the light reaches.</summary>
        public PixelImage TraceShadows(Camera camera, PixelImage plain, DirectionalLight light)
        {
            var view = new View(camera, Projection.Perspective);
            var caster = new SceneRayCaster(_scene);
            var context = new QueryContext();
            var spread = 0.5 * camera.HalfHeightAtUnitDepth / Height;
            var pixels = plain.Pixels.ToArray();
            for (var i = 0; i < Width * Height; i++)
            {
                var ray = view.RayThrough((i % Width) + 0.5, (i / Width) + 0.5, Width, Height);
                ray = new(ray.Origin, ray.Direction.UnitVector());
                if (caster.TryFindNearest(ray, context, out var hit, out _, 0, double.PositiveInfinity, new(0, spread)))
                {
                    var distance = (hit.Point - ray.Origin).Length();
                    var normal = Vector.Dot(hit.Normal, ray.Direction) < 0 ? hit.Normal : -hit.Normal;
                    var origin = hit.Point + (1e-3 * spread * distance * normal);
                    if (caster.HitsAny(
                        new(origin, -light.Direction.UnitVector()), context, 0, double.PositiveInfinity, new(spread * distance, 1e-3)))
                    {
                        pixels.AsSpan(4 * i, 3).Clear();
                    }
                }
            }

            return new(Width, Height, pixels);
        }

        public void Dispose()
        {
            _frame.Dispose();
            _renderer.Dispose();
            _context.Dispose();
        }

        public static DeepZoom CreateDeepZoom(FractalAddress address) =>
            new(0, address.CollectRoots(MaxAncestors), address.LogUnit);
    }
}
