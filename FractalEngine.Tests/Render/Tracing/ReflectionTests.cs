using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Tracing;

namespace FractalEngine.Tests.Render.Tracing;

/// <summary>What surfaces mirror and scatter, by directions that are chosen by chance, against integrals and closed forms.</summary>
public class ReflectionTests
{
    [Theory]
    [InlineData(0.02, 0)]
    [InlineData(0.02, 60)]
    [InlineData(0.1, 30)]
    [InlineData(0.3, 0)]
    [InlineData(0.3, 80)]
    [InlineData(0.6, 45)]
    [InlineData(1, 0)]
    [InlineData(1, 70)]
    public void TrySample_OfAnyRoughness_HasTheMeanOfTheIntegral(double roughness, double degreesFromNormal)
    {
        foreach (var (diffuse, specular) in ((double, double)[])[(0, 1), (0, 0.3), (0.6, 0.04), (0.3, 0.5), (0.8, 0)])
        {
            var surface = Surface(diffuse, specular, roughness);
            var toEye = Direction(degreesFromNormal);
            foreach (var weight in (Func<Vector, double>[])[static _ => 1, static d => d.X, static d => d.Z * d.Z])
            {
                var expected = Integrate(surface, toEye, weight);
                var found = MeanOfSamples(surface, toEye, weight);
                // The mean of 16,384 points that are spread evenly.
                Assert.True(
                    Math.Abs(found - expected) < 0.004, $"diffuse {diffuse}, specular {specular}: {found} instead of {expected}");
            }
        }
    }

    [Theory]
    [InlineData(0.02)]
    [InlineData(0.1)]
    [InlineData(0.3)]
    [InlineData(0.6)]
    [InlineData(1)]
    public void WhiteMirror_OfAnyRoughness_LosesWhatFacetsHide(double roughness)
    {
        // The furnace. Light between facets is left out, so that rough mirrors are darker.
        var surface = Surface(0, 1, roughness);
        foreach (var degrees in (double[])[0, 30, 60, 80])
        {
            var expected = AlbedoOfFacets(roughness, degrees);
            // Both quadratures have steps of a 400th and a 200th of a turn.
            Assert.Equal(expected, Integrate(surface, Direction(degrees), static _ => 1), 0.001);
            // The mean of 16,384 points that are spread evenly.
            Assert.Equal(expected, MeanOfSamples(surface, Direction(degrees), static _ => 1), 0.004);
        }
    }

    [Fact]
    public void Evaluate_WithEyeAndLightExchanged_IsTheSame()
    {
        var surface = Surface(0.4, 0.3, 0.5);
        var (one, other) = (Direction(20), new Matrix(new(0.6, 0.8, 0), new(-0.8, 0.6, 0), Vector.K) * Direction(65));

        Assert.Equal(
            Reflection.Evaluate(in surface, one, other).X / other.Z, Reflection.Evaluate(in surface, other, one).X / one.Z, 1e-12);
    }

    [Theory]
    [InlineData(0.2)]
    [InlineData(0.5)]
    [InlineData(1)]
    public void Metal_UnderAWhiteSky_ShowsTheIntegral(double roughness)
    {
        var scene = Floor(new("m") { Metalness = 1, Roughness = roughness, Diffuse = new(1, 0.5, 0) }, RenderScenes.FullLight);
        var alpha = roughness * roughness;

        var traced = Trace(scene, 1024);

        var red = Integrate(Surface(0, 1, alpha), Vector.K, static _ => 1);
        var green = Integrate(Surface(0, new Colour(0, 0.5, 0).ToLinearVector().Y, alpha), Vector.K, static _ => 1);
        var blue = Integrate(Surface(0, 0, alpha, isGlossy: true), Vector.K, static _ => 1);
        Assert.InRange((traced - new Vector(red, green, blue)).Length(), 0, 0.01);
    }

    [Fact]
    public void Metal_UnderLightFromTheEye_IsAsBrightAsItsFacetsAreDense()
    {
        const double Roughness = 0.5;
        var light = new DirectionalLight(new(0, 0, 1), Colour.White, 0.3);
        var scene = Floor(new("m") { Metalness = 1, Roughness = Roughness }, light);

        // Head-on, the density of the facets is 1/(πα²), and a facet sends light to an angle four times as wide.
        var alpha = Roughness * Roughness;
        Assert.Equal(0.3 / (4 * alpha * alpha), Trace(scene, 4).X, 1e-9);
    }

    [Theory]
    [InlineData(0, 1.0)]
    [InlineData(0.85, 1.0)]
    [InlineData(0.95, null)]
    [InlineData(1.05, 0.0)]
    public void SpotLight_OnAMattFloor_ShinesWithinItsCone(double partOfHalfAngle, double? strength)
    {
        // At a tenth of its range a light has its intensity. The cone has a soft edge over its outer tenth.
        const double HalfAngle = 20;
        var angle = partOfHalfAngle * HalfAngle * Math.PI / 180;
        var axis = new Vector(Math.Sin(angle), 0, Math.Cos(angle));
        var light = new SpotLight(new(0, 0, -2), axis, 2 * HalfAngle, Colour.White, 0.7, 20);
        var scene = Floor(new("m") { Diffuse = Colour.White }, light);

        var radiance = Trace(scene, 4).X;

        // Half way through the soft edge, by cosines.
        var (outer, inner) = (Math.Cos(HalfAngle * Math.PI / 180), Math.Cos(0.9 * HalfAngle * Math.PI / 180));
        var t = Math.Clamp((Math.Cos(angle) - outer) / (inner - outer), 0, 1);
        var expected = strength ?? (t * t * (3 - (2 * t)));
        Assert.Equal(0.7 * expected, radiance, 1e-4);
    }

    [Theory]
    [InlineData(0.8, 0, 1, 0)]
    [InlineData(0.8, 0, 1, 25)]
    [InlineData(0.4, 0.3, 0.4, 0)]
    [InlineData(0.4, 0.3, 0.6, 20)]
    [InlineData(0, 1, 0.5, 0)]
    public void Density_OverAllDirections_IsThatOfSamples(double diffuse, double specular, double roughness, double leanDegrees)
    {
        var surface = Surface(diffuse, specular, roughness) with { Normal = Direction(leanDegrees) };
        var toEye = Direction(-35);
        foreach (var weight in (Func<Vector, double>[])[static _ => 1, static d => d.X, static d => d.Z * d.Z])
        {
            var (expected, found) = (0.0, 0.0);
            const int Steps = 400;
            for (var i = 0; i < Steps * Steps; i++)
            {
                // Evenly over the sphere.
                var z = ((2.0 * (i / Steps)) + 1 - Steps) / Steps;
                var (sine, cosine) = Math.SinCos(2 * Math.PI * ((i % Steps) + 0.5) / Steps);
                var direction = new Vector(Math.Sqrt(1 - (z * z)) * cosine, Math.Sqrt(1 - (z * z)) * sine, z);
                expected += 4 * Math.PI / (Steps * Steps) * Reflection.Density(in surface, toEye, direction) * weight(direction);
            }

            const int Count = 1 << 17;
            for (var i = 0; i < Count; i++)
            {
                var samples = new SampleSequence(1, i, 1);
                var isReflected = Reflection.TrySample(in surface, toEye, ref samples, out var direction, out _, out _);
                found += isReflected ? weight(direction) / Count : 0;
            }

            // Three standard deviations of so many, if each were by itself.
            Assert.Equal(expected, found, 0.004);
        }
    }

    private static TracedSurface Surface(double diffuse, double specular, double roughness, bool isGlossy = false) => new(
        Vector.Zero, Vector.K, Vector.K, diffuse * Vector.One, isGlossy ? new(0, 0, 1e-300) : specular * Vector.One, roughness,
        Vector.Zero, 1);

    /// <summary>A direction beside the normal.</summary>
    private static Vector Direction(double degreesFromNormal)
    {
        var (sine, cosine) = Math.SinCos(degreesFromNormal * Math.PI / 180);
        return new(sine, 0, cosine);
    }

    /// <summary>The part of light that facets reflect once and out, where each reflects all.</summary>
    /// <remarks>Walter and others, equations 20, 33 and 34, over the facets: u = 1 − 1/(1 + tan²θ/α²) lean by less than θ.</remarks>
    private static double AlbedoOfFacets(double alpha, double degrees)
    {
        const int Steps = 400;
        var toEye = Direction(degrees);
        var sum = 0.0;
        for (var i = 0; i < Steps; i++)
        {
            var u = (i + 0.5) / Steps;
            var (sine, cosine) = Math.SinCos(Math.Atan(alpha * Math.Sqrt(u / (1 - u))));
            for (var j = 0; j < Steps; j++)
            {
                var (around, along) = Math.SinCos((j + 0.5) * 2 * Math.PI / Steps);
                var facet = new Vector(sine * along, sine * around, cosine);
                var seen = Vector.Dot(toEye, facet);
                var height = (2 * seen * cosine) - toEye.Z;
                sum += seen > 0 && height > 0 ? Visible(toEye.Z) * Visible(height) * seen / (toEye.Z * cosine) : 0;
            }
        }

        return sum / (Steps * Steps);

        double Visible(double cosine) => 2 / (1 + Math.Sqrt(1 + (alpha * alpha * ((1 / (cosine * cosine)) - 1))));
    }

    /// <summary>Integrates reflectance, cosine and a weight over all directions of the light.</summary>
    private static double Integrate(TracedSurface surface, Vector toEye, Func<Vector, double> weight)
    {
        // Over the facets between light and eye. They lean by an angle θ with tan θ = α t/(1 − t): as dense as a sharp highlight needs.
        const int Rings = 400;
        const int Spokes = 200;
        var alpha = surface.IsGlossy ? surface.Roughness : 1;
        var sum = 0.0;
        for (var ring = 0; ring < Rings; ring++)
        {
            var t = (ring + 0.5) / Rings;
            var theta = Math.Atan(alpha * t / (1 - t));
            var (sine, cosine) = Math.SinCos(theta);
            var width = alpha / ((1 - t) * (1 - t)) * cosine * cosine / Rings;
            for (var spoke = 0; spoke < Spokes; spoke++)
            {
                var (around, along) = Math.SinCos((spoke + 0.5) * 2 * Math.PI / Spokes);
                var half = new Vector(sine * along, sine * around, cosine);
                var cosineOfEye = Vector.Dot(toEye, half);
                if (cosineOfEye > 0)
                {
                    var toLight = (2 * cosineOfEye * half) - toEye;
                    var reflected = Reflection.Evaluate(in surface, toEye, toLight).X / Math.PI;
                    // A facet that leans by a little turns the light by four times the solid angle, over the cosine.
                    sum += reflected * weight(toLight) * 4 * cosineOfEye * sine * width * 2 * Math.PI / Spokes;
                }
            }
        }

        return sum;
    }

    private static double MeanOfSamples(TracedSurface surface, Vector toEye, Func<Vector, double> weight)
    {
        const int Count = 16_384;
        var sum = 0.0;
        for (var i = 0; i < Count; i++)
        {
            var samples = new SampleSequence(0, i, 1);
            if (Reflection.TrySample(in surface, toEye, ref samples, out var direction, out var factor, out _))
            {
                sum += factor.X * weight(direction);
            }
        }

        return sum / Count;
    }

    private static LoadedScene Floor(Material material, Light light) => RenderScenes.Scene(
        new Scene { Background = Colour.Black, Lights = [light] },
        (TexturedScenes.WithMaterial(RenderScenes.Square(1), material), Transformation.Identity, null));

    /// <summary>The radiance of the middle, seen from straight above.</summary>
    private static Vector Trace(LoadedScene scene, int samples)
    {
        var tracer = new PathTracer(scene, new(Camera.Default, Projection.Orthographic) { OrthographicHeight = 1e-6 }, 1, 1);
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample();
        }

        return tracer.RadianceAt(0, 0);
    }
}
