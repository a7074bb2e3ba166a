using System.Collections.Immutable;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Fractals;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Tracing;

/// <summary>Traced images whose radiance is known in closed form.</summary>
public class PathTracerTests
{
    private static readonly Light WhiteSky = new AmbientLight(Colour.White, 1);

    [Fact]
    public void AddSample_OfAWhiteSolidUnderAWhiteSky_ShowsNothing()
    {
        // The furnace: what reflects all light looks like the surroundings. A convex solid reflects each path once.
        var tracer = Trace(Scene([WhiteSky], Matt(Shapes.Sphere(3), Colour.White)), Camera.Default, 16, 64);

        for (var y = 0; y < 16; y++)
        {
            for (var x = 0; x < 16; x++)
            {
                Assert.Equal(1, tracer.RadianceAt(x, y).X, 0.01);
            }
        }
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void AddSample_OfADeepZoom_ShowsWhatTheWorldShows(bool hasFog)
    {
        const int size = 24;
        var fractal = AssetFractals.Load("menger", 6);
        var dive = new FractalDive(LodHierarchy.Build(fractal), 7, AffineMap.Identity, new(-1, 1, 0.8));
        dive.GoToDepth(2, 0.2);
        var unit = Math.Exp(dive.Address.LogUnit);
        var light = new PointLight(new(-3, 4, 2), Colour.White, 1, 30);
        var lamp = new BallLight(new(3, 4, -2), 1, Colour.White, 0.3, 30);
        var scene = LoadedScene.Of(Scene([WhiteSky, light, lamp], new SceneObject(fractal) { Colour = Colour.White })
            // As dense as it takes to hide a part of what is near.
            with
        { Fog = hasFog ? new(1 / unit, new(0, 0, 1)) : null });
        var camera = new Camera(
            dive.Address.WorldPosition(AffineMap.Identity), CameraFraming.LookRotation(dive.LocateTarget(Vector.Zero)), 50);
        var world = new View(camera, Projection.Perspective) { FixedClipPlanes = (0.001 * unit, 100) };
        var zoomed = world with
        {
            FixedClipPlanes = (0.001, 100 / unit),
            DeepZoom = new(0, dive.Address.CollectRoots(1000), dive.Address.LogUnit),
        };

        // From one to the other, what was prepared is shared.
        var worldTracer = new PathTracer(scene, world, size, size);
        var zoomTracer = worldTracer.WithView(zoomed, size, size);
        for (var i = 0; i < 8; i++)
        {
            worldTracer.AddSample();
            zoomTracer.AddSample();
        }

        // The same paths, but for those that rounding sends past an edge.
        var same = 0;
        for (var i = 0; i < size * size; i++)
        {
            same += (worldTracer.RadianceAt(i % size, i / size) - zoomTracer.RadianceAt(i % size, i / size)).Length() < 0.01 ? 1 : 0;
        }

        Assert.InRange(same, 0.9 * size * size, size * size);
        Assert.InRange(Mean(zoomTracer), 0.05, 3);
    }

    [Fact]
    public void AddSample_OfAWhiteSpongeUnderAWhiteSky_LosesLessThanItsLastBounces()
    {
        var fractal = AssetFractals.Load("menger", 2);
        var camera = new Camera(new(0.1, 0.2, -4), Vector.Zero, 30);
        var tracer = Trace(Scene([WhiteSky], new SceneObject(fractal) { Colour = Colour.White }), camera, 12, 128);

        // Paths that would go on from a ninth surface are dark: few, in holes.
        Assert.InRange(Mean(tracer), 0.97, 1.003);
    }

    [Theory]
    [InlineData(0.5, 0.5)]
    [InlineData(0.25, 0.8)]
    public void AddSample_InAClosedBoxThatGlows_GivesTheSumOfAllReflections(double emission, double albedo)
    {
        // Each surface sends e + a·L to every other: L = e/(1 − a), less the paths of more than eight reflections.
        var box = Matt(Shapes.Box(new(-Vector.One, Vector.One)), FromLinear(albedo), new Colour(emission, emission, emission));
        var tracer = Trace(Scene([], box), new(new(0.1, 0.2, -0.3), Vector.Zero, 80), 8, 256);

        var expected = emission * (1 - Math.Pow(albedo, PathTracer.MaxBounces + 1)) / (1 - albedo);
        Assert.Equal(expected, Mean(tracer), 0.01 * expected);
    }

    [Fact]
    public void AddSample_OfAFloorBesideAHighBlackWall_SeesHalfTheSkyAndMore()
    {
        // At a distance d from a wall of the height h and without ends, the part (1 − d/√(d² + h²))/2 of the sky is hidden.
        var floor = Matt(Quad(new(-500, 0, -500), new(-500, 0, 500), new(500, 0, 500), new(500, 0, -500)), FromLinear(0.5));
        var wall = Matt(Quad(new(1, 0, -500), new(1, 3, -500), new(1, 3, 500), new(1, 0, 500)), Colour.Black);
        var camera = new Camera(new(0, 0.001, 0), Vector.Zero, 2);
        var tracer = Trace(Scene([WhiteSky], floor, wall), LookingDown(camera), 4, 2048);

        var expected = 0.5 * (1 - (0.5 * (1 - (1 / Math.Sqrt(10)))));
        Assert.Equal(expected, Mean(tracer), 0.01 * expected);
    }

    [Fact]
    public void AddSample_UnderParallelLight_IsDarkInTheShadowAndLitBeside()
    {
        var floor = Matt(Quad(new(-50, 0, -50), new(-50, 0, 50), new(50, 0, 50), new(50, 0, -50)), FromLinear(0.5));
        var lid = Matt(Quad(new(-1, 5, -1), new(-1, 5, 1), new(1, 5, 1), new(1, 5, -1)), Colour.Black);
        var sun = new DirectionalLight(new(0, -1, 0), Colour.White, 0.8);

        var shadow = Trace(Scene([sun], floor, lid), LookingDown(new(new(0, 1, 0), Vector.Zero, 10)), 4, 16);
        var beside = Trace(Scene([sun], floor, lid), LookingDown(new(new(3, 1, 0), Vector.Zero, 10)), 4, 16);

        Assert.Equal(0, Mean(shadow), 1e-12);
        // A surface of the albedo a under light of the intensity i shows a·i, as in drawn frames.
        Assert.Equal(0.4, Mean(beside), 1e-6);
    }

    [Fact]
    public void AddSample_OfGlassBeforeTheSky_LetsItsShareThrough()
    {
        var glass = Matt(Quad(new(-5, -5, 0), new(-5, 5, 0), new(5, 5, 0), new(5, -5, 0)), Colour.Black, opacity: 0.25);
        var scene = Scene([new AmbientLight(Colour.White, 0)], glass) with { Background = Colour.White };
        var tracer = Trace(scene, Camera.Default, 8, 256);

        Assert.Equal(0.75, Mean(tracer), 0.01);
    }

    [Fact]
    public void AddSample_OfFogBehindGlass_IsThatOfTheWholeWay()
    {
        var tracer = Trace(FogBehindGlass(), new(Vector.Zero, Vector.Zero, 1), 8, 256);

        // A quarter of 16,384 paths end at the glass.
        Assert.Equal(LightOfFogBehindGlass, Mean(tracer), 0.005);
    }

    [Fact]
    public void AddSample_OfFogBehindTwoPanes_IsThatOfTheWholeWay()
    {
        SceneObject Pane(double z, double opacity) =>
            Matt(Quad(new(-50, -50, z), new(-50, 50, z), new(50, 50, z), new(50, -50, z)), Colour.Black, opacity: opacity);
        var scene = Scene([], Pane(1, 1e-9), Pane(3, 1e-9), Pane(5, 1)) with { Fog = new(0.2, Colour.White), Background = Colour.White };
        var tracer = Trace(scene, new(Vector.Zero, Vector.Zero, 1), 8, 4);

        Assert.Equal(1 - Math.Exp(-0.2 * 5), Mean(tracer), 1e-4);
    }

    [Fact]
    public void TryIntersect_OfAStretchedSphere_HasTheNormalsOfAnEllipsoid()
    {
        var size = new Vector(3, 1, 0.5);
        var sphere = new SceneObject(Shapes.Sphere(5)) { Placement = Transformation.Identity with { Scale = size } };
        var scene = new TracedScene(LoadedScene.Of(Scene([WhiteSky], sphere)), new() { CreaseAngle = 180 });
        Seeded.Run(100, random =>
        {
            var origin = 5 * random.Vector().UnitVector();
            Assert.True(scene.TryIntersect(new(origin, -origin.UnitVector()), default, 0, 10, new(), out var surface));
            var (x, y, z) = surface.Position;
            var expected = new Vector(x / (size.X * size.X), y / (size.Y * size.Y), z / (size.Z * size.Z)).UnitVector();
            Assert.InRange((surface.Normal - expected).Length(), 0, 0.05);
        });
    }

    [Theory]
    [InlineData(4.5, 0.75)]
    [InlineData(5.5, 0)]
    [InlineData(0.5, 1)]
    public void Transmittance_OfGlassAndALid_IsOfWhatStandsBeforeTheLight(double distance, double expected)
    {
        var pane = Matt(Quad(new(-5, 1, -5), new(-5, 1, 5), new(5, 1, 5), new(5, 1, -5)), Colour.Black, opacity: 0.25);
        var lid = Matt(Quad(new(-5, 5, -5), new(-5, 5, 5), new(5, 5, 5), new(5, 5, -5)), Colour.Black);
        var scene = new TracedScene(LoadedScene.Of(Scene([WhiteSky], pane, lid)), new());

        Assert.Equal(expected, scene.Transmittance(new(new(0.3, 0, 0.2), Vector.J), default, distance, new()), 1e-12);
    }

    [Theory]
    [InlineData(20, false)]
    [InlineData(60, true)]
    public void Reflected_InASmallerUnit_IsDarkBehindWhatStandsBeforeTheLight(double height, bool isLit)
    {
        // The light is 4 units of the world above the floor, which are 40 of the traced scene's.
        var lid = Matt(Quad(new(-5, height, -5), new(-5, height, 5), new(5, height, 5), new(5, height, -5)), Colour.Black);
        var loaded = LoadedScene.Of(Scene([new PointLight(new(0, 4, 0), Colour.White, 1, 40)], lid));
        var surface = new TracedSurface(Vector.Zero, Vector.J, Vector.J, Vector.One, null, Vector.Zero, 1);
        var samples = new SampleSequence(0, 0, 0);

        var light = new TracedLights(loaded).Reflected(
            in surface, Vector.Zero, new(0, 1e-6, 0), Vector.J, 0, new(loaded, new()), 0.1, ref samples, new());

        Assert.Equal(isLit, light.X > 0.1);
        Assert.Equal(isLit, light != Vector.Zero);
    }

    /// <summary>The light of white fog before a black pane at 2 units, and, through it, before a black wall at 5.</summary>
    internal static double LightOfFogBehindGlass => (0.25 * (1 - Math.Exp(-0.2 * 2))) + (0.75 * (1 - Math.Exp(-0.2 * 5)));

    /// <summary>A black wall in white fog behind a black pane that lets three quarters through, seen from the origin along z.</summary>
    internal static Scene FogBehindGlass() => Scene(
        [], Matt(Quad(new(-5, -5, 2), new(-5, 5, 2), new(5, 5, 2), new(5, -5, 2)), Colour.Black, opacity: 0.25),
        Matt(Quad(new(-50, -50, 5), new(-50, 50, 5), new(50, 50, 5), new(50, -50, 5)), Colour.Black)) with
    {
        Fog = new(0.2, Colour.White),
        Background = Colour.White,
    };

    [Theory]
    [InlineData(4, 6, 1, 0)]
    [InlineData(5.5, 100, 0, 0)]
    [InlineData(1, 4.5, 0, 0)]
    [InlineData(4.99, 5.01, 1, 9)]
    public void AddSample_BetweenClipPlanes_ShowsDepthsAndNotDistances(double near, double far, double expected, double aperture)
    {
        // A wall at the depth 5. Towards the corners of the frame it is at up to 8.7 units from the eye.
        var wall = Matt(Quad(new(-50, -50, 0), new(-50, 50, 0), new(50, 50, 0), new(50, -50, 0)), Colour.White);
        var scene = Scene([WhiteSky], wall) with { Background = Colour.Black, Clip = (near, far) };

        var tracer = Trace(scene, new(new(0, 0, -5), Vector.Zero, 90) { Aperture = aperture, FocusDepth = 2 }, 8, 4);

        Assert.Equal(expected, tracer.RadianceAt(0, 0).X, 1e-9);
        Assert.Equal(expected, tracer.RadianceAt(4, 4).X, 1e-9);
    }

    [Fact]
    public void AddSample_WithTwoSeeds_AgreesInTheMeanAndDiffersInTheNoise()
    {
        var sun = new DirectionalLight(new(0.3, -1, 0.5), Colour.White, 0.5);
        var scene = Scene([WhiteSky, sun], new SceneObject(AssetFractals.Load("menger", 2)));
        var first = Trace(scene, Camera.Default, 24, 64, seed: 1);
        var second = Trace(scene, Camera.Default, 24, 64, seed: 2);

        Assert.Equal(Mean(first), Mean(second), 0.005);
        Assert.NotEqual(first.RadianceAt(12, 12), second.RadianceAt(12, 12));
    }

    [Fact]
    public void AddSample_OnAnyNumberOfThreads_GivesTheSameBits()
    {
        var scene = Scene([WhiteSky], new SceneObject(AssetFractals.Load("tetrahedron", 4)), Matt(Shapes.Sphere(1), Colour.White));

        var one = Trace(scene, Camera.Default, 20, 4, threads: 1).ToImage();
        var many = Trace(scene, Camera.Default, 20, 4, threads: 5).ToImage();

        Assert.Equal(one.Pixels, many.Pixels);
    }

    [Fact]
    public void AddSample_OfAnInfiniteFractal_Ends()
    {
        var fractal = AssetFractals.Load("menger", null);
        var tracer = Trace(Scene([WhiteSky], new SceneObject(fractal)), new(new(0.2, 0.1, -3), Vector.Zero, 40), 16, 2);

        Assert.InRange(Mean(tracer), 0.01, 1);
    }

    [Fact]
    public void AddSample_ManyTimes_AddsTheLastOneAsExactlyAsTheFirst()
    {
        // Away from all surfaces, each sample is the background. Single precision would lose a ten thousandth of their sum.
        var scene = Scene([WhiteSky], Matt(Shapes.Sphere(1), Colour.White)) with { Background = FromLinear(0.1) };
        var camera = new Camera(new(0, 0, -5), new(0, Math.PI, 0), 40);

        Assert.Equal(0.1, Trace(scene, camera, 1, 100_000, threads: 1).RadianceAt(0, 0).X, 1e-9);
    }

    [Fact]
    public void AddSample_ThatIsCancelled_ThrowsAndKeepsWhatIsThere()
    {
        var tracer = Trace(Scene([WhiteSky], Matt(Shapes.Sphere(1), Colour.White)), Camera.Default, 8, 2);
        using var cancelled = new CancellationTokenSource();
        cancelled.Cancel();

        Assert.Throws<OperationCanceledException>(() => tracer.AddSample(cancellation: cancelled.Token));

        Assert.Equal(2, tracer.SampleCount);
        Assert.Equal(1, Mean(tracer), 0.05);
    }

    [Fact]
    public void WithView_OfATracerWithSamples_GivesTheImageOfANewOne()
    {
        var scene = Scene([WhiteSky], new SceneObject(AssetFractals.Load("menger", 2)));
        var camera = new Camera(new(0.5, 0.3, -3), Vector.Zero, 40);

        var other = Trace(scene, Camera.Default, 8, 2).WithView(new(camera, Projection.Perspective), 20, 20);
        other.AddSample();

        Assert.Equal(Trace(scene, camera, 20, 1).ToImage().Pixels, other.ToImage().Pixels);
    }

    [Fact]
    public void WithScene_OfMovedAndOtherObjects_GivesTheImageOfANewTracer()
    {
        var sponge = AssetFractals.Load("menger", 2);
        var ball = Shapes.Sphere(2);
        var first = Scene([WhiteSky], new SceneObject(sponge), Matt(ball, Colour.White));
        var camera = new Camera(new(0.5, 0.3, -5), Vector.Zero, 40);
        var second = Scene(
            [WhiteSky, new DirectionalLight(new(0, -1, 1), Colour.White, 0.5)],
            new SceneObject(sponge) { Placement = Transformation.Identity with { Position = new(0.5, 0, 1) }, Colour = new(1, 0.5, 0) },
            Matt(Shapes.Sphere(1), Colour.White)) with
        { Camera = camera, Background = new(0.2, 0.3, 0.4) };

        var loaded = LoadedScene.Of(second);
        var other = Trace(first, Camera.Default, 8, 2).WithScene(loaded, View.Of(loaded, 1), 20, 20);
        other.AddSample();

        Assert.Equal(Trace(second, camera, 20, 1).ToImage().Pixels, other.ToImage().Pixels);
    }

    private static PathTracer Trace(Scene scene, Camera camera, int size, int samples, int seed = 0, int? threads = null)
    {
        var loaded = LoadedScene.Of(scene with { Camera = camera, Background = scene.Background ?? Colour.White });
        var tracer = new PathTracer(loaded, View.Of(loaded, 1), size, size, seed: seed);
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample(threads);
        }

        return tracer;
    }

    private static double Mean(PathTracer tracer)
    {
        var sum = 0.0;
        for (var y = 0; y < tracer.Height; y++)
        {
            for (var x = 0; x < tracer.Width; x++)
            {
                sum += tracer.RadianceAt(x, y).Y;
            }
        }

        return sum / (tracer.Width * tracer.Height);
    }

    private static Scene Scene(ImmutableArray<Light> lights, params ImmutableArray<SceneObject> objects) => new()
    {
        Lights = lights.IsEmpty ? [new AmbientLight(Colour.Black, 0)] : lights,
        Objects = objects,
    };

    private static SceneObject Matt(Mesh mesh, Colour colour, Colour emission = default, double opacity = 1)
    {
        var groups = mesh.WithGroups([new(0, mesh.FaceCount, "", "", "matt", 0)], []);
        var material = new Material("matt") { Diffuse = colour, Emission = emission, Opacity = opacity };
        return new(new MeshModel(groups) { Materials = ImmutableDictionary<string, Material>.Empty.Add("matt", material) });
    }

    private static Mesh Quad(Vector a, Vector b, Vector c, Vector d) =>
        new([a.X, a.Y, a.Z, b.X, b.Y, b.Z, c.X, c.Y, c.Z, d.X, d.Y, d.Z], [0, 1, 2, 0, 2, 3]);

    private static Camera LookingDown(Camera camera) => camera with { Rotation = new(-0.5 * Math.PI, 0, 0) };

    private static Colour FromLinear(double linear)
    {
        var component = (1.055 * Math.Pow(linear, 1 / 2.4)) - 0.055;
        return new(component, component, component);
    }
}
