using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Colliders;

namespace FractalEngine.Tests.Render.Tracing;

/// <summary>Tests the denoiser on made-up light whose mean and noise are known, and on small scenes beside many more samples.</summary>
public class DenoiserTests
{
    private const int Size = 40;

    private static readonly ParallelOptions OneThread = new() { MaxDegreeOfParallelism = 1 };

    /// <summary>Light of a sample at a place of the image, in pixels; a random number from 0 to 2 makes its noise.</summary>
    private delegate (Vector Radiance, FirstHit First) Film(double x, double y, double noise);

    [Theory]
    [InlineData(0.3)]
    [InlineData(1e-7)]
    [InlineData(1e9)]
    public void Filter_WithoutVariance_IsTheIdentityToTheBit(double light)
    {
        var (raw, filtered) = Filter((_, _, _) => Wall(light, 0.7), 5);

        for (var i = 0; i < Size * Size; i++)
        {
            Assert.Equal(raw.At(i % Size, i / Size), filtered.At(i % Size, i / Size));
        }
    }

    [Fact]
    public void Filter_OfAnEdgeWithoutNoise_StaysWithinTheErrorOfSamples()
    {
        // Noise is only in how much of a pixel each side covers.
        Film film = (x, _, _) => x < 20.3 ? Wall(0.8, 0.5) : Wall(0.1, 0.5);
        var (raw, filtered) = Filter(film, 16);

        Assert.InRange(Error(filtered, film), 0, Error(raw, film));
        for (var y = 0; y < Size; y++)
        {
            // Pixels of the edge lie within reach, with a variance that covers the next ones.
            Assert.Equal(0.4, filtered.At(17, y).X, 0.005);
            Assert.Equal(raw.At(14, y), filtered.At(14, y));
            Assert.Equal(raw.At(25, y), filtered.At(25, y));
        }
    }

    [Theory]
    [InlineData("flat", 2.5)]
    [InlineData("gradient", 2.5)]
    [InlineData("edge of light", 1.5)]
    [InlineData("edge of albedo", 2.5)]
    [InlineData("edge of normals", 2.5)]
    [InlineData("texture", 2.5)]
    [InlineData("background", 2.5)]
    [InlineData("glow", 1.5)]
    public void Filter_OfNoise_ComesCloserToTheTruth(string kind, double factor)
    {
        Film film = kind switch
        {
            "flat" => static (_, _, noise) => Wall(0.5 * noise, 0.6),
            "gradient" => static (x, y, noise) => Wall((0.2 + (0.02 * x) + (0.01 * y)) * noise, 0.6),
            "edge of light" => static (x, y, noise) => Wall((x + (0.3 * y) < 25 ? 0.9 : 0.2) * noise, 0.6),
            "edge of albedo" => static (x, _, noise) => Wall(0.5 * noise, x < 20 ? 0.9 : 0.1),
            "edge of normals" => static (x, _, noise) =>
                x < 20 ? Wall(0.5 * noise, 0.6) : Wall(0.4 * noise, 0.6) with { First = Hit(0.6, Vector.I) },
            "texture" => static (x, _, noise) => Wall(0.5 * noise, 0.4 + (0.3 * Math.Sin(x))),
            "background" => static (x, _, noise) => x < 20 ? Wall(0.5 * noise, 0.6) : Sky(0.9),
            _ => static (x, _, noise) =>
            {
                var (radiance, first) = Wall(0.5 * noise, 0.6);
                var emitted = x < 20 ? 2 * Vector.One : Vector.Zero;
                return (radiance + emitted, first with { Emitted = emitted });
            }
            ,
        };
        var (raw, filtered) = Filter(film, 16);

        var (before, after) = (Error(raw, film), Error(filtered, film));
        Assert.True(before > factor * after, $"{kind}: {before / after:F2} times closer, expected {factor}");
        // What is averaged is not lost: the sum stays within two standard deviations of a mean of so many samples.
        Assert.Equal(1, Sum(filtered) / Sum(raw), 0.01);
    }

    [Fact]
    public void Filter_OfABackgroundBesideASurface_ChangesNothingBeyondTheEdge()
    {
        var (raw, filtered) = Filter(static (x, _, noise) => x < 20 ? Wall(noise, 0.6) : Sky(0.9), 8);

        for (var i = 0; i < Size * Size; i++)
        {
            if (i % Size > 21)
            {
                Assert.Equal(raw.At(i % Size, i / Size), filtered.At(i % Size, i / Size));
            }
        }
    }

    [Fact]
    public void Filter_OfHolesOfAPixel_KeepsThem()
    {
        // Dark holes in a lit wall, as wide as a pixel and five apart.
        Film film = static (x, y, noise) => Wall((x % 5 < 1 && y % 5 < 1 ? 0.05 : 0.8) * noise, 0.6);
        var (raw, filtered) = Filter(film, 32);

        Assert.True(Error(raw, film) > 1.5 * Error(filtered, film), $"{Error(raw, film)} before, {Error(filtered, film)} after");
        var (hole, wall) = (Means(filtered, 0), Means(filtered, 2));
        var (trueHole, trueWall) = (Means(raw, 0), Means(raw, 2));
        Assert.Equal(trueWall - trueHole, wall - hole, 0.05 * trueWall);

        static double Means(RadianceImage image, int offset) =>
            Enumerable.Range(0, 64).Average(i => image.At((5 * (i % 8)) + offset, (5 * (i / 8)) + offset).X);
    }

    [Fact]
    public void Filter_OfASingleFirefly_LeavesAllBeyondItsNeighbours()
    {
        var isFirst = true;
        Film film = (x, y, noise) =>
        {
            var isFirefly = isFirst && x > 20 && y > 20;
            isFirst &= !isFirefly;
            return Wall(isFirefly ? 1e6 : 0.4 + (0.2 * noise), 0.6);
        };
        var (raw, filtered) = Filter(film, 16);

        for (var i = 0; i < Size * Size; i++)
        {
            var (x, y) = (i % Size, i / Size);
            Assert.True(filtered.At(x, y).IsFinite());
            if (Math.Max(Math.Abs(x - 20), Math.Abs(y - 20)) > 7)
            {
                Assert.InRange(filtered.At(x, y).X, 0.24, 0.48);
            }
        }

        Assert.InRange(Sum(filtered), 0.2 * Sum(raw), 1.5 * Sum(raw));
    }

    [Theory]
    [InlineData(1e9)]
    [InlineData(1e15)]
    [InlineData(1e30)]
    [InlineData(1e300)]
    [InlineData(1e-300)]
    public void Filter_OfExtremeLight_IsFinite(double light)
    {
        foreach (var albedo in new[] { 0, 1e-12, 1 })
        {
            var (_, filtered) = Filter((x, y, noise) => Wall((x > y ? light : 1) * noise, albedo), 3);
            for (var i = 0; i < Size * Size; i++)
            {
                Assert.True(filtered.At(i % Size, i / Size).IsFinite(), $"{light} {albedo}: {filtered.At(i % Size, i / Size)}");
            }
        }
    }

    [Theory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void Denoise_OfASponge_IsCloserByDecibelsOnAnyNumberOfThreads(Projection projection)
    {
        var view = SpongeView with { Projection = projection };
        var truth = Trace(view, 256, seed: 2).ToImage();
        var tracer = Trace(view, 8, seed: 1);

        var (raw, denoised) = (tracer.ToImage(), tracer.Denoise(threads: 1));

        var gain = ImageError.PeakSignalToNoiseRatio(denoised, truth) - ImageError.PeakSignalToNoiseRatio(raw, truth);
        Assert.True(gain > 4, $"{gain:F2} dB");
        Assert.Equal(denoised.Pixels, tracer.Denoise(threads: 4).Pixels);
        Assert.Equal(denoised.Pixels, Trace(view, 8, seed: 1, threads: 3).Denoise().Pixels);
        Assert.Equal(raw.Pixels, Trace(view, 8, seed: 1, canDenoise: false).ToImage().Pixels);
    }

    [Fact]
    public void Denoise_AfterMoreSamples_IsNeverWorse() => CheckConvergence(64);

    [Fact]
    [Trait("Category", "Soak")]
    public void Denoise_AfterAThousandSamples_IsNeverWorse() => CheckConvergence(1024);

    private static void CheckConvergence(int maxCount)
    {
        var truth = Trace(SpongeView, 8 * maxCount, seed: 2).ToImage();
        var tracer = Trace(SpongeView, 1, seed: 1);
        for (var count = 1; count <= maxCount; count *= 2)
        {
            while (tracer.SampleCount < count)
            {
                tracer.AddSample();
            }

            var before = ImageError.PeakSignalToNoiseRatio(tracer.ToImage(), truth);
            var after = ImageError.PeakSignalToNoiseRatio(tracer.Denoise(), truth);
            Assert.True(after >= before, $"{before:F2} dB before, {after:F2} dB after {count} samples");
        }
    }

    [Fact]
    public void Denoise_WhereItCannot_IsTheImage()
    {
        var tracer = Trace(SpongeView, 3, seed: 1, canDenoise: false);
        Assert.Equal(tracer.ToImage().Pixels, tracer.Denoise().Pixels);
        Assert.True(Trace(SpongeView, 1, seed: 1).WithView(SpongeView, 8, 8).CanDenoise);
        Assert.Equal(new PathTracer(Sponge, SpongeView, 8, 8).ToImage().Pixels,
            new PathTracer(Sponge, SpongeView, 8, 8) { CanDenoise = true }.Denoise().Pixels);
    }

    [Fact]
    public void Denoise_OfALetterboxedImage_LeavesItsBars()
    {
        var view = SpongeView with { Aspect = 2 };
        var tracer = Trace(view, 4, seed: 1);

        var (raw, denoised) = (tracer.ToImage(), tracer.Denoise());

        var bars = Enumerable.Range(0, Size).Where(y => raw[0, y] == raw[0, 0] && y is < 5 or > Size - 5).ToArray();
        Assert.NotEmpty(bars);
        Assert.All(bars, y => Assert.Equal(raw[Size / 2, y], denoised[Size / 2, y]));
        var truth = Trace(view, 64, seed: 2).ToImage();
        var gain = ImageError.PeakSignalToNoiseRatio(denoised, truth) - ImageError.PeakSignalToNoiseRatio(raw, truth);
        Assert.True(gain > 3, $"{gain:F2} dB");
    }

    [Fact]
    public void Denoise_Cancelled_EndsWithoutAnImage()
    {
        var tracer = Trace(SpongeView, 2, seed: 1);
        Assert.Throws<OperationCanceledException>(() => tracer.Denoise(cancellation: new(canceled: true)));
    }

    private static LoadedScene Sponge { get; } = LoadedScene.Of(new()
    {
        Objects = [new SceneObject(AssetFractals.Load("menger", 3)) { Colour = new(1, 0.7, 0.3) }],
        Lights = [new AmbientLight(Colour.White, 0.6), new DirectionalLight(new(0.3, -0.8, 0.5), Colour.White, 1)],
    });

    private static View SpongeView { get; } = new(new(new(-0.98, 0.8, -1.5), new(-0.513, -0.517, 0.272), 50), Projection.Perspective);

    private static PathTracer Trace(View view, int count, int seed, bool canDenoise = true, int? threads = null)
    {
        var tracer = new PathTracer(Sponge, view, Size, Size, seed: seed) { CanDenoise = canDenoise };
        for (var i = 0; i < count; i++)
        {
            tracer.AddSample(threads);
        }

        return tracer;
    }

    private static FirstHit Hit(double albedo, Vector normal) => new(Vector.Zero, albedo * Vector.One, normal, 3);

    private static (Vector Radiance, FirstHit First) Wall(double light, double albedo) =>
        (light * albedo * Vector.One, Hit(albedo, Vector.K));

    private static (Vector Radiance, FirstHit First) Sky(double light) =>
        (light * Vector.One, new(light * Vector.One, Vector.Zero, Vector.Zero, 0));

    /// <summary>Takes samples as the path tracer does, and filters them. Rows of the lower half have one sample more.</summary>
    private static (RadianceImage Raw, RadianceImage Filtered) Filter(Film film, int count)
    {
        var raw = new RadianceImage(Size, Size);
        var shared = new SharedSamples(Size, Size, (0, 0, Size, Size));
        var random = new Random(7);
        for (var sample = 0; sample <= count; sample++)
        {
            for (var i = sample < count ? 0 : Size * Size / 2; i < Size * Size; i++)
            {
                var (u, v) = new SampleSequence(i, sample, 0).Next();
                var (across, down) = (TracedCamera.Tent(u), TracedCamera.Tent(v));
                var (radiance, first) = film((i % Size) + 0.5 + across, (i / Size) + 0.5 + down, 2 * random.NextDouble());
                raw.Add(i % Size, i / Size, radiance);
                shared.Add(i % Size, i / Size, sample, across, down, radiance, in first);
            }
        }

        for (var y = 0; y < Size; y++)
        {
            raw.RowSamples[y] = y < Size / 2 ? count : count + 1;
        }

        var filtered = new RadianceImage(Size, Size);
        new Denoiser(shared, raw).Filter(filtered, OneThread);
        return (raw, filtered);
    }

    /// <summary>Root of the mean square error to the light without noise, filtered by a tent.</summary>
    private static double Error(RadianceImage image, Film film)
    {
        const int steps = 12;
        var squares = 0.0;
        for (var i = 0; i < Size * Size; i++)
        {
            var mean = 0.0;
            for (var j = 0; j < steps * steps; j++)
            {
                var (across, down) = (TracedCamera.Tent(((j % steps) + 0.5) / steps), TracedCamera.Tent(((j / steps) + 0.5) / steps));
                mean += film((i % Size) + 0.5 + across, (i / Size) + 0.5 + down, 1).Radiance.X / (steps * steps);
            }

            var difference = image.At(i % Size, i / Size).X - mean;
            squares += difference * difference;
        }

        return Math.Sqrt(squares / (Size * Size));
    }

    private static double Sum(RadianceImage image) =>
        Enumerable.Range(0, Size * Size).Sum(i => image.At(i % Size, i / Size).X);
}
