using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Mtl;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render.Tracing;

/// <summary>What a material, the object's colour, a texture and colours of vertices make of a traced surface.</summary>
[Collection(GlTests.Name)]
public sealed class TracedMaterialTests : IDisposable
{
    // The square of half size 1 fills the frame from edge to edge.
    private static readonly View Square = new(Camera.Default, Projection.Orthographic) { OrthographicHeight = 2 };

    private readonly TexturedScenes _scenes = new();

    public void Dispose() => _scenes.Dispose();

    [SkippableFact]
    public void Material_OfAnObjectWithAColour_IsTracedAsItIsDrawn()
    {
        var texture = _scenes.CreateTexture("even.png", 4, 4, (_, _) => (200, 180, 160, 255));
        var scene = Scene(TexturedScenes.CreateSquare(1, new("m") { Texture = texture, Diffuse = new(0.5, 1, 0.9) }), new(1, 0.5, 0.7));

        var drawn = RenderScenes.Draw(scene, Square, 20, 20)[10, 10];
        var traced = Trace(scene, 4).ToImage()[10, 10];

        // One step is the rounding from sRGB to light and back.
        Assert.InRange(traced.Red - drawn.Red, -1, 1);
        Assert.InRange(traced.Green - drawn.Green, -1, 1);
        Assert.InRange(traced.Blue - drawn.Blue, -1, 1);
    }

    [Fact]
    public void Metal_ThatIsTexturedAndTinted_MirrorsInThatColour()
    {
        var texture = _scenes.CreateTexture("even.png", 4, 4, (_, _) => (200, 180, 160, 255));
        var material = new Material("m") { Texture = texture, Diffuse = new(0.5, 1, 0.9), Metalness = 1, Roughness = 0.1 };
        var vertexColour = new Colour(1, 0.6, 1);
        var mesh = TexturedScenes.TexturedSquare(1).WithColours(
            [.. Enumerable.Repeat((double[])[vertexColour.Red, vertexColour.Green, vertexColour.Blue], 4).SelectMany(c => c)]);
        var tint = new Colour(1, 0.5, 0.7);

        var traced = Trace(Scene(TexturedScenes.WithMaterial(mesh, material), tint), 16).RadianceAt(10, 10);

        // A metal sends back its colour of what falls straight onto it, under white light from all around.
        var expected = new[] { material.Diffuse, tint, vertexColour, new Colour(200 / 255.0, 180 / 255.0, 160 / 255.0) }
            .Aggregate(Vector.One, static (product, colour) => product.Stretch(colour.ToLinearVector()));
        Assert.InRange((traced - expected).Length(), 0, 0.005);
    }

    public static TheoryData<string> Extremes =>
    [
        "Kd -1", "Kd 5", "Kd 1e308", "Ks -1", "Ks 5", "Ks 1e308", "Ke -1", "Ke 1e308", "Ns -1", "Ns 1e308", "Pm -3", "Pm 5", "Pm 1e308",
        "Pr -1", "Pr 5", "Pr 1e200", "Kd 5\nPm 1", "Ks 5\nNs 1e308", "Kd 1\nPm 1\nPr 0", "Kd -1\nPm 0.5\nKe 1e308",
    ];

    [Theory]
    [MemberData(nameof(Extremes))]
    public void Material_WithNumbersBeyondTheirRange_GivesLightThatIsNeitherNegativeNorEndless(string statements)
    {
        var material = MtlParser.Parse(new("a.mtl", $"newmtl m\n{statements}\n")).Materials["m"];
        // A single path that is mirrored by chance counts for as many as 25. What glows is bright.
        var maxRadiance = material.Emission == Colour.Black ? 25 : 1.0001e9;
        var sphere = TexturedScenes.WithMaterial(RenderScenes.Sphere(6), material);

        var tracer = Trace(Scene(sphere, null), 4);

        for (var i = 0; i < 20 * 20; i++)
        {
            var (red, green, blue) = tracer.RadianceAt(i % 20, i / 20);
            Assert.InRange(Math.Min(red, Math.Min(green, blue)), 0, maxRadiance);
            Assert.InRange(Math.Max(red, Math.Max(green, blue)), 0, maxRadiance);
        }
    }

    [Fact]
    public void Texture_ScaledBeyondTheRangeOfNumbers_HasAColour()
    {
        var texture = _scenes.CreateTexture("even.png", 4, 4, (_, _) => (255, 255, 255, 255)) with { Scale = (1e308, 1e308) };
        var mesh = RenderScenes.Square(1).WithTextureCoordinates([0, 0, 9, 0, 0, 9, 9, 9], [0, 2, 1, 1, 2, 3]);
        var scene = Scene(TexturedScenes.WithMaterial(mesh, new("m") { Texture = texture }), null);

        Assert.Equal(1, Trace(scene, 1).RadianceAt(15, 15).X, 1e-6);
    }

    [Fact]
    public void NormalMap_OfManyMaterials_IsDecodedOnceAndReportedOnce()
    {
        var texture = _scenes.CreateTexture("even.png", 2, 2, (_, _) => (128, 128, 255, 255));
        var broken = _scenes.CreateBrokenTexture("broken.png");
        var notices = ImmutableArray.CreateBuilder<string>();
        var textures = new TextureCache(notices, shareTextures: true, []);

        Assert.Same(
            textures.GetMaterial(new("a") { NormalTexture = texture }).Detail!.Image,
            textures.GetMaterial(new("b") { BumpTexture = texture }).Detail!.Image);
        var scene = RenderScenes.Scene(
            new Scene(),
            (TexturedScenes.CreateSquare(1, new("a") { NormalTexture = broken }), Transformation.Identity, null),
            (TexturedScenes.CreateSquare(1, new("b") { BumpTexture = broken }), Transformation.Identity, null));
        Assert.StartsWith(
            $"{broken.Path}:1:1: warning: the texture can't be decoded, shown without it: ",
            Assert.Single(new PathTracer(scene, Square, 1, 1).Notices), StringComparison.Ordinal);
    }

    [Fact]
    public void Texture_OfASceneWhoseObjectsMove_IsNotDecodedAgain()
    {
        var texture = _scenes.CreateTexture("even.png", 2, 2, (_, _) => (200, 200, 200, 255));
        var model = TexturedScenes.CreateSquare(1, new("m") { Texture = texture });
        var tracer = Trace(Scene(model, null), 1);
        File.Delete(texture.Path);

        var moved = tracer.WithScene(Scene(model, new(1, 0.5, 1)), Square, 20, 20);
        moved.AddSample();

        Assert.Empty(moved.Notices);
        var before = tracer.RadianceAt(10, 10);
        var expected = before with { Y = before.Y * new Colour(0, 0.5, 0).ToLinearVector().Y };
        Assert.InRange((moved.RadianceAt(10, 10) - expected).Length(), 0, 1e-9);
    }

    private static LoadedScene Scene(Model model, Colour? colour) => RenderScenes.Scene(
        new Scene { Background = Colour.Black, Lights = [RenderScenes.FullLight] }, (model, Transformation.Identity, colour));

    private static PathTracer Trace(LoadedScene scene, int samples)
    {
        var tracer = new PathTracer(scene, Square, 20, 20);
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample();
        }

        return tracer;
    }
}
