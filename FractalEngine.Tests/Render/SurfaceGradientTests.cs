using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Render.Tracing;
using FractalEngine.Tests.Support;
using static System.FormattableString;

namespace FractalEngine.Tests.Render;

/// <summary>Palettes, roughness, metal and glow by gradients, beside surfaces of the same numbers as a material.</summary>
[Collection(GlTests.Name)]
public sealed class SurfaceGradientTests
{
    private const int Size = 9;

    private static readonly Palette Colours = Palette.OfEven(new Colour(0.9, 0.3, 0.2), new Colour(0.2, 0.5, 0.9), Colour.White);

    // The three of a set, by path: at 0, 1/4 and 1/2 of the gradient.
    private static readonly TransformationSet Row = new(
        [Samples.MoveAndScale(-3, 0, 0, 1), Samples.MoveAndScale(1, 0, 0, 1), Samples.MoveAndScale(5, 0, 0, 1)]);

    private static readonly Light[] Lights =
        [new DirectionalLight(new(0.25, -0.3, 1), Colour.White, 0.5), new AmbientLight(new(0.8, 0.9, 1), 0.2)];

    public static TheoryData<double?, double?, double?, double?, double?, double?> Ranges => new()
    {
        { null, null, null, null, null, null },
        { 0.3, 0.9, null, null, null, null },
        { 0.8, 0.2, 0, 1, null, null },
        { null, null, 1, 0.2, 0, 0.5 },
        { null, null, null, null, 0.6, 0.1 },
    };

    [SkippableTheory]
    [MemberData(nameof(Ranges))]
    public void Surfaces_OfAGradient_LookLikeTheirMaterials(
        double? roughness1, double? roughness2, double? metal1, double? metal2, double? glow1, double? glow2)
    {
        var gradient = Gradient.Of(GradientKind.Path, Colours) with
        {
            Roughness = RangeOf(roughness1, roughness2),
            Metalness = RangeOf(metal1, metal2),
            Glow = RangeOf(glow1, glow2),
        };
        var fractal = new FractalModel(new Fractal(new([Row]), RenderScenes.Square(1))) { SourcePath = "a.fdo" };
        var scene = new LoadedScene(
            new() { Background = Colour.Black, Lights = [.. Lights] },
            [new(new SceneObject("a.fdo", Transformation.Identity) { Colour = new(0, 1, 0), Gradient = gradient }, fractal)]);
        for (var i = 0; i < 3; i++)
        {
            var factor = i / 4.0;
            var linear = Colours.ColourAt(factor);
            var glow = gradient.Glow?.At(factor) ?? 0;
            var material = new Material("m")
            {
                Diffuse = new Colour(linear.X, linear.Y, linear.Z).FromLinear(), Roughness = gradient.Roughness?.At(factor),
                Metalness = gradient.Metalness?.At(factor), Emission = new(glow * linear.X, glow * linear.Y, glow * linear.Z),
            };
            var expected = RenderScenes.Scene(
                new() { Background = Colour.Black, Lights = [.. Lights] },
                (TexturedScenes.WithMaterial(RenderScenes.Square(1), material), RenderScenes.TranslatedTo((4 * i) - 3, 0, 0), null));
            var view = new View(new(new((4 * i) - 3, 0, -5), Vector.Zero, 60), Projection.Orthographic) { OrthographicHeight = 1e-3 };
            foreach (var shading in Enum.GetValues<Shading>())
            {
                Near.Equal(Draw(expected, view, shading), Draw(scene, view, shading), 0.006);
            }

            var traced = TracedMean.Of(scene, view, 64);
            Near.Equal(TracedMean.Of(expected, view, 64), traced, 0.01);
            Assert.True(traced.MaxAbsComponent() is > 0.02 and < 2, Invariant($"{i}: {traced}"));
        }
    }

    [SkippableFact]
    public void Frame_WithoutLevelsOfDetail_HasTheColourOfTheObject()
    {
        var fractal = new FractalModel(new Fractal(new([Row]), RenderScenes.Square(1))) { SourcePath = "a.fdo" };
        var view = new View(new(new(1, 0, -5), Vector.Zero, 60), Projection.Orthographic) { OrthographicHeight = 1e-3 };
        var plain = new SceneObject("a.fdo", Transformation.Identity) { Colour = new(0, 1, 0) };
        var graded = plain with { Gradient = Gradient.Of(GradientKind.Height, Colours) };
        var images = new[] { plain, graded }.Select(declared => RenderScenes.Draw(
            new(new() { Background = Colour.Black, Lights = [.. Lights] }, [new(declared, fractal)]), view, Size, Size,
            new() { Culling = null })[4, 4]).ToArray();
        Assert.Equal(images[0], images[1]);
    }

    private static GradientRange? RangeOf(double? first, double? last) => first is { } start && last is { } end ? new(start, end) : null;

    private static Vector Draw(LoadedScene scene, View view, Shading shading)
    {
        var (red, green, blue, _) = RenderScenes.Draw(scene, view, Size, Size, new() { Shading = shading })[Size / 2, Size / 2];
        return new Colour(red / 255.0, green / 255.0, blue / 255.0).ToLinearVector();
    }
}
