using System.Collections.Immutable;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>
/// An image of all directions, prepared to be looked up: rows lead from straight above to straight below, columns once around.
/// </summary>
public sealed class SkyImage
{
    private readonly Lazy<SkyDistribution> _distribution;

    /// <summary>Prepares an image, with its levels.</summary>
    /// <param name="image">At least one pixel; no component is negative.</param>
    public SkyImage(FloatImage image)
    {
        ArgumentNullException.ThrowIfNull(image);
        var levels = ImmutableArray.CreateBuilder<FloatImage>();
        for (levels.Add(image); levels[^1] is { Width: > 1 } or { Height: > 1 };)
        {
            levels.Add(Halve(levels[^1]));
        }

        Levels = levels.ToImmutable();
        _distribution = new(() => new(image));
        Horizon = Enumerable.Range(0, 8).Aggregate(Vector.Zero, (sum, i) => sum + (At(i / 8.0, 0.48, 0.02) / 8));
    }

    /// <summary>
    /// The image, and means of it, weighted by solid angle: each has half the columns and rows of the one before, and at least one.
    /// </summary>
    public ImmutableArray<FloatImage> Levels { get; }

    /// <summary>Full path of the image's file; null for one made in code.</summary>
    public string? SourcePath { get; init; }

    /// <summary>The mean of eight places just above the horizon.</summary>
    public Vector Horizon { get; }

    /// <summary>Chooses directions by their luminance; computed when it is first asked for.</summary>
    public SkyDistribution Distribution => _distribution.Value;

    /// <summary>The finest level of at most so many columns.</summary>
    /// <param name="maxWidth">At least 1.</param>
    public FloatImage LevelOf(int maxWidth) => Levels.First(level => level.Width <= maxWidth);

    /// <summary>Looks up the light of a direction: bilinear between the centres of pixels.</summary>
    /// <param name="u">From the left; whole numbers are the same.</param>
    /// <param name="v">From the top, from 0 to 1.</param>
    /// <param name="solidAngle">How much is seen, in steradians; the level is chosen whose pixels are about as large.</param>
    public Vector At(double u, double v, double solidAngle = 0)
    {
        var pixels = Math.Max(solidAngle * Levels[0].Width * Levels[0].Height / (2 * Math.PI * Math.PI), 1);
        var level = Levels[Math.Min((int)Math.Round(0.5 * Math.Log2(pixels)), Levels.Length - 1)];
        var (x, y) = (((u - Math.Floor(u)) * level.Width) - 0.5, (v * level.Height) - 0.5);
        var (left, top) = ((int)Math.Floor(x), (int)Math.Floor(y));
        var (above, below) = (RowAt(Math.Max(top, 0)), RowAt(Math.Min(top + 1, level.Height - 1)));
        return above + ((y - top) * (below - above));

        Vector RowAt(int row)
        {
            var (first, second) = (level[left < 0 ? level.Width - 1 : left, row], level[left + 1 == level.Width ? 0 : left + 1, row]);
            return first + ((x - left) * (second - first));
        }
    }

    /// <summary>The solid angle of a pixel in steradians.</summary>
    /// <param name="width">Columns of the image.</param>
    /// <param name="height">Rows of the image.</param>
    /// <param name="row">Row of the pixel, from the top, from 0.</param>
    public static double SolidAngle(int width, int height, int row) =>
        2 * Math.PI / width * (Math.Cos(Math.PI * row / height) - Math.Cos(Math.PI * (row + 1) / height));

    private static FloatImage Halve(FloatImage image)
    {
        var (width, height) = (Math.Max(1, image.Width / 2), Math.Max(1, image.Height / 2));
        var half = new FloatImage(width, height, new float[3 * width * height]);
        Parallel.For(0, height, row =>
        {
            for (var column = 0; column < width; column++)
            {
                var (sum, weights) = (Vector.Zero, 0.0);
                for (var y = row * image.Height / height; y < (row + 1) * image.Height / height; y++)
                {
                    var weight = SolidAngle(image.Width, image.Height, y);
                    for (var x = column * image.Width / width; x < (column + 1) * image.Width / width; x++)
                    {
                        sum += weight * image[x, y];
                        weights += weight;
                    }
                }

                half[column, row] = sum / weights;
            }
        });
        return half;
    }
}
