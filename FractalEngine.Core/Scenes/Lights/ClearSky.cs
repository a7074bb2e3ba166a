using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>The sky of a clear day as an image: what air and haze scatter once of the sun's light, the sun, and even ground.</summary>
/// <param name="SunHeight">Height of the sun above the horizon in degrees, from −90 to 90.</param>
/// <param name="SunAzimuth">Direction of the sun in degrees: 0 in the middle of the image, positive to the right.</param>
/// <param name="Haze">How much haze there is, by that of a clear day; not negative.</param>
/// <remarks>
/// After T. Nishita and others, "Display of the Earth Taking into Account Atmospheric Scattering", SIGGRAPH 1993. The numbers of air and
/// haze are those of E. Bruneton, "A Qualitative and Quantitative Evaluation of 8 Clear Sky Models", 2017, as S. Hillaire, "A Scalable and
/// Production Ready Sky and Atmosphere Rendering Technique", EGSR 2020, has them for red, green and blue. Outside of the air the sun is
/// white, and as bright as a light of intensity 1. Light that is scattered several times is left out, so that dusk is too dark.
/// </remarks>
public sealed record ClearSky(double SunHeight, double SunAzimuth, double Haze = 1)
{
    // Kilometres: radii, and the heights by which density falls to 1/e.
    private const double GroundRadius = 6360;
    private const double AirRadius = 6460;
    private const double EyeHeight = 0.1;
    private const double AirScale = 8;
    private const double HazeScale = 1.2;

    // Shares of light that haze scatters and takes in a kilometre, and how much of it goes straight on.
    private const double HazeScattering = 3.996e-3;
    private const double HazeExtinction = 4.44e-3;
    private const double G = 0.8;
    private const double GroundAlbedo = 0.3;
    private const int Steps = 32;

    private static readonly Vector AirScattering = new(5.802e-3, 13.558e-3, 33.1e-3);

    /// <summary>Unit direction towards the sun, in a left-handed scene that shows the image without a turn.</summary>
    public Vector ToSun => DirectionOf(0.5 + (SunAzimuth / 360), 0.5 - (SunHeight / 180));

    /// <summary>The sun as a light of its own, for an image without it.</summary>
    public SunLight ToLight()
    {
        var light = SunlightAt(EyeHeight, ToSun.Y);
        var (red, green, blue) = light / Math.Max(light.MaxAbsComponent(), double.Epsilon);
        return new(-ToSun, new Colour(red, green, blue).FromLinear(), light.MaxAbsComponent());
    }

    /// <summary>Computes the image: equirectangular, the horizon in the middle.</summary>
    /// <param name="width">Columns, at least 1.</param>
    /// <param name="height">Rows, at least 1.</param>
    /// <param name="hasSun">Whether the sun's disc is in the image, with all of its light.</param>
    public FloatImage ToImage(int width, int height, bool hasSun = true)
    {
        var image = new FloatImage(width, height, new float[3 * width * height]);
        // About half of what is scattered out of the sunlight arrives as well.
        var ground = GroundAlbedo * Math.Max(ToSun.Y, 0) / 2 * (Vector.One + SunlightAt(EyeHeight, ToSun.Y));
        var disc = new double[width * height];
        Parallel.For(0, height, y =>
        {
            for (var x = 0; x < width; x++)
            {
                var direction = DirectionOf((x + 0.5) / width, (y + 0.5) / height);
                image[x, y] = Radiance(direction, ground);
                // Its edge is as soft as one and a half pixels, so that none falls between their centres.
                var angle = Math.Acos(Math.Clamp(Vector.Dot(direction, ToSun), -1, 1)) - (SunLight.DefaultDiameter / 360 * Math.PI);
                disc[(y * width) + x] = Math.Clamp(0.5 - (angle * height / (1.5 * Math.PI)), 0, 1);
            }
        });
        var solidAngle = Enumerable.Range(0, disc.Length).Sum(i => disc[i] * SkyImage.SolidAngle(width, height, i / width));
        var sunlight = hasSun ? Math.PI / solidAngle * SunlightAt(EyeHeight, ToSun.Y) : Vector.Zero;
        for (var i = 0; i < disc.Length; i++)
        {
            image[i % width, i / width] += disc[i] * sunlight;
        }

        return image;
    }

    private static Vector DirectionOf(double u, double v)
    {
        var ((x, z), (radius, y)) = (Math.SinCos(2 * Math.PI * (u - 0.5)), Math.SinCos(Math.PI * v));
        return new(radius * x, y, radius * z);
    }

    /// <summary>Follows a ray from the eye to the ground, or to the end of the air.</summary>
    /// <param name="direction">Unit direction.</param>
    /// <param name="ground">Radiance of the ground.</param>
    private Vector Radiance(Vector direction, Vector ground)
    {
        var cosine = Vector.Dot(direction, ToSun);
        // By Rayleigh, and by Cornette and Shanks (1992), of light that is π where it is perpendicular.
        var ofAir = 3.0 / 16 * (1 + (cosine * cosine)) * AirScattering;
        var ofHaze = Haze * HazeScattering * 3 / 8 * (1 - (G * G)) * (1 + (cosine * cosine))
            / ((2 + (G * G)) * Math.Pow(1 + (G * G) - (2 * G * cosine), 1.5)) * Vector.One;
        var eye = new Vector(0, GroundRadius + EyeHeight, 0);
        var toMiddle = eye.Y * direction.Y;
        var squared = (toMiddle * toMiddle) - (eye.Y * eye.Y);
        var isGround = toMiddle < 0 && squared + (GroundRadius * GroundRadius) > 0;
        var length = -toMiddle + (isGround
            ? -Math.Sqrt(squared + (GroundRadius * GroundRadius)) : Math.Sqrt(squared + (AirRadius * AirRadius)));
        var (sum, depth) = (Vector.Zero, Vector.Zero);
        for (var i = 0; i < Steps; i++)
        {
            // The air is densest where the way begins.
            var (start, end) = (length * i * i / (Steps * Steps), length * (i + 1) * (i + 1) / (Steps * Steps));
            var position = eye + (0.5 * (start + end) * direction);
            var height = position.Length() - GroundRadius;
            var (air, haze) = (Math.Exp(-height / AirScale), Math.Exp(-height / HazeScale));
            var half = (end - start) / 2 * Extinction(air, haze);
            sum += (end - start) * ((air * ofAir) + (haze * ofHaze)).Stretch(Left(depth + half))
                .Stretch(SunlightAt(height, Vector.Dot(position, ToSun) / position.Length()));
            depth += 2 * half;
        }

        return isGround ? sum + ground.Stretch(Left(depth)) : sum;
    }

    private Vector Extinction(double air, double haze) => (air * AirScattering) + (Haze * haze * HazeExtinction * Vector.One);

    private static Vector Left(Vector depth) => new(Math.Exp(-depth.X), Math.Exp(-depth.Y), Math.Exp(-depth.Z));

    /// <summary>The part of the sun's light that arrives at a height, by the cosine of its angle with the zenith.</summary>
    private Vector SunlightAt(double height, double cosine) =>
        Left(Extinction(Column(height, cosine, AirScale), Column(height, cosine, HazeScale)));

    /// <summary>The amount of a gas along a ray to the end of the air; below the horizon it grows without bound.</summary>
    /// <remarks>
    /// S. Chapman's grazing incidence function of 1931 for a large sphere, √(πx/2)·exp(y²)·erfc(y), whose last factors are nearly
    /// 2/√π / (y + √(y² + 4/π)) (M. Abramowitz and I. Stegun, "Handbook of Mathematical Functions", 7.1.13).
    /// </remarks>
    private static double Column(double height, double cosine, double scale)
    {
        var x = (GroundRadius + height) / scale;
        var y = Math.Sqrt(x / 2) * Math.Abs(cosine);
        var column = Math.Sqrt(2 * x) / (y + Math.Sqrt((y * y) + (4 / Math.PI)));
        var lowest = x * Math.Sqrt(1 - (cosine * cosine));
        column = cosine >= 0 ? column : (2 * Math.Exp(x - lowest) * Math.Sqrt(Math.PI / 2 * lowest)) - column;
        return scale * Math.Exp(-height / scale) * column;
    }
}
