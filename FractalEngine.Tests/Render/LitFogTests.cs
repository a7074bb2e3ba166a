using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Render;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render;

/// <summary>Light that haze scatters, drawn and traced, beside integrals along the way.</summary>
[Collection(GlTests.Name)]
public sealed class LitFogTests
{
    private static readonly Fog Even = new(0.5, Colour.Black) { Albedo = 0.8 };
    private static readonly Fog Forward = Even with { Anisotropy = 0.6 };
    private static readonly Light Sun = new DirectionalLight(new(0.6, -0.48, 0.64), Colour.White, 3);
    private static readonly Light Above = new DirectionalLight(-Vector.J, Colour.White, 3);
    private static readonly Light Lamp = new PointLight(new(0.7, 2.5, 3), Colour.White, 15, 12);
    private static readonly Light Spot = new SpotLight(new(0.5, 2, 2), new(-0.2, -1, 0.3), 60, Colour.White, 15, 9);

    // Over the way at the depths from 2 to 3.5; and behind the eye, where it shades nothing.
    private static readonly Transformation Roof = new(new(0.1, 0.6, 2.75), Vector.Zero, new(1, 0.1, 0.75));
    private static readonly Transformation Behind = RenderScenes.TranslatedTo(0, 0, -9);

    /// <summary>Haze without a colour hides what is far before a background, which is shown as it is declared.</summary>
    [Fact]
    public void Colour_OfHazeBeforeABackground_IsShownAsThat()
    {
        var scene = new Scene { Fog = new(1), Background = new(0.2, 0.4, 0.6), Exposure = 2, Tone = Tone.Filmic };
        var (red, green, blue) = DisplayTransform.Of(scene).ToSrgb(LightBlock.FogColour(scene, Colour.White));
        // The curve is inverted by halving.
        Near.Equal(new Vector(0.2, 0.4, 0.6), new(red, green, blue), 1e-6);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(0.6)]
    [InlineData(-0.95)]
    public void Phase_OverAllDirections_IsOneWithTheMeanCosineOfItsAnisotropy(double anisotropy)
    {
        var fog = Even with { Anisotropy = anisotropy };
        const int Steps = 100000;
        var cosines = Enumerable.Range(0, Steps).Select(static i => (2 * (i + 0.5) / Steps) - 1).ToArray();
        // The midpoint rule misses the sharp peak by less.
        Near.Equal(1, cosines.Sum(cosine => 4 * Math.PI / Steps * fog.Phase(cosine)), 1e-4);
        Near.Equal(anisotropy, cosines.Sum(cosine => 4 * Math.PI / Steps * cosine * fog.Phase(cosine)), 1e-4);
    }

    [Theory]
    [InlineData(4)]
    [InlineData(0.001)]
    [InlineData(double.PositiveInfinity)]
    public void Samples_OfAWay_AddUpToItsIntegral(double length)
    {
        var (toLamp, direction) = (new Vector(0.3, 0.4, 2), Vector.K);
        static double Light(double t) => 1 / (0.25 + ((t - 2) * (t - 2)));
        double Mean(Func<double, (double Distance, double Weight)> sample) => Enumerable.Range(0, 4096)
            .Select(i => sample((i + 0.5) / 4096)).Average(found => found.Weight * Light(found.Distance));
        double Integral(double end) => Enumerable.Range(0, 100000).Select(i => end * (i + 0.5) / 100000)
            .Average(t => end * 0.5 * Math.Exp(-0.5 * t) * Light(t));

        // Midpoints of smooth functions. Behind 60 units a 10^13th of light is left.
        var whole = Integral(Math.Min(length, 60));
        Near.Equal(whole, Mean(number => TracedAir.SampleSun(number, 0.5, length)), 1e-3 * whole);
        // The lamp reaches 1.5 units before and behind its closest point.
        var range = Math.Sqrt(0.25 + (1.5 * 1.5));
        var near = Integral(Math.Min(length, 3.5)) - Integral(Math.Min(length, 0.5));
        Near.Equal(near, Mean(number => TracedAir.SampleLamp(number, 0.5, length, toLamp, direction, range)), (1e-3 * near) + 1e-12);
    }

    [SkippableTheory]
    [InlineData(0, 2)]
    [InlineData(0.6, 2)]
    [InlineData(-0.3, double.PositiveInfinity)]
    public void Sun_InOpenAir_IsThePartThatIsLostOnTheWay(double anisotropy, double distance)
    {
        // An intensity of 3 is the irradiance 3π; the deflection from (0.6, -0.48, 0.64) to -z has the cosine -0.64.
        var phase = (1 - (anisotropy * anisotropy)) / (4 * Math.PI * Math.Pow(1 + (anisotropy * anisotropy) + (1.28 * anisotropy), 1.5));
        var expected = 0.8 * 3 * Math.PI * phase * (1 - Math.Exp(-0.5 * distance));
        var wall = double.IsFinite(distance) ? RenderScenes.TranslatedTo(0, 0, distance + 1) : Behind;
        var scene = Scene(Even with { Anisotropy = anisotropy }, Sun, wall);
        // What every point of the way shows alike has no noise; the ray leans by a tenth of a degree at most.
        Near.Equal(expected, Traced(scene, Projection.Perspective, 1), 1e-5);
        // A step of the screen's values.
        Near.Equal(expected, Drawn(scene, Projection.Perspective, new()), 0.008);
    }

    public static TheoryData<int, Projection> Cases => new()
    {
        { 0, Projection.Perspective }, { 1, Projection.Perspective }, { 2, Projection.Perspective },
        { 2, Projection.Orthographic }, { 3, Projection.Orthographic },
    };

    [SkippableTheory]
    [MemberData(nameof(Cases))]
    public void Light_UnderARoofOutOfView_IsTheIntegralOfWhatItLeaves(int index, Projection projection)
    {
        var light = ((Light[])[Above, Sun, Lamp, Spot])[index];
        var expected = Expected(Forward, light.ToEmitter()!, Roof);
        var open = Expected(Forward, light.ToEmitter()!, Behind);
        Assert.True(expected < 0.95 * open, "the roof is to leave less");
        var scene = Scene(Forward, light, Roof);
        // 64 pixels of 64 samples.
        Near.Equal(expected, Traced(scene, projection, 64), 0.01 * expected);
        // 256 points of the way, and a step of the screen's values.
        Near.Equal(expected, Drawn(scene, projection, new()), (0.02 * expected) + 0.004);
        Near.Equal(expected, Drawn(scene, projection, new() { FitShadowsToView = false, Samples = 0 }), (0.02 * expected) + 0.004);
        Near.Equal(open, Drawn(scene, projection, new() { Shadows = false }), (0.02 * open) + 0.004);
    }

    [SkippableFact]
    public void Shafts_ThroughASponge_AreDrawnAsTheyAreTraced()
    {
        var fog = new Fog(0.5, Colour.Black) { Albedo = 0.9, Anisotropy = 0.3 };
        var scene = RenderScenes.Scene(
            new Scene { Background = Colour.Black, Fog = fog, Lights = [new SunLight(new(0.1, -1, 0.04), Colour.White, 3)] },
            (RenderScenes.Menger(3), Transformation.Identity, Colour.Black));
        var camera = CameraFraming.LookAt(new(0.16, -0.24, -1.04), new(-0.04, -0.06, 0.4), Vector.J, 62, Handedness.Left);
        var view = new View(camera, Projection.Perspective);
        var drawn = RenderScenes.Draw(scene, view, 96, 64);
        var tracer = Trace(scene, view, 96, 64, 24);
        var (sum, close, count) = (0.0, 0, 0);
        for (var y = 0; y < 64; y += 8)
        {
            for (var x = 0; x < 96; x += 8)
            {
                var traced = MeanOf(x, y, 8, (i, j) => tracer.RadianceAt(i, j).Y);
                var decibels = Math.Abs(10 * Math.Log10(MeanOf(x, y, 8, (i, j) => LightOf(drawn, i, j)) / traced));
                // Darker blocks are few steps of the screen's values.
                count += traced > 0.01 ? 1 : 0;
                close += traced > 0.01 && decibels <= 1.5 ? 1 : 0;
                sum += traced > 0.01 ? decibels : 0;
            }
        }

        Assert.InRange(count, 60, 96);
        Assert.True(close >= 0.95 * count && sum / count < 0.5, $"{close} of {count} blocks, {sum / count:F2} dB on the mean");
    }

    [SkippableFact]
    public void GatheredFrames_OfALamp_AreAsTraced()
    {
        var scene = Scene(Forward, Lamp, RenderScenes.TranslatedTo(0, -2, 9));
        var view = new View(new(Vector.Zero, Vector.Zero, 60), Projection.Perspective);
        using var context = new SharedContext();
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, new()));
        using var frame = new FrameRenderer(context);
        frame.Draw(renderer, view, 64, 64, new());
        for (var i = 1; i < 8; i++)
        {
            frame.Gather(renderer, view, new());
        }

        var drawn = frame.Capture();
        var tracer = Trace(scene, view, 64, 64, 16);
        foreach (var left in (int[])[8, 40])
        {
            // Steps of the screen's values, and noise.
            var traced = MeanOf(left, 24, 16, (x, y) => tracer.RadianceAt(x, y).Y);
            Near.Equal(traced, MeanOf(left, 24, 16, (x, y) => LightOf(drawn, x, y)), 0.02 * traced);
        }
    }

    [SkippableFact]
    public void Draw_OfOtherSizesAndSettings_IsThatOfANewRenderer()
    {
        var scene = Scene(Forward, Sun, Roof, RenderScenes.TranslatedTo(0, -2, 4));
        (int Width, RenderSettings Settings)[] cases =
            [(40, new()), (40, new() { Shadows = false }), (31, new() { Samples = 0 }), (31, new() { Wireframe = true }), (40, new())];
        var expected = cases.Select(item => RenderScenes.Draw(scene, RenderScenes.FrontView, item.Width, 30, item.Settings)).ToArray();
        using var context = new SharedContext();
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, new()));
        using var frame = new FrameRenderer(context);
        foreach (var (index, (width, settings)) in cases.Index())
        {
            frame.Draw(renderer, RenderScenes.FrontView, width, 30, settings);
            context.Resources.ThrowOnError("drawing");
            Assert.Equal(expected[index].Pixels, frame.Capture().Pixels);
        }
    }

    [SkippableFact]
    public void Draw_OfLitFog_AllocatesNoMoreThanOfOtherFog() =>
        Assert.Equal(AllocatedOf(Forward with { Albedo = 0 }), AllocatedOf(Forward));

    [SkippableFact]
    public void Fog_WithoutAlbedo_IsAsBefore()
    {
        var scenes = ((Fog[])[new(0.1), new(0.1) { Anisotropy = 0.9 }]).Select(fog => Scene(fog, Sun, RenderScenes.TranslatedTo(0, 0, 4)));
        var drawn = scenes.Select(scene => RenderScenes.Draw(scene, RenderScenes.FrontView, 40, 30).Pixels).ToArray();
        var traced = scenes.Select(scene => Trace(scene, RenderScenes.FrontView, 40, 30, 2).ToImage().Pixels).ToArray();
        Assert.Equal(drawn[0], drawn[1]);
        Assert.Equal(traced[0], traced[1]);
    }

    /// <summary>Black cubes from −1 to 1, at places.</summary>
    private static LoadedScene Scene(Fog fog, Light light, params Transformation[] places) => RenderScenes.Scene(
        new Scene { Background = Colour.Black, Fog = fog, Lights = [light] },
        [.. places.Select(static place => (RenderScenes.Model(RenderScenes.Cube(1)), place, (Colour?)Colour.Black))]);

    private static long AllocatedOf(Fog fog)
    {
        using var context = new SharedContext();
        var scene = DrawableScene.Prepare(Scene(fog, Sun, Roof, RenderScenes.TranslatedTo(0, -2, 4)), new());
        using var renderer = new SceneRenderer(context, scene);
        using var frame = new FrameRenderer(context);
        var settings = new RenderSettings();
        frame.Draw(renderer, RenderScenes.FrontView, 40, 30, settings);
        return Allocation.Measure(() => frame.Draw(renderer, RenderScenes.FrontView, 40, 30, settings));
    }

    /// <summary>A narrow view along z, as good as one ray.</summary>
    private static View Along(Projection projection) =>
        new(new(Vector.Zero, Vector.Zero, 0.1), projection) { OrthographicHeight = 0.001 };

    private static double Drawn(LoadedScene scene, Projection projection, RenderSettings settings)
    {
        var image = RenderScenes.Draw(scene, Along(projection), 16, 16, settings);
        return MeanOf(0, 0, 16, (x, y) => LightOf(image, x, y));
    }

    private static double Traced(LoadedScene scene, Projection projection, int count)
    {
        var tracer = Trace(scene, Along(projection), 8, 8, count);
        return MeanOf(0, 0, 8, (x, y) => tracer.RadianceAt(x, y).Y);
    }

    private static PathTracer Trace(LoadedScene scene, View view, int width, int height, int count)
    {
        var tracer = new PathTracer(scene, view, width, height);
        for (var i = 0; i < count; i++)
        {
            tracer.AddSample();
        }

        return tracer;
    }

    private static double LightOf(PixelImage image, int x, int y) => new Colour(image[x, y].Green / 255.0, 0, 0).ToLinear().Red;

    private static double MeanOf(int left, int top, int size, Func<int, int, double> light) =>
        Enumerable.Range(0, size * size).Average(i => light(left + (i % size), top + (i / size)));

    /// <summary>Adds up the way from the origin along z: what each part scatters, unless a cube is between it and the light.</summary>
    private static double Expected(Fog fog, Emitter light, Transformation cube)
    {
        const double Step = 0.002;
        var sum = 0.0;
        for (var t = 0.5 * Step; t < 40; t += Step)
        {
            var point = t * Vector.K;
            var incoming = light.Incoming(point, out var toLight, out _).Y;
            var isFree = !Enters(point, toLight, cube);
            var g = fog.Anisotropy;
            var phase = (1 - (g * g)) / (4 * Math.PI * Math.Pow(1 + (g * g) - (2 * g * toLight.Z), 1.5));
            sum += isFree ? Step * fog.Density * Math.Exp(-fog.Density * t) * fog.Albedo * Math.PI * incoming * phase : 0;
        }

        return sum;
    }

    /// <summary>Tells whether a ray enters the cube from −1 to 1 that is scaled and moved. All lamps are behind it.</summary>
    private static bool Enters(Vector point, Vector direction, Transformation cube)
    {
        var (enter, leave) = (0.0, double.PositiveInfinity);
        foreach (var axis in (Vector[])[Vector.I, Vector.J, Vector.K])
        {
            var (half, way) = (Vector.Dot(axis, cube.Scale), Vector.Dot(axis, direction));
            var ahead = Vector.Dot(axis, cube.Position - point);
            var (first, second) = ((ahead - half) / way, (ahead + half) / way);
            (enter, leave) = (Math.Max(enter, Math.Min(first, second)), Math.Min(leave, Math.Max(first, second)));
        }

        return enter < leave;
    }
}
