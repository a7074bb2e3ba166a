using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Render.Tracing;

namespace FractalEngine.Tests.Render;

/// <summary>Glossy surfaces in drawn frames, against traced ones of the same scene.</summary>
[Collection(GlTests.Name)]
public sealed class GlossDrawingTests
{
    private const int Size = 9;

    private static readonly View Near = new(Camera.Default, Projection.Orthographic) { OrthographicHeight = 1e-3 };

    public static TheoryData<string> Materials => [.. Surfaces.Keys];

    private static Dictionary<string, Material> Surfaces { get; } = new()
    {
        ["mirror"] = new("m") { Diffuse = Colour.Black, Specular = Colour.White, SpecularExponent = 200 },
        ["paint"] = new("m") { Diffuse = new(0.9, 0.5, 0.3), Specular = new(0.04, 0.04, 0.04), SpecularExponent = 40 },
        ["half mirror"] = new("m") { Diffuse = new(0.9, 0.5, 0.3), Specular = new(0.5, 0.3, 0.1), SpecularExponent = 5 },
        ["smooth plastic"] = new("m") { Diffuse = new(0.9, 0.5, 0.3), Roughness = 0.3 },
        ["rough plastic"] = new("m") { Diffuse = new(0.9, 0.5, 0.3), Roughness = 1 },
        ["gold"] = new("m") { Diffuse = new(1, 0.8, 0.4), Roughness = 0.4, Metalness = 1 },
        ["rough metal"] = new("m") { Diffuse = new(1, 0.8, 0.4), Roughness = 1, Metalness = 1 },
        ["half metal"] = new("m") { Diffuse = new(1, 0.8, 0.4), Roughness = 0.6, Metalness = 0.5 },
    };

    [SkippableTheory]
    [MemberData(nameof(Materials))]
    public void Gloss_UnderOneLamp_IsDrawnAsItIsTraced(string name)
    {
        Light[] lamps =
        [
            new DirectionalLight(new(0.2, -0.3, 1), Colour.White, 1), new DirectionalLight(new(-0.9, 0.2, 0.5), Colour.White, 1),
            new PointLight(new(1, 2, -2), new(1, 0.9, 0.7), 1, 30),
        ];
        foreach (var (pitch, yaw) in ((double, double)[])[(0, 0), (10, 40), (-60, 20)])
        {
            foreach (var lamp in lamps)
            {
                // Bright enough to be read from an image of bytes, and not too bright.
                var light = Trace(name, pitch, yaw, new() { Lights = [lamp] }, 1);
                var intensity = 0.6 / Math.Max(light.X, Math.Max(light.Y, light.Z));
                if (!(intensity < 1e3))
                {
                    continue;
                }

                // A light that differs from corner to corner is not lit at vertices alike.
                foreach (var shading in Enum.GetValues<Shading>().Where(shading => shading == Shading.PerPixel || lamp is not PointLight))
                {
                    var drawn = Draw(name, pitch, yaw, new() { Lights = [lamp with { Intensity = intensity }] }, shading);
                    AssertClose(intensity * light, drawn, 0.03, $"{pitch}, {yaw}, {lamp}, {shading}");
                }
            }
        }
    }

    /// <summary>How a texture of heights is repeated is set in the first frame, which left it in the place of the colours.</summary>
    [SkippableFact]
    public void Texture_OfASurfaceWithHeights_IsShownInTheFirstFrame()
    {
        using var textures = new TexturedScenes();
        var material = new Material("m")
        {
            Texture = textures.CreateTexture("colours.png", 2, 2, static (_, _) => (255, 0, 0, 255)),
            BumpTexture = textures.CreateTexture("heights.png", 2, 2, static (_, _) => (0, 0, 128, 255)),
        };
        var scene = RenderScenes.Scene(
            new() { Lights = [RenderScenes.FullLight] }, (TexturedScenes.CreateSquare(1, material), Transformation.Identity, null));
        Assert.Equal((255, 0, 0, 255), RenderScenes.Draw(scene, RenderScenes.FrontView)[100, 75]);
    }

    [SkippableTheory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void Highlight_OfASphere_IsDrawnWhereItIsTraced(Projection projection)
    {
        var sphere = TexturedScenes.WithMaterial(RenderScenes.Sphere(48), Surfaces["gold"]);
        var scene = RenderScenes.Scene(
            new() { Background = Colour.Black, Lights = [new DirectionalLight(new(0.3, -0.5, 0.7), Colour.White, 0.15)] },
            (sphere, Transformation.Identity, null));
        var view = RenderScenes.FrontView with { Projection = projection, OrthographicHeight = 3 };
        var tracer = new PathTracer(scene, view, 100, 75);
        for (var i = 0; i < 8; i++)
        {
            tracer.AddSample();
        }

        var difference = RenderScenes.Difference(tracer.ToImage(), RenderScenes.Draw(scene, view, 100, 75));
        Assert.True(difference is { Mean: < 1, Share: < 0.02 }, $"{difference}");
    }

    [SkippableTheory]
    [MemberData(nameof(Materials))]
    public void WhiteSurface_UnderAWhiteSky_IsDrawnAsBrightAsTheSky(string name)
    {
        var white = new Colour(0.7, 0.7, 0.7);
        var sky = new Scene { Sky = new ColourSky(white, white, white) };
        foreach (var pitch in (double[])[0, 45, 80])
        {
            foreach (var shading in Enum.GetValues<Shading>())
            {
                AssertClose(white.ToLinearVector(), Draw(name, pitch, 0, sky, shading, isWhite: true), 0.01, $"{pitch}, {shading}");
            }
        }
    }

    [SkippableTheory]
    [InlineData(0)]
    [InlineData(0.5)]
    [InlineData(1)]
    public void GlassBall_UnderAnEvenSky_IsNotSeen(double roughness)
    {
        var white = new Colour(0.7, 0.7, 0.7);
        var material = new Material("m") { RefractiveIndex = 1.5, Opacity = 0, Roughness = roughness };
        var scene = RenderScenes.Scene(
            new() { Sky = new ColourSky(white, white, white) },
            (TexturedScenes.WithMaterial(RenderScenes.Sphere(24), material), Transformation.Identity, null));
        var image = RenderScenes.Draw(scene, RenderScenes.FrontView, 60, 60);

        Assert.All(image.Pixels.Chunk(4), pixel => Assert.InRange(pixel[0], 176, 181));
    }

    [SkippableTheory]
    [MemberData(nameof(Materials))]
    public void Gloss_UnderASky_IsDrawnAsItIsTraced(string name)
    {
        var sky = new Scene { Sky = new ColourSky(new(0.4, 0.6, 0.9), new(0.8, 0.75, 0.7), new(0.5, 0.4, 0.3)) };
        foreach (var (pitch, yaw) in ((double, double)[])[(0, 0), (50, 10), (-50, 20)])
        {
            var light = Trace(name, pitch, yaw, sky, 1024);
            // What is mirrored at an angle is not quite what facets mirror along their normal.
            AssertClose(light, Draw(name, pitch, yaw, sky, Shading.PerPixel), 0.09, $"{pitch}, {yaw}");
        }
    }

    [SkippableTheory]
    [InlineData(false, 1)]
    [InlineData(true, 1)]
    [InlineData(true, 3)]
    public void NormalsAndHeights_OfATexture_AreDrawnAsTheyAreTraced(bool areHeights, double scale)
    {
        using var scenes = new TexturedScenes();
        // Normals that lean to the right and up, or heights that grow to the right and down.
        var texture = scenes.CreateTexture("detail.png", 64, 64, (x, y) => areHeights
            ? ((byte)(2 * x + y), (byte)0, (byte)0, (byte)255) : ((byte)190, (byte)160, (byte)230, (byte)255));
        texture = texture with { Scale = (scale, 1), BumpFactor = 0.4 };
        var material = new Material("m") { Roughness = 0.5, Metalness = 0.3 };
        material = areHeights ? material with { BumpTexture = texture } : material with { NormalTexture = texture };
        foreach (var rotation in (Vector[])[Vector.Zero, new(20, 30, 40)])
        {
            var scene = RenderScenes.Scene(
                new() { Background = Colour.Black, Lights = [new DirectionalLight(new(-0.6, 0.4, 0.5), Colour.White, 0.4)] },
                (TexturedScenes.CreateSquare(1, material), new(new(0.02, 0.03, 0), rotation, Vector.One), null));
            var tracer = new PathTracer(scene, Near, 1, 1);
            tracer.AddSample();
            var (red, green, blue, _) = RenderScenes.Draw(scene, Near, Size, Size)[Size / 2, Size / 2];

            Assert.NotEqual(red, RenderScenes.Draw(
                RenderScenes.Scene(
                    scene.Scene with { Objects = [] },
                    (TexturedScenes.CreateSquare(1, material with { BumpTexture = null, NormalTexture = null }),
                        new(new(0.02, 0.03, 0), rotation, Vector.One), null)),
                Near, Size, Size)[Size / 2, Size / 2].Red);
            AssertClose(
                tracer.RadianceAt(0, 0), new Colour(red / 255.0, green / 255.0, blue / 255.0).ToLinearVector(), 0.03, $"{rotation}");
        }
    }

    private static void AssertClose(Vector expected, Vector found, double part, string text)
    {
        foreach (var (light, seen) in new[] { (expected.X, found.X), (expected.Y, found.Y), (expected.Z, found.Z) })
        {
            // Half a step of a byte of sRGB, which is at most 2.4/1.055 of a step of light.
            Assert.True(Math.Abs(seen - light) < (part * light) + 0.0045, $"{text}: {found} instead of {expected}");
        }
    }

    private static LoadedScene Scene(string name, double pitch, double yaw, Scene lights, bool isWhite)
    {
        var material = Surfaces[name];
        material = isWhite ? material with { Diffuse = Colour.White } : material;
        return RenderScenes.Scene(
            lights with { Background = Colour.Black },
            (TexturedScenes.WithMaterial(RenderScenes.Square(1), material), new(Vector.Zero, new(pitch, yaw, 0), Vector.One), null));
    }

    private static Vector Draw(string name, double pitch, double yaw, Scene lights, Shading shading, bool isWhite = false)
    {
        var image = RenderScenes.Draw(Scene(name, pitch, yaw, lights, isWhite), Near, Size, Size, new() { Shading = shading });
        var (red, green, blue, _) = image[Size / 2, Size / 2];
        return new Colour(red / 255.0, green / 255.0, blue / 255.0).ToLinearVector();
    }

    private static Vector Trace(string name, double pitch, double yaw, Scene lights, int samples) =>
        TracedMean.Of(Scene(name, pitch, yaw, lights, isWhite: false), Near, samples);
}
