using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>The radiance of a <see cref="ImageSky"/> in all directions, linear light: red, green, blue.</summary>
/// <param name="Image">The image.</param>
/// <param name="Turn">Degrees about +y.</param>
/// <param name="Scale">Factor of the image's light.</param>
/// <param name="Handedness">How the scene is shown.</param>
public sealed record ImageRadiance(SkyImage Image, double Turn, double Scale, Handedness Handedness) : SkyRadiance
{
    // Harmonics of the second degree need no more.
    private const int HarmonicColumns = 512;

    /// <summary>1 in a left-handed scene, whose camera looks at +z, and −1 in a right-handed one.</summary>
    public double Forward { get; } = Handedness == Handedness.Right ? -1 : 1;

    /// <summary>Where in the image the direction ahead is, from the left; 1 is once around.</summary>
    public double AheadU => 0.5 + (Forward * Turn / 360);

    /// <inheritdoc/>
    public override Vector At(Vector unitDirection, double solidAngle = 0)
    {
        var (u, v) = PlaceOf(unitDirection);
        return Scale * Image.At(u, v, solidAngle);
    }

    /// <summary>Finds a direction in the image.</summary>
    /// <param name="unitDirection">World space.</param>
    /// <returns>From the left and from the top, from 0 to 1.</returns>
    public (double U, double V) PlaceOf(Vector unitDirection)
    {
        var u = AheadU + (Math.Atan2(unitDirection.X, Forward * unitDirection.Z) / (2 * Math.PI));
        return (u - Math.Floor(u), Math.Acos(Math.Clamp(unitDirection.Y, -1, 1)) / Math.PI);
    }

    /// <summary>Finds the direction of a place of the image.</summary>
    /// <param name="u">From the left, from 0 to 1.</param>
    /// <param name="v">From the top, from 0 to 1.</param>
    public Vector DirectionOf(double u, double v)
    {
        var (x, z) = Math.SinCos(2 * Math.PI * (u - AheadU));
        var (radius, y) = Math.SinCos(Math.PI * v);
        return new(radius * x, y, radius * Forward * z);
    }

    /// <inheritdoc/>
    /// <remarks>The factors are π times those by which a cosine weighs harmonics (Ramamoorthi and Hanrahan, SIGGRAPH 2001).</remarks>
    public override SkyIrradiance Irradiance()
    {
        var image = Image.LevelOf(HarmonicColumns);
        var moments = new Vector[9];
        for (var row = 0; row < image.Height; row++)
        {
            var weight = Scale * SkyImage.SolidAngle(image.Width, image.Height, row) / Math.PI;
            for (var column = 0; column < image.Width; column++)
            {
                var light = weight * image[column, row];
                var (x, y, z) = DirectionOf((column + 0.5) / image.Width, (row + 0.5) / image.Height);
                ReadOnlySpan<double> harmonics =
                [
                    1.0 / 4, 1.0 / 2 * y, 5.0 / 64 * ((3 * y * y) - 1), 1.0 / 2 * x, 1.0 / 2 * z,
                    15.0 / 16 * x * y, 15.0 / 16 * y * z, 15.0 / 16 * x * z, 15.0 / 64 * ((x * x) - (z * z)),
                ];
                for (var i = 0; i < moments.Length; i++)
                {
                    moments[i] += harmonics[i] * light;
                }
            }
        }

        return new(moments[0] - moments[2], moments[1], 3 * moments[2], [.. moments.AsSpan(3)]);
    }
}
