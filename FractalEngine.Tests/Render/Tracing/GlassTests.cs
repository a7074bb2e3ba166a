using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Mtl;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render.Tracing;

/// <summary>Solids that refract light, against closed forms.</summary>
public class GlassTests
{
    private static readonly Colour Grey = new(0.7, 0.7, 0.7);

    [Theory]
    [InlineData(0)]
    [InlineData(0.2)]
    [InlineData(0.4)]
    [InlineData(0.6)]
    [InlineData(0.8)]
    [InlineData(1)]
    public void ClearBall_UnderAnEvenSky_CanNotBeSeen(double roughness)
    {
        // The furnace: what comes from the sky leaves to the sky.
        var tracer = Trace(Clear with { Roughness = roughness }, RenderScenes.Sphere(24), EvenSky, 20, 64);
        // Few paths go around within the ball along its surface, and end after 64 facets.
        AssertLight(tracer, 0.995, 1.000001);
    }

    [Fact]
    public void MilkyBall_OfWhiteUnderAnEvenSky_CanNotBeSeen()
    {
        var tracer = Trace(Clear with { Opacity = 0.3, Diffuse = Colour.White }, RenderScenes.Sphere(24), EvenSky, 20, 128);
        // Paths within end after a number of reflections.
        AssertLight(tracer, 0.93, 1.002);
    }

    [Fact]
    public void ColouredSlab_SeenStraight_AbsorbsByTheWayInIt()
    {
        // A cube of edge 2, seen along its axis: mirrored at the first face; through, with two reflections within; and so on.
        var found = TracedMean.Of(
            Scene(Clear with { Transmission = new(0.8, 0.5, 1) }, RenderScenes.Cube(1), EvenSky), Straight, 10_000);
        var reflected = Math.Pow(0.5 / 2.5, 2);
        foreach (var (transmission, light) in ((double, double)[])[(0.64, found.X), (0.25, found.Y), (1, found.Z)])
        {
            // The sums of a geometric series.
            var twice = Math.Pow(1 - reflected, 2) * transmission / (1 - Math.Pow(reflected * transmission, 2));
            var (passed, returned) = (twice, reflected + (twice * reflected * transmission));
            Assert.Equal((passed + returned) * Grey.ToLinearVector().X, light, 0.006);
        }
    }

    [Theory]
    [InlineData(0)]
    [InlineData(30)]
    [InlineData(56.309932474020215)]
    [InlineData(80)]
    public void Sample_OfASmoothSurface_FollowsSnellAndFresnel(double degrees)
    {
        foreach (var isInside in (bool[])[false, true])
        {
            var (sine, cosine) = Math.SinCos(degrees * Math.PI / 180);
            var surface = Surface() with { IsInside = isInside };
            var glass = new Glass(1.5, 0, Vector.Zero);
            var index = isInside ? 1 / 1.5 : 1.5;
            var refracted = 0;
            const int Count = 20_000;
            for (var i = 0; i < Count; i++)
            {
                var samples = new SampleSequence(0, i, 1);
                var direction = glass.Sample(in surface, new(sine, 0, cosine), ref samples, out var isRefracted);
                refracted += isRefracted ? 1 : 0;
                Assert.Equal(isRefracted ? -sine / index : -sine, direction.X, 1e-12);
                Assert.Equal(1, direction.Length(), 1e-12);
                Assert.Equal(isRefracted, direction.Z < 0);
            }

            Assert.Equal(1 - Fresnel(sine, cosine, index), refracted / (double)Count, 0.002);
        }
    }

    [Fact]
    public void Pane_OfGlassThatIsNoSolid_DoesNotRefract()
    {
        var scene = Scene(Clear, RenderScenes.Square(1), new() { Background = Colour.Black, Lights = [RenderScenes.FullLight] });
        var tracer = new PathTracer(scene, Straight, 1, 1);
        tracer.AddSample();

        Assert.Equal(0, tracer.RadianceAt(0, 0).X);
    }

    [Fact]
    public void Statements_OfGlass_AreReadAndWritten()
    {
        var material = MtlParser.Parse(new("a.mtl", "newmtl m\nNi 1.33\nTf 0.5 0.75 1\nd 0.1\n")).Materials["m"];

        Assert.Equal(new Material("m") { RefractiveIndex = 1.33, Transmission = new(0.5, 0.75, 1), Opacity = 0.1 }, material);
        Assert.True(material.IsGlass);
        Assert.Equal(material, MtlParser.Parse(new("b.mtl", MtlWriter.Write([material], "b.mtl"))).Materials["m"]);
    }

    private static Material Clear => new("m") { RefractiveIndex = 1.5, Opacity = 0 };

    private static Scene EvenSky => new() { Sky = new ColourSky(Grey, Grey, Grey) };

    private static View Straight => new(Camera.Default, Projection.Orthographic) { OrthographicHeight = 1e-6 };

    private static TracedSurface Surface() =>
        new(Vector.Zero, Vector.K, Vector.K, Vector.One, null, Vector.Zero, 0);

    /// <summary>Tests the mean light of an image of 20 × 20 pixels, and that of its brightest pixel, in units of the sky's.</summary>
    private static void AssertLight(PathTracer tracer, double minMean, double max)
    {
        var lights = Enumerable.Range(0, 400).Select(i => tracer.RadianceAt(i % 20, i / 20).X / Grey.ToLinearVector().X).ToArray();
        Assert.InRange(lights.Average(), minMean, max);
        Assert.InRange(lights.Max(), minMean, max);
    }

    /// <summary>The reflectance by the angles of both rays (Fresnel), which are not those of the product.</summary>
    private static double Fresnel(double sine, double cosine, double index)
    {
        if (sine / index >= 1)
        {
            return 1;
        }

        var (before, beyond) = (Math.Atan2(sine, cosine), Math.Asin(sine / index));
        return before == 0 ? Math.Pow((index - 1) / (index + 1), 2)
            : 0.5 * (Math.Pow(Math.Sin(before - beyond) / Math.Sin(before + beyond), 2)
                + Math.Pow(Math.Tan(before - beyond) / Math.Tan(before + beyond), 2));
    }

    private static LoadedScene Scene(Material material, Mesh mesh, Scene lights) =>
        RenderScenes.Scene(lights, (TexturedScenes.WithMaterial(mesh, material), Transformation.Identity, null));

    private static PathTracer Trace(Material material, Mesh mesh, Scene lights, int size, int samples)
    {
        var view = new View(Camera.Default, Projection.Orthographic) { OrthographicHeight = 2.5 };
        var tracer = new PathTracer(Scene(material, mesh, lights), view, size, size);
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample();
        }

        return tracer;
    }
}
