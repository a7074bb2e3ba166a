using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>
/// Chooses places of an image of the sky by their luminance: a row first, then a pixel of it, and within that each solid angle alike.
/// </summary>
/// <remarks>
/// The weight of a pixel is the mean of what <see cref="SkyImage.At"/> interpolates over it: 1/8, 6/8 and 1/8 of three pixels along both
/// sides. Densities are those of the sums as they are stored, and so exact. Takes 8 bytes a pixel.
/// </remarks>
public sealed class SkyDistribution
{
    private readonly int _width;
    private readonly int _height;

    // Of all pixels up to each one, row by row.
    private readonly double[] _sums;

    /// <summary>Prepares the choice for an image.</summary>
    /// <param name="image">At least one pixel; no component is negative.</param>
    public SkyDistribution(FloatImage image)
    {
        ArgumentNullException.ThrowIfNull(image);
        (_width, _height, _sums) = (image.Width, image.Height, new double[image.Width * image.Height]);
        Parallel.For(0, _height, y =>
        {
            var (above, below) = (Math.Max(y - 1, 0), Math.Min(y + 1, _height - 1));
            var light = new double[_width];
            for (var x = 0; x < _width; x++)
            {
                light[x] = Luminance(image[x, above] + (6 * image[x, y]) + image[x, below]);
            }

            for (var x = 0; x < _width; x++)
            {
                var sum = light[(x + _width - 1) % _width] + (6 * light[x]) + light[(x + 1) % _width];
                _sums[(y * _width) + x] = SkyImage.SolidAngle(_width, _height, y) / 64 * sum;
            }
        });
        for (var i = 1; i < _sums.Length; i++)
        {
            _sums[i] += _sums[i - 1];
        }
    }

    /// <summary>True for a black image, of which nothing can be chosen.</summary>
    public bool IsEmpty => !(_sums[^1] > 0);

    /// <summary>Chooses a place by a point of a square.</summary>
    /// <param name="point">Both coordinates from 0 to below 1; equally spread points give the distribution.</param>
    /// <returns>From the left and from the top, from 0 to 1.</returns>
    public (double U, double V) Sample((double U, double V) point)
    {
        var row = Find(_width - 1, _width, _height, point.V * _sums[^1], out var along);
        var (start, end) = (SumBefore(row * _width), _sums[(row * _width) + _width - 1]);
        var column = Find(row * _width, 1, _width, start + (point.U * (end - start)), out var across);
        var (top, bottom) = (Math.Cos(Math.PI * row / _height), Math.Cos(Math.PI * (row + 1) / _height));
        return ((column + across) / _width, Math.Acos(top + (along * (bottom - top))) / Math.PI);
    }

    /// <summary>Tells how likely a place is chosen.</summary>
    /// <param name="u">From the left, from 0 to 1.</param>
    /// <param name="v">From the top, from 0 to 1.</param>
    /// <returns>The probability for each unit of solid angle.</returns>
    public double Density(double u, double v)
    {
        var (column, row) = (Math.Min((int)(u * _width), _width - 1), Math.Min((int)(v * _height), _height - 1));
        var index = (row * _width) + column;
        return (_sums[index] - SumBefore(index)) / _sums[^1] / SkyImage.SolidAngle(_width, _height, row);
    }

    private double SumBefore(int index) => index == 0 ? 0 : _sums[index - 1];

    /// <summary>Finds the first of some sums that is greater than a number, and how far that is from the one before, from 0 to 1.</summary>
    private int Find(int first, int step, int count, double number, out double part)
    {
        // Rounding must not lead beyond the last one.
        number = Math.Min(number, Math.BitDecrement(_sums[first + ((count - 1) * step)]));
        var (low, high) = (0, count - 1);
        while (low < high)
        {
            var middle = (low + high) / 2;
            (low, high) = _sums[first + (middle * step)] > number ? (low, middle) : (middle + 1, high);
        }

        var end = first + (low * step);
        var before = SumBefore(end - step + 1);
        part = Math.Clamp((number - before) / (_sums[end] - before), 0, 1);
        return low;
    }

    // The brightness of linear light by ITU-R BT.709.
    private static double Luminance(Vector light) => (0.2126 * light.X) + (0.7152 * light.Y) + (0.0722 * light.Z);
}
