using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Tracing;

namespace FractalEngine.Tests.Render.Tracing;

/// <summary>What surfaces mirror and scatter, by directions that are chosen by chance, against integrals and closed forms.</summary>
public class ReflectionTests
{
    private const int CellCount = 96;

    private static readonly double[] Roughnesses = [0.02, 0.1, 0.25, 0.5, 0.75, 1];

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

    [Fact]
    public void FacetAlbedo_OfAnyRoughnessAndAngle_IsTheIntegral()
    {
        foreach (var roughness in (double[])[0.02, 0.1, 0.33, 1])
        {
            foreach (var degrees in (double[])[0, 30, 80])
            {
                var cosine = Math.Cos(degrees * Math.PI / 180);
                Assert.Equal(AlbedoOfFacets(roughness, degrees), FacetAlbedo.At(cosine, roughness).White, 0.0015);
            }
        }
    }

    // Metal, glossy paint, paint that mirrors much, half metals, and matt paint under a coat without a reflection of its own.
    public static TheoryData<double, double> WhiteMixtures => new()
    {
        { 0, 0.3 }, { 0, 1 }, { 0.04, 0 }, { 0.04, 0.3 }, { 0.04, 1 }, { 0.5, 0 }, { 0.5, 0.3 }, { 1, 0 },
    };

    [Theory]
    [MemberData(nameof(WhiteMixtures))]
    public void WhiteSurface_OfAnyMixtureAndRoughness_ReturnsAllLight(double coat, double metalness)
    {
        // The furnace.
        foreach (var roughness in Roughnesses)
        {
            var surface = Surface(1, coat, roughness, metalness);
            foreach (var degrees in (double[])[0, 30, 60, 80, 87])
            {
                var toEye = Direction(degrees);
                var text = $"roughness {roughness}, {degrees} degrees";
                // The quadrature has steps of a 400th and a 200th of a turn, too few at grazing angles.
                var integral = degrees > 80 ? 1 : Integrate(surface, toEye, static _ => 1);
                Assert.True(Math.Abs(integral - 1) < 0.002, $"{text}: {integral}");
                // The mean of 16,384 points that are spread evenly.
                var mean = MeanOfSamples(surface, toEye, static _ => 1);
                Assert.True(Math.Abs(mean - 1) < (degrees > 80 ? 0.008 : 0.004), $"{text}: {mean}");
            }
        }
    }

    [Theory]
    [MemberData(nameof(WhiteMixtures))]
    public void WhiteSurface_WhoseNormalLeansAwayFromTheFace_ReturnsAllLight(double coat, double metalness)
    {
        var lean = new Vector(-0.4, 0.2, 0.9).UnitVector();
        foreach (var roughness in Roughnesses)
        {
            var surface = Surface(1, coat, roughness, metalness) with { FaceNormal = lean };
            Assert.Equal(1, MeanOfSamples(surface, Direction(50), static _ => 1), 0.004);
        }
    }

    [Theory]
    [InlineData(0.02, 68)]
    [InlineData(0.1, 30)]
    [InlineData(0.3, 0)]
    [InlineData(0.3, 80)]
    [InlineData(1, 45)]
    public void TrySample_OfAnyRoughness_ChoosesDirectionsByTheirDensity(double roughness, double degreesFromNormal)
    {
        // A sharp highlight is in the middle of a cell.
        var (sine, cosine) = Math.SinCos(15 * Math.PI / 180);
        var toEye = new Matrix(new(cosine, sine, 0), new(-sine, cosine, 0), Vector.K) * Direction(degreesFromNormal);
        foreach (var faceNormal in (Vector[])[Vector.K, new Vector(-0.4, 0.2, 0.9).UnitVector()])
        {
            var surface = Surface(0.6, 0.3, roughness, 0.2) with { FaceNormal = faceNormal };
            var (counts, expected) = (new double[CellCount], new double[CellCount]);
            const int Count = 100_000;
            var random = new Random(5);
            for (var i = 0; i < Count; i++)
            {
                // Independent: points that are spread evenly agree too well.
                var samples = new SampleSequence(i, random.Next(), 1);
                if (Reflection.TrySample(in surface, toEye, ref samples, out var direction, out _, out _))
                {
                    counts[Cell(direction)]++;
                }
            }

            // By facets, as the highlight is small: over the directions that they reflect to.
            SumOverFacets(roughness, toEye, (toLight, solidAngle) =>
                expected[Cell(toLight)] += Count * solidAngle * Reflection.Density(in surface, toEye, toLight), 3000, 240);
            var chiSquared = Enumerable.Range(0, CellCount).Where(cell => expected[cell] > 5)
                .Sum(cell => Math.Pow(counts[cell] - expected[cell], 2) / expected[cell]);
            // 95 cells at most: 1 of 10,000 right samplers is beyond.
            Assert.InRange(chiSquared, 0, 154);
            Assert.InRange(counts.Where((_, cell) => expected[cell] <= 5).Sum(), 0, 100);
        }
    }

    [Fact]
    public void Evaluate_WithEyeAndLightExchanged_IsTheSame()
    {
        foreach (var (roughness, metalness) in ((double, double)[])[(0.02, 0), (0.5, 0), (0.5, 0.6), (1, 1)])
        {
            var surface = Surface(0.4, 0.3, roughness, metalness);
            var (one, other) = (Direction(20), new Matrix(new(0.6, 0.8, 0), new(-0.8, 0.6, 0), Vector.K) * Direction(65));

            Assert.Equal(
                Reflection.Evaluate(in surface, one, other).X / other.Z, Reflection.Evaluate(in surface, other, one).X / one.Z, 1e-12);
        }
    }

    [Theory]
    [InlineData(0.2)]
    [InlineData(0.5)]
    [InlineData(1)]
    public void Metal_UnderAWhiteSky_ShowsTheIntegral(double roughness)
    {
        var scene = Floor(new("m") { Metalness = 1, Roughness = roughness, Diffuse = new(1, 0.5, 0) }, RenderScenes.FullLight);
        var alpha = roughness * roughness;

        var traced = Trace(scene, 16_384);

        var green = Integrate(Surface(new Colour(0, 0.5, 0).ToLinearVector().Y, 0, alpha, 1), Vector.K, static _ => 1);
        var blue = Integrate(Surface(0, 0, alpha, 1), Vector.K, static _ => 1);
        Assert.InRange((traced - new Vector(1, green, blue)).Length(), 0, 0.01);
    }

    [Fact]
    public void Metal_UnderLightFromTheEye_IsAsBrightAsItsFacetsAreDense()
    {
        const double Roughness = 0.5;
        var light = new DirectionalLight(new(0, 0, 1), Colour.White, 0.3);
        var scene = Floor(new("m") { Metalness = 1, Roughness = Roughness }, light);

        // Head-on, the density of the facets is 1/(πα²), and a facet sends light to an angle four times as wide. What facets don't send out
        // at once, (1 − a)² of the light from here to there, they scatter by the mean of 1 − a.
        var alpha = Roughness * Roughness;
        var rest = Enumerable.Range(0, 100).Sum(
            i => (i + 0.5) / 5000 * (1 - AlbedoOfFacets(alpha, Math.Acos((i + 0.5) / 100) * 180 / Math.PI)));
        var several = Math.Pow(1 - AlbedoOfFacets(alpha, 0), 2) / rest;
        Assert.Equal(0.3 * ((1 / (4 * alpha * alpha)) + several), Trace(scene, 4).X, 1e-3);
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

    private static TracedSurface Surface(double colour, double coat, double roughness, double metalness = 0) => new(
        Vector.Zero, Vector.K, Vector.K, colour * Vector.One,
        coat == 0 && metalness == 0 ? null : new(coat * Vector.One, metalness, roughness), Vector.Zero, 1);

    /// <summary>One of 8 by 12 parts of the sphere.</summary>
    private static int Cell(Vector direction) =>
        (Math.Min((int)(4 * (direction.Z + 1)), 7) * 12)
        + Math.Min((int)(((Math.Atan2(direction.Y, direction.X) / Math.Tau) + 0.5) * 12), 11);

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
        var sum = 0.0;
        SumOverFacets(surface.Gloss?.Roughness ?? 1, toEye, (toLight, solidAngle) =>
            sum += Reflection.Evaluate(in surface, toEye, toLight).X / Math.PI * weight(toLight) * solidAngle);
        return sum;
    }

    /// <summary>Takes all directions of the light, each with its solid angle.</summary>
    private static void SumOverFacets(double alpha, Vector toEye, Action<Vector, double> add, int rings = 400, int spokes = 200)
    {
        // Over the facets between light and eye. They lean by an angle θ with tan θ = α t/(1 − t): as dense as a sharp highlight needs.
        for (var ring = 0; ring < rings; ring++)
        {
            var t = (ring + 0.5) / rings;
            var theta = Math.Atan(alpha * t / (1 - t));
            var (sine, cosine) = Math.SinCos(theta);
            var width = alpha / ((1 - t) * (1 - t)) * cosine * cosine / rings;
            for (var spoke = 0; spoke < spokes; spoke++)
            {
                var (around, along) = Math.SinCos((spoke + 0.5) * 2 * Math.PI / spokes);
                var half = new Vector(sine * along, sine * around, cosine);
                var cosineOfEye = Vector.Dot(toEye, half);
                if (cosineOfEye > 0)
                {
                    // A facet that leans by a little turns the light by four times the solid angle, over the cosine.
                    add((2 * cosineOfEye * half) - toEye, 4 * cosineOfEye * sine * width * 2 * Math.PI / spokes);
                }
            }
        }
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
    private static Vector Trace(LoadedScene scene, int samples) =>
        TracedMean.Of(scene, new(Camera.Default, Projection.Orthographic) { OrthographicHeight = 1e-6 }, samples);
}
