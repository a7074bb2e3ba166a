using System.Collections.Immutable;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Tracing;

/// <summary>Light of quads and balls in traced images, against closed forms and integrals over their surfaces.</summary>
public class TracedLampTests
{
    // So far that it weakens nothing.
    private const double Range = 1e4;

    private static readonly View Above = new(
        new(new(0.3, 1, 0.2), new(-0.5 * Math.PI, 0, 0), 60), Projection.Orthographic)
    { OrthographicHeight = 1e-3 };

    [Theory]
    [InlineData(0.5, 0.5, 1)]
    [InlineData(3, 0.2, 0.4)]
    [InlineData(20, 20, 0.01)]
    public void Irradiance_OfAQuadAcross_IsThatOfTheViewFactor(double halfWidth, double halfHeight, double distance)
    {
        // Of a parallel rectangle, from below its middle: four corners.
        var (a, b) = (halfWidth / distance, halfHeight / distance);
        var factor = 4 / (2 * Math.PI) * ((a / Math.Sqrt(1 + (a * a)) * Math.Atan(b / Math.Sqrt(1 + (a * a))))
            + (b / Math.Sqrt(1 + (b * b)) * Math.Atan(a / Math.Sqrt(1 + (b * b)))));
        AssertIrradiance(Lamp(new(0, distance, 0), -Vector.J, halfWidth, halfHeight), Vector.J, factor);
    }

    [Theory]
    [InlineData(1, 2, 0.5)]
    [InlineData(0.1, 3, 2)]
    public void Irradiance_OfAQuadAtARightAngle_IsThatOfTheViewFactor(double halfWidth, double height, double distance)
    {
        // Of a rectangle that stands on the plane of the face, before the face and to both sides.
        var (x, y) = (height / halfWidth, distance / halfWidth);
        var root = Math.Sqrt((x * x) + (y * y));
        var factor = (Math.Atan(1 / y) - (y / root * Math.Atan(1 / root))) / Math.PI;
        AssertIrradiance(Lamp(new(0, 0.5 * height, distance), -Vector.K, halfWidth, 0.5 * height), Vector.J, factor);
        // What is below the horizon adds nothing.
        AssertIrradiance(Lamp(new(0, 0, distance), -Vector.K, halfWidth, height), Vector.J, factor);
    }

    [Theory]
    [InlineData(0, 0.9)]
    [InlineData(50, 0.5)]
    [InlineData(60, 0.01)]
    [InlineData(88, 1e-5)]
    public void Irradiance_OfABallAboveTheHorizon_IsThatOfItsDisc(double angle, double radius)
    {
        var (sine, cosine) = Math.SinCos(angle * Math.PI / 180);
        AssertIrradiance(Lamp(2 * new Vector(sine, cosine, 0), 2 * radius), Vector.J, radius * radius * cosine);
    }

    [Fact]
    public void Irradiance_OfLampsInPartBelowTheHorizon_IsThatOfTheRest() => Seeded.Run(12, random =>
    {
        var lamp = RandomLamp(random);
        var normal = Vector.Cross(lamp.Position.UnitVector(), random.Direction()).UnitVector();
        normal = (normal + (random.Between(-0.2, 0.2) * lamp.Position.UnitVector())).UnitVector();
        AssertIrradiance(lamp, normal, LampIntegral.Irradiance(lamp, Vector.Zero, normal) / LampIntegral.RadianceOf(lamp));
    });

    [Fact]
    public void Density_OfEachLamp_IntegratesToOneOverWhatRaysMeet() => Seeded.Run(12, random =>
    {
        var lamp = TracedOf(RandomLamp(random));
        var axes = FacetAlbedo.AxesAround(random.Direction());
        var (sum, squares, met) = (0.0, 0.0, 0);
        const int count = 40000;
        for (var i = 0; i < count; i++)
        {
            var direction = Reflection.SampleCone(in axes, -1, (random.NextDouble(), random.NextDouble()));
            var distance = lamp.DistanceAlong(new(Vector.Zero, direction));
            var found = double.IsFinite(distance) ? 4 * Math.PI * lamp.Density(Vector.Zero, direction, distance) : 0;
            (sum, squares, met) = (sum + found, squares + (found * found), met + (found > 0 ? 1 : 0));
        }

        var error = Math.Sqrt(((squares / count) - (sum / count * (sum / count))) / count);
        Assert.InRange(sum / count, 1 - (4 * error), 1 + (4 * error));
        Assert.InRange(met, 5, count);
    });

    [Fact]
    public void TrySample_OfEachLamp_LeadsToWhereRaysMeetIt() => Seeded.Run(50, random =>
    {
        var lamp = TracedOf(RandomLamp(random, random.Between(-3, 0)));
        var samples = new SampleSequence(0, 0, random.Next());
        for (var i = 0; i < 100; i++)
        {
            Assert.True(lamp.TrySample(Vector.Zero, samples.Next(), out var toLight, out var distance));
            // The rim may be missed.
            var inwards = lamp.Emitter.Position!.Value - (distance * toLight);
            var found = lamp.DistanceAlong(new(Vector.Zero, (toLight + (1e-9 * inwards)).UnitVector()));
            Assert.InRange(found, distance * (1 - 1e-3), distance * (1 + 1e-3));
        }
    });

    [Theory]
    [InlineData(1)]
    [InlineData(30)]
    [InlineData(80)]
    [InlineData(101)]
    public void SmallLamps_AreThePointLightOfTheSameNumbers(double distance)
    {
        var point = new PointLight(new(0.3, distance, 0.2), new(1, 0.5, 0.2), 0.7, 100);
        var expected = point.ToEmitter()!.Incoming(Vector.Zero, out var toLight, out _).X * toLight.Y;
        foreach (var light in (PointLight[])
        [
            new BallLight(point.Position, 2e-4, point.Colour, 0.7, 100),
            new QuadLight(point.Position, -toLight, 3e-4, 1e-3, point.Colour, 0.7, 100, 20),
        ])
        {
            var (mean, _) = Sampled(light, Surface(Vector.J), Vector.J, 64);
            Assert.Equal(expected, mean.X, 1e-5 * expected);
        }
    }

    [Theory]
    [InlineData(0.3, 1)]
    [InlineData(0.5, 0)]
    [InlineData(1, 0.5)]
    public void AddSample_OfAGlossyFloor_HasTheMeanOfTheIntegralOverTheLamp(double roughness, double metalness)
    {
        // Of an eye that looks along the floor, paths find the reflected lamps as often as samples do.
        var material = new Material("m") { Diffuse = new(0.9, 0.7, 0.5), Roughness = roughness, Metalness = metalness };
        var eye = new Vector(-4, 3, -0.5);
        var surface = Surface(Vector.J) with { Colour = material.Diffuse.ToLinearVector(), Gloss = Gloss.Of(material) };
        foreach (var lamp in (PointLight[])
            [Lamp(new(3, 2, 0.2), new(-3, -2, 0), 1, 0.8), Lamp(new(4, 1, 0.4), 1.5), Lamp(new(3, 2, 1), 0.02)])
        {
            var expected = LampIntegral.RadianceOf(lamp) / Math.PI * LampIntegral.Over(
                lamp, Vector.Zero, toLight => Reflection.Evaluate(in surface, eye.UnitVector(), toLight), 400);
            var view = new View(
                new(eye, CameraFraming.LookRotation(-eye), 1e-3), Projection.Perspective);
            var (mean, error) = Mean(Scene(lamp, (Floor(), material)), view);
            var tolerance = (3.5 * error) + (1e-3 * expected.Y);
            Assert.InRange(mean.Y, expected.Y - tolerance, expected.Y + tolerance);
            Assert.InRange(error, 0, 0.03 * expected.Y);
        }
    }

    [Theory]
    [InlineData(1, true)]
    [InlineData(-1, false)]
    public void AddSample_OfAMirror_ShowsTheFrontOfTheLamp(double facing, bool isSeen)
    {
        var mirror = new Material("m") { Diffuse = Colour.White, Roughness = 0, Metalness = 1 };
        var lamp = new QuadLight(new(0, 3, 0), new(0, -facing, 0), 3, 3, Colour.White, 1, 100);
        var view = new View(new(new(0, 1, 0), new(-0.5 * Math.PI, 0, 0), 1), Projection.Perspective);
        var (mean, _) = Mean(Scene(lamp, (Floor(), mirror)), view);
        var seen = Trace(Scene(lamp, (Floor(), mirror)), Upwards(view), 4);
        var radiance = isSeen ? LampIntegral.RadianceOf(lamp) : 0;
        Assert.Equal(radiance, mean.Y, 0.02 * radiance);
        Assert.Equal(isSeen ? radiance : 0.1, seen.RadianceAt(0, 0).Y, 1e-3 * (1 + radiance));
    }

    [Theory]
    [InlineData(2, 0.6)]
    [InlineData(4, 1)]
    public void AddSample_BehindALid_IsDarkAndBehindPanesDimmed(double height, double part)
    {
        var lamp = Lamp(new(0.3, 3, 0.2), 0.1);
        var pane = new Material("pane") { Diffuse = Colour.Black, Opacity = 0.4 };
        var lid = new Material("lid") { Diffuse = Colour.Black };
        var floor = new Material("m") { Diffuse = Colour.White };
        Vector Light(Material above) => Mean(
            Scene(lamp, (Floor(), floor), (Floor(height), above)), Above).Mean;
        var free = LampIntegral.Irradiance(lamp, new(0.3, 0, 0.2), Vector.J);
        Assert.Equal(part * free, Light(pane).Y, 0.03 * free);
        Assert.Equal(part == 1 ? free : 0, Light(lid).Y, 0.01 * free);
    }

    [Fact]
    public void AddSample_BelowABlockOfGlass_IsAsBrightAsUnderAPointLight()
    {
        var glass = new Material("glass") { RefractiveIndex = 1.5, Opacity = 0 };
        var floor = new Material("m") { Diffuse = Colour.White };
        var block = Shapes.Box(new(new(-9, 1.5, -9), new(9, 2, 9)));
        var lamp = Lamp(new(0.3, 3, 0.2), 0.1);
        var point = new PointLight(lamp.Position, Colour.White, lamp.Intensity, lamp.Range);
        var (mean, error) = Mean(Scene(lamp, (Floor(), floor), (block, glass)), Above);
        var (expected, _) = Mean(Scene(point, (Floor(), floor), (block, glass)), Above);
        Assert.InRange(mean.Y, (0.97 * expected.Y) - (3 * error), (1.03 * expected.Y) + (3 * error));
    }

    /// <summary>Paths that glass bends don't meet a lamp where its samples are, so that these count whole.</summary>
    [Fact]
    public void AddSample_OfAWideLampBehindGlassThatHardlyBends_IsAsBrightAsWithoutIt()
    {
        var glass = new Material("glass") { RefractiveIndex = 1.001, Opacity = 0 };
        var floor = new Material("m") { Diffuse = Colour.White };
        var lamp = new QuadLight(new(0.3, 2, 0.2), -Vector.J, 4, 4, Colour.White, 1, 100);
        var (mean, error) = Mean(Scene(lamp, (Floor(), floor), (Shapes.Box(new(new(-9, 1, -9), new(9, 1.5, 9))), glass)), Above);
        var expected = LampIntegral.Irradiance(lamp, new(0.3, 0, 0.2), Vector.J);
        Assert.InRange(mean.Y, (0.97 * expected) - (3 * error), (1.03 * expected) + (3 * error));
    }

    [Fact]
    public void AddSample_OfALampBehindAnother_ShowsTheNearerOne()
    {
        var (near, far) = (Lamp(new(0.3, 3, 0.2), 0.3), new QuadLight(new(0.3, 6, 0.2), -Vector.J, 0.2, 0.2, Colour.White, 1e-3, Range));
        var floor = (Floor(), new Material("m") { Diffuse = Colour.White });
        var (mean, error) = Mean(Scene([near, far], floor), Above);
        var (expected, _) = Mean(Scene([near], floor), Above);
        Assert.InRange(mean.Y, expected.Y - (3 * error), expected.Y + (3 * error));
        var radiance = LampIntegral.RadianceOf(near);
        Assert.Equal(radiance, Trace(Scene([far, near], floor), Upwards(Above), 1).RadianceAt(0, 0).Y, 1e-3 * radiance);
    }

    /// <summary>Lamps are cut by clip planes as all surfaces are.</summary>
    [Theory]
    [InlineData(1, true)]
    [InlineData(2.5, false)]
    public void AddSample_OfALampBeforeTheNearPlane_DoesNotShowIt(double near, bool isSeen)
    {
        var lamp = new QuadLight(new(0, 3, 0), -Vector.J, 3, 3, Colour.White, 1, 100);
        var view = new View(new(Vector.J, Vector.Zero, 1), Projection.Perspective) { FixedClipPlanes = (near, 50) };
        var seen = Trace(Scene(lamp), Upwards(view), 1).RadianceAt(0, 0).Y;
        Assert.Equal(isSeen ? LampIntegral.RadianceOf(lamp) : 0.1, seen, 0.01);
    }

    private static void AssertIrradiance(PointLight lamp, Vector normal, double factor)
    {
        var (mean, error) = Sampled(lamp, Surface(normal), normal, 4096);
        var expected = factor * LampIntegral.RadianceOf(lamp);
        Assert.True(
            Math.Abs(mean.Y - expected) <= (3.5 * error) + (1e-3 * expected), $"{lamp}: {mean.Y} instead of {expected}, error {error}");
        Assert.InRange(error, 0, Math.Max(0.05 * expected, 1e-12));
    }

    /// <summary>The light that a surface reflects, by samples of the lamp alone.</summary>
    private static (Vector Mean, double Error) Sampled(PointLight light, TracedSurface surface, Vector toEye, int count)
    {
        var scene = Scene([light]);
        var traced = new TracedScene(scene, new());
        var values = Enumerable.Range(0, count).Select(i =>
        {
            var samples = new SampleSequence(i, 0, 1);
            return traced.Lamps!.Reflected(in surface, Vector.Zero, toEye, 0, isAlone: true, traced, ref samples, new());
        }).ToArray();
        return Statistics(values);
    }

    private static (Vector Mean, double Error) Statistics(Vector[] values)
    {
        var mean = values.Aggregate(Vector.Zero, static (sum, value) => sum + value) / values.Length;
        return (mean, Math.Sqrt(values.Sum(value => Math.Pow(value.Y - mean.Y, 2))) / values.Length);
    }

    private static (Vector Mean, double Error) Mean(LoadedScene scene, View view)
    {
        var tracer = Trace(scene, view, 24);
        return Statistics([.. Enumerable.Range(0, 12 * 12).Select(i => tracer.RadianceAt(i % 12, i / 12))]);
    }

    private static PathTracer Trace(LoadedScene scene, View view, int samples)
    {
        var tracer = new PathTracer(scene, view, 12, 12) { BounceLimit = 1 };
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample();
        }

        return tracer;
    }

    private static LoadedScene Scene(Light light, params ImmutableArray<(Mesh Mesh, Material Material)> objects) => Scene([light], objects);

    private static LoadedScene Scene(ImmutableArray<Light> lights, params ImmutableArray<(Mesh Mesh, Material Material)> objects) =>
        RenderScenes.Scene(
            new() { Lights = lights, Background = new(0.349, 0.349, 0.349) },
            [.. objects.Select(static item =>
                (TexturedScenes.WithMaterial(item.Mesh, item.Material), Transformation.Identity, (Colour?)null))]);

    private static View Upwards(View view) => view with { Camera = view.Camera with { Rotation = new(0.5 * Math.PI, 0, 0) } };

    private static Mesh Floor(double y = 0) => new([-9, y, -9, -9, y, 9, 9, y, 9, 9, y, -9], [0, 1, 2, 0, 2, 3]);

    private static TracedSurface Surface(Vector normal) => new(Vector.Zero, normal, normal, Vector.One, null, Vector.Zero, 1);

    private static TracedLamp TracedOf(PointLight light) => light.ToEmitter() is { Radius: > 0 } ball
        ? new TracedBall(ball, Vector.Zero, 1) : new TracedQuad(light.ToEmitter()!, Vector.Zero, 1);

    private static QuadLight Lamp(Vector position, Vector direction, double halfWidth, double halfHeight, double turn = 0) =>
        new(position, direction, 2 * halfWidth, 2 * halfHeight, Colour.White, 1e-5, Range, turn);

    private static BallLight Lamp(Vector position, double radius) => new(position, radius, Colour.White, 1e-5, Range);

    /// <summary>A lamp about a unit away that shows its front to the origin.</summary>
    private static PointLight RandomLamp(Random random, double logSize = -0.4)
    {
        var position = random.Between(0.8, 1.5) * random.Direction();
        var size = Math.Pow(10, logSize);
        return random.Next(2) == 0 ? Lamp(position, size)
            : Lamp(
                position, (0.5 * random.Direction()) - position.UnitVector(), size * random.Between(0.3, 1.5), size,
                random.Between(0, 90));
    }
}
