using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Tests.Scenes.Lights;

/// <summary>Images of the sky: how they are turned, looked up, chosen from, and what light they give.</summary>
public sealed class SkyImageTests
{
    [Theory]
    [InlineData(Handedness.Left, 0, 0, 0, 1)]
    [InlineData(Handedness.Left, 90, -1, 0, 0)]
    [InlineData(Handedness.Right, 0, 0, 0, -1)]
    [InlineData(Handedness.Right, 90, 1, 0, 0)]
    [InlineData(Handedness.Left, -45, 1, 0, 1)]
    public void Middle_OfATurnedImage_IsWhereAnObjectWouldTurnIt(Handedness handedness, double turn, double x, double y, double z)
    {
        var sky = new ImageSky("spots.hdr", turn, 2) { Image = new(Spots(64, 32, (31, 15), (32, 15), (31, 16), (32, 16))) };
        var radiance = (ImageRadiance)sky.ToRadiance(handedness);
        var ahead = handedness.Mirror(Vector.K);
        var rotated = new Transformation(Vector.Zero, new(0, turn, 0), Vector.One).ToAffineMap().Linear * ahead;

        Assert.Equal(0, (new Vector(x, y, z).UnitVector() - rotated).Length(), 1e-12);
        Assert.Equal(0, (radiance.DirectionOf(0.5, 0.5) - rotated).Length(), 1e-12);
        Assert.Equal(new Vector(2, 2, 2), radiance.At(rotated));
        Assert.Equal(Vector.Zero, radiance.At(-rotated));
    }

    [Theory]
    [InlineData(Handedness.Left)]
    [InlineData(Handedness.Right)]
    public void RightQuarter_OfAnImage_IsAtTheRightOfTheCamera(Handedness handedness)
    {
        var radiance = (ImageRadiance)new ImageSky("a.hdr") { Image = new(Spots(64, 32)) }.ToRadiance(handedness);
        Assert.Equal(0, (radiance.DirectionOf(0.75, 0.5) - Vector.I).Length(), 1e-12);
        Assert.Equal(0, (radiance.DirectionOf(0.3, 0) - Vector.J).Length(), 1e-12);
        var random = new Random(1);
        for (var i = 0; i < 100; i++)
        {
            var (u, v) = (random.NextDouble(), random.NextDouble());
            var (foundU, foundV) = radiance.PlaceOf(radiance.DirectionOf(u, v));
            Assert.Equal((u, v), (Math.Round(foundU, 9), Math.Round(foundV, 9)), Near);
        }

        static bool Near((double, double) a, (double, double) b) => Math.Abs(a.Item1 - b.Item1) + Math.Abs(a.Item2 - b.Item2) < 1e-8;
    }

    /// <summary>Eight places just above it, of a fiftieth of a steradian each, hold less than a quarter of ground.</summary>
    [Fact]
    public void Horizon_OfABrightSkyOverDarkGround_IsThatOfTheSky()
    {
        var image = new FloatImage(64, 32, [.. Enumerable.Range(0, 64 * 32 * 3).Select(static i => i < 64 * 16 * 3 ? 1f : 0)]);
        Assert.InRange(new SkyImage(image).Horizon.Y, 0.75, 1);
    }

    [Theory]
    [InlineData(16, 8)]
    [InlineData(37, 11)]
    [InlineData(1, 1)]
    public void Density_OfAllDirections_SumsToOne_AndIsInProportionToTheMeanOfWhatIsLookedUp(int width, int height)
    {
        var image = RandomImage(width, height);
        var distribution = new SkyDistribution(image);
        var sky = new SkyImage(image);
        var (sum, light) = (0.0, 0.0);
        const int Points = 8;
        var means = new List<(double Density, double Mean)>();
        for (var row = 0; row < height; row++)
        {
            // Exact solid angle of the zone between two parallels, by Archimedes.
            var zone = 2 * Math.PI * (Math.Cos(Math.PI * row / height) - Math.Cos(Math.PI * (row + 1) / height)) / width;
            for (var column = 0; column < width; column++)
            {
                var mean = 0.0;
                for (var i = 0; i < Points * Points; i++)
                {
                    mean += Luminance(sky.At(
                        (column + (((i % Points) + 0.5) / Points)) / width,
                        (row + (((i / Points) + 0.5) / Points)) / height)) / (Points * Points);
                }

                var density = distribution.Density((column + 0.5) / width, (row + 0.5) / height);
                sum += density * zone;
                light += mean * zone;
                means.Add((density, mean));
            }
        }

        Assert.Equal(1, sum, 1e-12);
        Assert.All(means, pixel => Assert.Equal(pixel.Mean / light, pixel.Density, 1e-9 / light * pixel.Mean + 1e-12));
    }

    [Fact]
    public void Sample_OfManyPoints_HasTheDensity()
    {
        var image = RandomImage(24, 12);
        var distribution = new SkyDistribution(image);
        const int Count = 200_000;
        var random = new Random(7);
        var found = new int[12, 24];
        for (var i = 0; i < Count; i++)
        {
            var (u, v) = distribution.Sample((random.NextDouble(), random.NextDouble()));
            found[Math.Min((int)(v * 12), 11), Math.Min((int)(u * 24), 23)]++;
        }

        var (chiSquared, cells) = (0.0, 0);
        for (var row = 0; row < 12; row++)
        {
            var zone = 2 * Math.PI * (Math.Cos(Math.PI * row / 12) - Math.Cos(Math.PI * (row + 1) / 12)) / 24;
            for (var column = 0; column < 24; column++)
            {
                var expected = Count * zone * distribution.Density((column + 0.5) / 24, (row + 0.5) / 12);
                if (expected > 5)
                {
                    chiSquared += Math.Pow(found[row, column] - expected, 2) / expected;
                    cells++;
                }
            }
        }

        // About five standard deviations of a distribution of so many degrees of freedom.
        Assert.InRange(chiSquared, cells - (5 * Math.Sqrt(2 * cells)), cells + (5 * Math.Sqrt(2 * cells)));
    }

    [Fact]
    public void Sample_WithinAPixel_TakesEachSolidAngleAlike()
    {
        // At the pole, a row is a disc: half of it lies within 1/√2 of the angle.
        var distribution = new SkyDistribution(new(1, 2, [1, 1, 1, 1, 1, 1]));
        var count = Enumerable.Range(0, 1000).Count(i => distribution.Sample((0.3, (i + 0.5) / 2000)).V < 1.0 / 3);
        // The cosine of 60 degrees is a half.
        Assert.InRange(count, 499, 501);
    }

    [Fact]
    public void Sample_OfExtremes_StaysWithinTheBrightPixels()
    {
        var distribution = new SkyDistribution(Spots(16, 8, (0, 0), (15, 7), (4, 3)));
        foreach (var u in (double[])[0, 1e-12, 0.5, 1 - 1e-16])
        {
            foreach (var v in (double[])[0, 1e-12, 0.5, 1 - 1e-16])
            {
                var place = distribution.Sample((u, v));
                Assert.True(distribution.Density(place.U, place.V) > 0, $"{u}, {v}: {place}");
            }
        }

        Assert.True(new SkyDistribution(new(2, 1, new float[6])).IsEmpty);
    }

    [Fact]
    public void Irradiance_OfHarmonicsOfTheSecondDegree_IsExact()
    {
        // Radiance that is a polynomial of the second degree: its irradiance is known term by term, by factors 1, 2/3, 1/4.
        const int Height = 256;
        var image = new FloatImage(2 * Height, Height, new float[3 * 2 * Height * Height]);
        var place = new ImageRadiance(new(Spots(2, 1)), 30, 1, Handedness.Right);
        for (var y = 0; y < Height; y++)
        {
            for (var x = 0; x < 2 * Height; x++)
            {
                var (a, b, c) = place.DirectionOf((x + 0.5) / (2 * Height), (y + 0.5) / Height);
                image[x, y] = new(
                    2 + (0.3 * a) - (0.4 * c), 2 + (0.5 * b) + (0.6 * ((b * b) - (1.0 / 3))),
                    2 + (a * b) - (b * c) + (a * c) + (a * a) - (c * c));
            }
        }

        var (constant, linear, quadratic, sides) = new ImageRadiance(new(image), 30, 1, Handedness.Right).Irradiance();
        var random = new Random(5);
        for (var i = 0; i < 50; i++)
        {
            var n = new Vector(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5).UnitVector();
            var (x, y, z) = n;
            var expected = new Vector(
                2 + (2.0 / 3 * ((0.3 * x) - (0.4 * z))), 2 + (2.0 / 3 * 0.5 * y) + (0.6 / 4 * ((y * y) - (1.0 / 3))),
                2 + (((x * y) - (y * z) + (x * z) + (x * x) - (z * z)) / 4));
            var found = constant + (y * linear) + (y * y * quadratic) + (x * sides[0]) + (z * sides[1]) + (x * y * sides[2])
                + (y * z * sides[3]) + (x * z * sides[4]) + (((x * x) - (z * z)) * sides[5]);
            // Pixels stand for the directions in their middle.
            Assert.Equal(0, (found - expected).Length(), 2e-4);
        }
    }

    [Fact]
    public void Levels_OfAnImage_KeepItsLight()
    {
        var image = new SkyImage(RandomImage(64, 16));
        var expected = Power(image.Levels[0]);
        Assert.Equal((1, 1), (image.Levels[^1].Width, image.Levels[^1].Height));
        Assert.All(image.Levels, level => Assert.Equal(expected, Power(level), 1e-5 * expected));
        // Of all directions, the mean is seen.
        Assert.Equal(0, (image.At(0.2, 0.3, 100) - image.Levels[^1][0, 0]).Length());

        static double Power(FloatImage image) => Enumerable.Range(0, image.Width * image.Height).Sum(
            i => SkyImage.SolidAngle(image.Width, image.Height, i / image.Width) * image[i % image.Width, i / image.Width].X);
    }

    [Fact]
    public void Equals_OfSkies_ComparesWhatAFileSays()
    {
        var sky = new ImageSky("a.hdr", 1, 2);
        Assert.Equal(sky, sky with { Image = new(Spots(2, 1)) });
        Assert.Equal(sky.GetHashCode(), (sky with { Image = new(Spots(2, 1)) }).GetHashCode());
        Assert.All([sky with { File = "b.hdr" }, sky with { Turn = 2 }, sky with { Scale = 1 }], other => Assert.NotEqual(sky, other));
        Assert.Equal(Vector.Zero, sky.HorizonRadiance);
        Assert.Equal(Vector.Zero, sky.ToRadiance(Handedness.Left).At(Vector.I));
        Assert.Equal(new Vector(2, 2, 2), (sky with { Image = new(new(1, 1, [1, 1, 1])) }).HorizonRadiance);
    }

    /// <summary>A black image with white pixels.</summary>
    internal static FloatImage Spots(int width, int height, params ReadOnlySpan<(int X, int Y)> spots)
    {
        var image = new FloatImage(width, height, new float[3 * width * height]);
        foreach (var (x, y) in spots)
        {
            image[x, y] = Vector.One;
        }

        return image;
    }

    private static FloatImage RandomImage(int width, int height)
    {
        var random = new Random(width);
        return new(width, height, [.. Enumerable.Range(0, 3 * width * height).Select(_ => (float)Math.Pow(random.NextDouble(), 6))]);
    }

    private static double Luminance(Vector light) => (0.2126 * light.X) + (0.7152 * light.Y) + (0.0722 * light.Z);
}
