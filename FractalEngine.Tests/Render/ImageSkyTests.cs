using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Scenes.Lights;

namespace FractalEngine.Tests.Render;

/// <summary>Skies of images in traced and in drawn images, against closed forms and against each other.</summary>
[Collection(GlTests.Name)]
public sealed class ImageSkyTests
{
    private static readonly View Near = new(Camera.Default, Projection.Orthographic) { OrthographicHeight = 1e-3 };

    [Theory]
    [InlineData(5, 9, 0)]
    [InlineData(60, 20, 0)]
    [InlineData(20, 9, 90)]
    public void MattSurface_UnderOneBrightSpot_HasItsIrradiance(int x, int y, double turn)
    {
        const int Size = 16;
        const int Samples = 64;
        const double Light = 1000;
        var scene = MattSquare(new ImageSky("spot.hdr", turn, Light) { Image = new(SkyImageTests.Spots(64, 32, (x, y))) }, Vector.Zero);
        var tracer = Trace(scene, Near, Size, Samples);
        var values = Enumerable.Range(0, Size * Size).Select(i => tracer.RadianceAt(i % Size, i / Size).X).ToArray();
        var mean = values.Average();
        var variance = values.Sum(value => Math.Pow(value - mean, 2)) / (values.Length - 1);

        // The square faces −z. The pixel is a tent over φ and θ, of which these are the integrals with sin²θ and cos φ.
        var side = Math.PI / 32;
        var (theta, phi) = ((y + 0.5) * side, ((x + 0.5) * side) - Math.PI - (turn * Math.PI / 180));
        var ofRows = 0.5 * side * (1 - (Math.Cos(2 * theta) * Squared(Math.Sin(side) / side)));
        var ofColumns = side * Math.Cos(phi) * Squared(Math.Sin(side / 2) / (side / 2));
        var expected = Math.Max(0, -ofColumns) * ofRows * Light / Math.PI;
        var error = (3 * Math.Sqrt(variance / values.Length)) + 1e-12;
        Assert.InRange(mean, expected - error, expected + error);
        if (expected > 0)
        {
            // By reflection alone, a sample would be the light of the spot, 2/3 of it along both sides of the tent, or nothing.
            var ofReflection = (expected * Light * 4 / 9) - (expected * expected);
            Assert.InRange(variance * Samples, 0, ofReflection / 300);
        }
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void WhiteBall_UnderAnEvenImage_IsNotSeen(bool isGlass)
    {
        var image = new FloatImage(8, 4, [.. Enumerable.Repeat(0.6f, 3 * 8 * 4)]);
        var material = isGlass
            ? new Material("m") { RefractiveIndex = 1.5, Opacity = 0.3, Diffuse = Colour.White, Roughness = 0.5 }
            : new Material("m") { Diffuse = Colour.White, Roughness = 0.6, Metalness = 0.5 };
        var scene = RenderScenes.Scene(
            new() { Sky = new ImageSky("even.hdr") { Image = new(image) } },
            (TexturedScenes.WithMaterial(RenderScenes.Sphere(12), material), Transformation.Identity, null));
        var tracer = Trace(scene, RenderScenes.FrontView, 12, 256);
        var values = Enumerable.Range(0, 144).Select(i => tracer.RadianceAt(i % 12, i / 12).X).ToArray();
        Assert.All(values, value => Assert.Equal(0.6, value, 0.03));
        // Of 0.2 % the table of facets is the cause.
        Assert.Equal(0.6, values.Average(), 0.002);
    }

    [Fact]
    public void Sky_BehindAPane_ShinesOnceThroughIt()
    {
        // Half of the light comes through a pane; the surface behind it gets it by chosen directions and by paths.
        var sky = new ImageSky("spot.hdr", 0, 300) { Image = new(SkyImageTests.Spots(64, 32, (0, 15), (63, 15), (0, 16), (63, 16))) };
        var open = MattSquare(sky, Vector.Zero);
        var pane = TexturedScenes.WithMaterial(RenderScenes.Square(50), new("m") { Diffuse = Colour.Black, Opacity = 0.5 });
        var behind = RenderScenes.Scene(
            open.Scene with { Objects = [] }, (RenderScenes.Model(RenderScenes.Square(1)), Transformation.Identity, Colour.White),
            (pane, RenderScenes.TranslatedTo(0, 0, -9), null));
        Assert.Equal(
            Mean(Trace(open, Near, 16, 64), 16) / 2, Mean(Trace(behind, Near, 16, 64), 16), 0.02 * Mean(Trace(open, Near, 16, 64), 16));
    }

    [SkippableTheory]
    [InlineData(0, 0, 0, Handedness.Left)]
    [InlineData(60, 20, 0, Handedness.Left)]
    [InlineData(-50, 140, 120, Handedness.Right)]
    public void MattSurface_UnderASmoothImage_IsDrawnAsItIsTraced(double pitch, double yaw, double turn, Handedness handedness)
    {
        var sky = new ImageSky("smooth.hdr", turn, 0.7) { Image = new(Smooth()) };
        var scene = MattSquare(sky, new(pitch, yaw, 0), handedness);
        var traced = Mean(Trace(scene, Near, 8, 256), 8);
        foreach (var shading in Enum.GetValues<Shading>())
        {
            var drawn = RenderScenes.Draw(scene, Near, 9, 9, new() { Shading = shading })[4, 4].Red / 255.0;
            Assert.Equal(traced, new Colour(drawn, 0, 0).ToLinear().Red, (0.03 * traced) + 0.0045);
        }
    }

    [SkippableTheory]
    [InlineData(Handedness.Left, 0)]
    [InlineData(Handedness.Right, 50)]
    public void Background_OfAnImage_IsDrawnAsItIsTraced(Handedness handedness, double turn)
    {
        var sky = new ImageSky("smooth.hdr", turn, 0.6) { Image = new(Smooth()) };
        var scene = RenderScenes.Scene(
            new() { Sky = sky, Handedness = handedness, Tone = Tone.Filmic, Exposure = 1.4 },
            (TexturedScenes.WithMaterial(RenderScenes.Sphere(24), new("m") { Diffuse = Colour.White, Metalness = 1, Roughness = 0.5 }),
                Transformation.Identity, null));
        var view = RenderScenes.FrontView with { Camera = Camera.Default with { Handedness = handedness, Rotation = new(0.1, 0.2, 0) } };
        var difference = RenderScenes.Difference(RenderScenes.Draw(scene, view, 80, 60), Trace(scene, view, 80, 60, 64).ToImage());
        // The ball mirrors it, too, within what facets mirror along their normal.
        Assert.True(difference is { Mean: < 2, Share: < 0.05 }, $"{difference}");
    }

    [Fact]
    public void Prefilter_OfASmallSun_HasNoSpeckles()
    {
        // Four of 256 × 128 pixels, brighter by 10⁵: what rough facets mirror falls evenly from there on.
        var image = new FloatImage(256, 128, [.. Enumerable.Repeat(0.3f, 3 * 256 * 128)]);
        foreach (var (x, y) in ((int, int)[])[(100, 40), (101, 40), (100, 41), (101, 41)])
        {
            image[x, y] = 3e4 * Vector.One;
        }

        var sky = new ImageSky("sun.hdr") { Image = new(image) };
        var levels = new Surroundings(new() { Sky = sky }).Prefilter(256, 128);
        var sun = ((ImageRadiance)sky.ToRadiance(Handedness.Left)).DirectionOf(101.0 / 256, 41.0 / 128);
        for (var level = 2; level < levels.Length; level++)
        {
            var (width, height) = (256 >> level, 128 >> level);
            var previous = double.PositiveInfinity;
            for (var ring = 0; ring < 12; ring++)
            {
                // Means and extremes of rings around the sun.
                var values = Enumerable.Range(0, width * height)
                    .Where(i => RingOf(DirectionOf(i % width, i / width, width, height)) == ring)
                    .Select(i => levels[level][3 * i]).ToArray();
                if (values.Length < 8)
                {
                    continue;
                }

                Assert.InRange(values.Average(), 0, 1.02 * previous);
                previous = values.Average();
            }
        }

        int RingOf(Vector direction) => (int)(Math.Acos(Math.Clamp(Vector.Dot(sun, direction), -1, 1)) * 12 / Math.PI);

        static Vector DirectionOf(int column, int row, int width, int height)
        {
            var (radius, y) = Math.SinCos((row + 0.5) / height * Math.PI);
            var (z, x) = Math.SinCos(((column + 0.5) / width * 2 * Math.PI) - Math.PI);
            return new(radius * x, y, radius * z);
        }
    }

    /// <summary>An image of harmonics up to the second degree, which the shaders know exactly.</summary>
    private static FloatImage Smooth()
    {
        var image = new FloatImage(128, 64, new float[3 * 128 * 64]);
        for (var i = 0; i < 128 * 64; i++)
        {
            var (row, column) = Math.DivRem(i, 128);
            var (radius, y) = Math.SinCos((row + 0.5) / 64 * Math.PI);
            var (x, z) = Math.SinCos(((column + 0.5) / 128 * 2 * Math.PI) - Math.PI);
            (x, z) = (radius * x, radius * z);
            image[column, row] = new(
                0.6 + (0.25 * x) - (0.15 * z) + (0.1 * y), 0.6 + (0.3 * x * y), 0.6 + (0.2 * ((x * x) - (z * z))) + (0.2 * x * z));
        }

        return image;
    }

    private static LoadedScene MattSquare(Sky sky, Vector rotation, Handedness handedness = Handedness.Left) => RenderScenes.Scene(
        new() { Sky = sky, Background = Colour.Black, Handedness = handedness },
        (RenderScenes.Model(RenderScenes.Square(1)), new(Vector.Zero, rotation, Vector.One), Colour.White));

    private static PathTracer Trace(LoadedScene scene, View view, int size, int samples) => Trace(scene, view, size, size, samples);

    private static PathTracer Trace(LoadedScene scene, View view, int width, int height, int samples)
    {
        var tracer = new PathTracer(scene, view, width, height);
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample();
        }

        return tracer;
    }

    private static double Mean(PathTracer tracer, int size) =>
        Enumerable.Range(0, size * size).Average(i => tracer.RadianceAt(i % size, i / size).X);

    private static double Squared(double number) => number * number;
}
