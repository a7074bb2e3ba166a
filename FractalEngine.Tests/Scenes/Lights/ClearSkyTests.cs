using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Tests.Scenes.Lights;

/// <summary>The sky of a clear day, against what is known of air.</summary>
public sealed class ClearSkyTests
{
    [Theory]
    [InlineData(40, 0)]
    [InlineData(90, 0)]
    [InlineData(5, -120)]
    public void Sun_OfAnyImage_HasItsLightAndItsPlace(double height, double azimuth)
    {
        var sky = new ClearSky(height, azimuth);
        var expected = Math.PI * sky.ToLight().Radiance;
        foreach (var rows in (int[])[2, 16, 90])
        {
            var (with, without) = (sky.ToImage(2 * rows, rows), sky.ToImage(2 * rows, rows, hasSun: false));
            var (light, moment) = (Vector.Zero, Vector.Zero);
            for (var y = 0; y < rows; y++)
            {
                for (var x = 0; x < 2 * rows; x++)
                {
                    var added = SkyImage.SolidAngle(2 * rows, rows, y) * (with[x, y] - without[x, y]);
                    light += added;
                    moment += added.X * Direction((x + 0.5) / (2 * rows), (y + 0.5) / rows);
                }
            }

            // Pixels are floats.
            Assert.Equal(0, (light - expected).Length(), 1e-5 * expected.Length());
            Assert.InRange(Vector.Dot(moment.UnitVector(), sky.ToSun), rows < 90 ? 0.6 : 0.9999, 1.000001);
        }
    }

    [Fact]
    public void Sunlight_FromTheZenith_IsThatOfTheOpticalDepth()
    {
        // e^−(βs) along the vertical, from 100 m above the ground: Rayleigh's scale height 8 km and the haze's 1.2 km.
        var (air, haze) = (8 * Math.Exp(-0.1 / 8), 1.2 * Math.Exp(-0.1 / 1.2));
        foreach (var amount in (double[])[0, 1, 7])
        {
            var light = new ClearSky(90, 0, amount).ToLight();
            var lost = amount * 4.44e-3 * haze;
            Assert.Equal(Math.Exp(-(5.802e-3 * air) - lost), light.Radiance.X, 4e-4);
            Assert.Equal(Math.Exp(-(33.1e-3 * air) - lost), light.Radiance.Z, 4e-4);
        }
    }

    [Theory]
    [InlineData(30)]
    [InlineData(3)]
    [InlineData(0)]
    public void Sunlight_NearTheHorizon_IsNearlyThatOfTheCurvedAir(double height)
    {
        // The same depth added up in small steps.
        var (radius, depth) = (6360.1, Vector.Zero);
        const double Step = 0.02;
        var sine = Math.Sin(height * Math.PI / 180);
        for (var way = Step / 2; way < 1500; way += Step)
        {
            var above = Math.Sqrt((radius * radius) + (way * way) + (2 * way * radius * sine)) - 6360;
            depth += Step * Math.Exp(-above / 8) * new Vector(5.802e-3, 13.558e-3, 33.1e-3);
            depth += Step * Math.Exp(-above / 1.2) * 4.44e-3 * Vector.One;
        }

        var light = new ClearSky(height, 0).ToLight().Radiance;
        Assert.Equal(depth.X, -Math.Log(light.X), 0.05 * depth.X);
        Assert.Equal(depth.Y, -Math.Log(light.Y), 0.05 * depth.Y);
    }

    [Fact]
    public void Sky_OfADay_IsBlueAboveAndPaleAtTheHorizon_AndTheSameOnBothSidesOfTheSun()
    {
        var image = new ClearSky(50, 0).ToImage(64, 32, hasSun: false);
        var (above, horizon) = (image[60, 2], image[2, 15]);
        Assert.True(above.Z > 2 * above.X, $"{above}");
        Assert.True(horizon.Y > above.Y && horizon.Z / horizon.X < 0.7 * above.Z / above.X, $"{horizon}");
        for (var i = 0; i < 32 * 32; i++)
        {
            var (y, x) = Math.DivRem(i, 32);
            Assert.Equal(0, (image[x, y] - image[63 - x, y]).Length(), 1e-6);
        }

        // Haze whitens, and brightens the sky around the sun. In the night there is no light.
        var hazy = new ClearSky(50, 0, 5).ToImage(64, 32, hasSun: false);
        Assert.True(hazy[32, 7].X > image[32, 7].X && hazy[60, 2].Z / hazy[60, 2].X < above.Z / above.X);
        Assert.InRange(new ClearSky(-60, 0).ToImage(64, 32).Pixels.Max(), 0, 1e-9f);
    }

    private static Vector Direction(double u, double v)
    {
        var (radius, y) = Math.SinCos(Math.PI * v);
        return new(radius * Math.Sin(2 * Math.PI * (u - 0.5)), y, radius * Math.Cos(2 * Math.PI * (u - 0.5)));
    }
}
