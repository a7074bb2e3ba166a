using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Render.Tracing;

namespace FractalEngine.Tests.Render;

/// <summary>Sky, haze, exposure and tone, in drawn and in traced images alike.</summary>
[Collection(GlTests.Name)]
public sealed class SkyTests
{
    private static readonly ColourSky Blue = new(new(0.2, 0.4, 0.9), new(0.8, 0.85, 0.9), new(0.3, 0.25, 0.2));

    [Theory]
    [InlineData(-1)]
    [InlineData(-0.6)]
    [InlineData(0)]
    [InlineData(0.3)]
    [InlineData(1)]
    public void Irradiance_OfTheCoefficients_IsTheIntegralOfTheRadiance(double height)
    {
        var radiance = Blue.ToRadiance(Handedness.Left);
        var irradiance = radiance.Irradiance();
        var normal = new Vector(Math.Sqrt(1 - (height * height)), height, 0);
        var sum = Vector.Zero;
        const int Steps = 400;
        for (var i = 0; i < Steps; i++)
        {
            for (var j = 0; j < Steps; j++)
            {
                var y = ((i + 0.5) * 2 / Steps) - 1;
                var (sine, cosine) = Math.SinCos((j + 0.5) * 2 * Math.PI / Steps);
                var radius = Math.Sqrt(1 - (y * y));
                sum += Math.Max(0, Vector.Dot(normal, new(radius * cosine, y, radius * sine))) * radiance.At(new(0, y, 0));
            }
        }

        // Every direction stands for 4π/n² of the sphere. Three harmonics of a sky with a bend at the horizon miss a few percent.
        var expected = 4.0 / (Steps * Steps) * sum;
        var found = irradiance.Constant + (height * irradiance.Linear) + (height * height * irradiance.Quadratic);
        Assert.InRange((found - expected).Length(), 0, 0.04 * expected.Length());
    }

    [SkippableTheory]
    [InlineData(Projection.Perspective, Tone.Filmic, 1.7)]
    public void Sky_BehindAConvexSolidInHaze_IsDrawnAsItIsTraced(Projection projection, Tone tone, double exposure)
    {
        var scene = RenderScenes.Scene(
            new Scene
            {
                Sky = Blue, Tone = tone, Exposure = exposure, Fog = new(0.1), Lights = [new SunLight(new(1, -1, 2), Colour.White, 2, 0)],
            },
            (RenderScenes.Model(RenderScenes.Cube(1)), new(Vector.Zero, new(20, 30, 10), Vector.One), new Colour(0.8, 0.5, 0.3)));
        var view = RenderScenes.FrontView with { Projection = projection, OrthographicHeight = 6 };
        var drawn = RenderScenes.Draw(scene, view, 80, 60);
        var tracer = new PathTracer(scene, view, 80, 60);
        for (var i = 0; i < 256; i++)
        {
            tracer.AddSample();
        }

        // A convex solid has neither shadows nor light from itself: what differs is noise, edges, and the harmonics.
        var (mean, share) = RenderScenes.Difference(drawn, tracer.ToImage());
        Assert.InRange(mean, 0, 1.5);
        Assert.InRange(share, 0, 0.03);
    }

    [SkippableTheory]
    [InlineData(Projection.Perspective, Tone.None, 1)]
    [InlineData(Projection.Orthographic, Tone.Filmic, 0.6)]
    [Trait("Category", "Soak")]
    public void Sky_BehindAConvexSolidInHazeInOtherCases_IsDrawnAsItIsTraced(Projection projection, Tone tone, double exposure) =>
        Sky_BehindAConvexSolidInHaze_IsDrawnAsItIsTraced(projection, tone, exposure);

    [SkippableFact]
    public void Fog_BehindGlass_IsDrawnOfTheWholeWay()
    {
        var scene = LoadedScene.Of(PathTracerTests.FogBehindGlass());
        var image = RenderScenes.Draw(scene, new(new(Vector.Zero, Vector.Zero, 1), Projection.Perspective), 8, 8);
        // Both layers are rounded to values of 256.
        Assert.Equal(255 * Srgb(PathTracerTests.LightOfFogBehindGlass), image[4, 4].Green, 1.5);
    }

    [SkippableFact]
    public void Fog_WithoutAColour_FadesToTheBackgroundOfTheSettings()
    {
        var scene = RenderScenes.Scene(
            new Scene { Fog = new(100), Lights = [RenderScenes.FullLight] },
            (RenderScenes.Model(RenderScenes.Cube(1)), Transformation.Identity, new Colour(1, 0, 0)));
        using var context = new SharedContext();
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, new()));
        using var frame = new FrameRenderer(context);
        foreach (var background in (Colour[])[new(0, 1, 0), new(0, 0, 1)])
        {
            var settings = new RenderSettings { Background = background };
            frame.Draw(renderer, RenderScenes.FrontView, 20, 20, settings);
            var tracer = new PathTracer(scene, RenderScenes.FrontView, 20, 20, settings);
            tracer.AddSample();
            var expected = (0, (int)(255 * background.Green), (int)(255 * background.Blue), 255);
            Assert.Equal(expected, frame.Capture()[10, 10]);
            Assert.Equal(expected, tracer.ToImage()[10, 10]);
        }
    }

    [SkippableTheory]
    [InlineData(false)]
    [InlineData(true)]
    public void Sky_OfASlowGradient_HasNoBands(bool isTraced)
    {
        // Three values of 256 from the horizon to the zenith, of which the image shows half. Rounded alike everywhere, pixels of a block
        // are up to half a value off, all of them.
        var sky = new ColourSky(new(0.51, 0.51, 0.51), new(0.5, 0.5, 0.5), new(0.49, 0.49, 0.49));
        var scene = SkyAlone(new() { Sky = sky });
        const int Size = 64;
        const int Block = 8;
        var image = isTraced ? Traced(scene, Size) : RenderScenes.Draw(scene, RenderScenes.FrontView, Size, Size);
        var halfHeight = RenderScenes.FrontView.HalfHeight;
        for (var top = 0; top < Size; top += Block)
        {
            for (var left = 0; left < Size; left += Block)
            {
                var (sum, expected) = (0.0, 0.0);
                for (var y = top; y < top + Block; y++)
                {
                    for (var x = left; x < left + Block; x++)
                    {
                        var right = (((x + 0.5) * 2 / Size) - 1) * halfHeight;
                        var up = (1 - ((y + 0.5) * 2 / Size)) * halfHeight;
                        sum += image[x, y].Green;
                        expected += 255 * Srgb(sky.ToRadiance(Handedness.Left).At(new Vector(right, up, 1).UnitVector()).Y);
                    }
                }

                Assert.Equal(expected / (Block * Block), sum / (Block * Block), 0.1);
            }
        }
    }

    [SkippableFact]
    public void Sky_OfOneColour_IsShownAsIs_AndNothingElseIsDithered()
    {
        var colour = new Colour(51 / 255.0, 0.6, 204 / 255.0);
        var scene = SkyAlone(new() { Sky = new ColourSky(colour, colour, colour) });
        Assert.Equal(0, RenderScenes.CountDifferent(Traced(scene, 40), (51, 153, 204, 255)));
        // A driver's conversion to sRGB may be off by more than half a value (OpenGL 3.3, 4.1.8): offsets close to half may cross.
        var drawn = RenderScenes.Draw(scene, RenderScenes.FrontView, 40, 40);
        for (var i = 0; i < drawn.Pixels.Length; i++)
        {
            Assert.InRange(drawn.Pixels[i] - new[] { 51, 153, 204, 255 }[i % 4], -1, 1);
        }

        Assert.Equal(drawn.Pixels, RenderScenes.Draw(scene, RenderScenes.FrontView, 40, 40).Pixels);
        // Between two values, but no sky: one of them everywhere.
        var plain = SkyAlone(new() { Background = new(100.4 / 255, 100.4 / 255, 100.4 / 255) });
        Assert.Equal(0, RenderScenes.CountDifferent(RenderScenes.Draw(plain, RenderScenes.FrontView, 40, 40), (100, 100, 100, 255)));
        Assert.Equal(0, RenderScenes.CountDifferent(Traced(plain, 40), (100, 100, 100, 255)));
    }

    [Fact]
    public void OrderedDither_HasEachOffsetOnce_AndRepeats()
    {
        var offsets = Enumerable.Range(0, 64).Select(static i => OrderedDither.At(i % 8, i / 8)).Order().ToArray();
        Assert.Equal(Enumerable.Range(0, 64).Select(static i => ((i + 0.5) / 64) - 0.5), offsets);
        Assert.Equal(OrderedDither.At(3, 5), OrderedDither.At(3 + 8, 5 + 80));
    }

    [SkippableFact]
    public void Background_BesideASky_IsShownAsItIs()
    {
        var declared = new Scene { Sky = Blue, Tone = Tone.Filmic, Exposure = 3, Background = new(0.2, 0.6, 1) };
        var scene = RenderScenes.Scene(declared, (RenderScenes.Model(RenderScenes.Cube(0.1)), Transformation.Identity, null));
        var tracer = new PathTracer(scene, RenderScenes.FrontView, 20, 20);
        tracer.AddSample();

        Assert.Equal((51, 153, 255, 255), RenderScenes.Draw(scene, RenderScenes.FrontView, 20, 20)[1, 1]);
        Assert.Equal((51, 153, 255, 255), tracer.ToImage()[1, 1]);
    }

    [SkippableTheory]
    [InlineData(Tone.None)]
    [InlineData(Tone.Filmic)]
    [InlineData(Tone.Reinhard)]
    [InlineData(Tone.Aces)]
    public void Tone_OfASky_IsDrawnAsItIsTraced(Tone tone)
    {
        // From black over colours to far beyond white, and a background that is shown as it is.
        foreach (var (background, exposure) in ((Colour?, double)[])[(null, 0.1), (null, 3), (null, 60), (new(1, 0.2, 0), 3)])
        {
            var scene = SkyAlone(new Scene
            {
                Sky = new ColourSky(new(0.1, 0.2, 1), new(1, 1, 0.9), new(0.3, 0, 0)), Tone = tone, Exposure = exposure,
                Background = background,
            });
            var drawn = RenderScenes.Draw(scene, RenderScenes.FrontView, 30, 40);
            var tracer = new PathTracer(scene, RenderScenes.FrontView, 30, 40);
            for (var i = 0; i < 64; i++)
            {
                tracer.AddSample();
            }

            var traced = tracer.ToImage();
            // A pixel of the traced image is a mean, which matters at the bend of the horizon only.
            Assert.InRange(drawn.Pixels.Zip(traced.Pixels).Count(pair => Math.Abs(pair.First - pair.Second) > 1), 0, 30 * 4 * 3);
            if (background is { } shown)
            {
                Assert.Equal(((int)(255 * shown.Red), (int)(255 * shown.Green), (int)(255 * shown.Blue), 255), traced[3, 3]);
            }
        }
    }

    [Theory]
    // Equation 4 of the paper with a white of 4, and the fit's polynomials by hand for grey, which keeps its hue.
    [InlineData(Tone.Reinhard, 1, 0.53125)]
    [InlineData(Tone.Reinhard, 4, 1)]
    [InlineData(Tone.Aces, 0.18, 0.1056)]
    [InlineData(Tone.Aces, 1, 0.6191)]
    public void DisplayTransform_OfGrey_IsThatOfTheSource(Tone tone, double light, double shown) =>
        Assert.Equal(0, (new DisplayTransform(1, tone).Apply(light * Vector.One) - (shown * Vector.One)).Length(), 2e-3);

    [Fact]
    public void DisplayTransform_Inverted_ReturnsTheLight()
    {
        foreach (var tone in Enum.GetValues<Tone>())
        {
            var display = new DisplayTransform(1.7, tone);
            foreach (var shown in (Vector[])[Vector.Zero, Vector.One, Vector.I, Vector.K, new(0.9, 0.01, 0.5)])
            {
                Assert.Equal(0, (display.Apply(display.Invert(shown)) - shown).Length(), 1e-9);
            }

            Assert.Equal(0, (display.Apply(display.Invert(new(0, 0.3, 0.999))) - new Vector(0, 0.3, 0.999)).Length(), 1e-12);
        }
    }

    [Fact]
    public void Sun_OfADiameter_CastsASoftEdge()
    {
        // Straight below the edge of a lid, half the disc is hidden; the penumbra is as wide as the disc seen over the distance.
        var floor = RenderScenes.Model(Quad(50, 0), "floor.obj");
        var lid = RenderScenes.Model(new Mesh([0, 4, -50, 0, 4, 50, 50, 4, 50, 50, 4, -50], [0, 1, 2, 0, 2, 3]), "lid.obj");
        var scene = RenderScenes.Scene(
            new Scene { Background = Colour.Black, Lights = [new SunLight(new(0, -1, 0), Colour.White, 1, 10)] },
            (floor, Transformation.Identity, Colour.White), (lid, Transformation.Identity, Colour.Black));
        var radius = 4 * Math.Tan(5 * Math.PI / 180);
        Assert.Equal(1, Lit(scene, -1.1 * radius), 0.02);
        Assert.Equal(0.5, Lit(scene, 0), 0.03);
        Assert.Equal(0, Lit(scene, 1.1 * radius), 0.02);
    }

    /// <summary>A scene whose only object is behind the camera.</summary>
    private static LoadedScene SkyAlone(Scene scene) => RenderScenes.Scene(
        scene, (RenderScenes.Model(RenderScenes.Cube(0.1)), RenderScenes.TranslatedTo(0, 0, -20), null));

    private static PixelImage Traced(LoadedScene scene, int size)
    {
        var tracer = new PathTracer(scene, RenderScenes.FrontView, size, size);
        for (var i = 0; i < 16; i++)
        {
            tracer.AddSample();
        }

        return tracer.ToImage();
    }

    private static double Srgb(double linear) => (1.055 * Math.Pow(linear, 1 / 2.4)) - 0.055;

    private static Mesh Quad(double half, double y) => new(
        [-half, y, -half, -half, y, half, half, y, half, half, y, -half], [0, 1, 2, 0, 2, 3]);

    private static double Lit(LoadedScene scene, double x)
    {
        var camera = new Camera(new(x, 1, 0), new(-Math.PI / 2, 0, 0), 0.1);
        var tracer = new PathTracer(scene, new(camera, Projection.Perspective), 2, 2);
        for (var i = 0; i < 512; i++)
        {
            tracer.AddSample();
        }

        return tracer.RadianceAt(0, 0).X;
    }
}
