using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Smooth noise in space: random values at whole coordinates, between which it interpolates.</summary>
internal sealed class ValueNoise
{
    private const int Period = 32;

    private readonly double[] _values = new double[Period * Period * Period];

    /// <summary>Draws the values, from −1 to 1.</summary>
    public ValueNoise(SeededRandom random)
    {
        for (var i = 0; i < _values.Length; i++)
        {
            _values[i] = random.Between(-1, 1);
        }
    }

    /// <summary>Computes a sum of noises, each with twice the frequency and half the height of the last one.</summary>
    public double Sum(Vector position, int octaves)
    {
        var (sum, height) = (0.0, 1.0);
        for (var octave = 0; octave < octaves; octave++)
        {
            sum += height * At(position);
            (position, height) = (2 * position, height / 2);
        }

        return sum;
    }

    private double At(Vector position)
    {
        var (x, y, z) = (Math.Floor(position.X), Math.Floor(position.Y), Math.Floor(position.Z));
        var (u, v, w) = (Smooth(position.X - x), Smooth(position.Y - y), Smooth(position.Z - z));
        var sum = 0.0;
        for (var corner = 0; corner < 8; corner++)
        {
            var (i, j, k) = (corner & 1, (corner >> 1) & 1, corner >> 2);
            var weight = (i == 1 ? u : 1 - u) * (j == 1 ? v : 1 - v) * (k == 1 ? w : 1 - w);
            sum += weight * _values[Index((int)x + i, (int)y + j, (int)z + k)];
        }

        return sum;
    }

    private static int Index(int x, int y, int z) => ((((x & (Period - 1)) * Period) + (y & (Period - 1))) * Period) + (z & (Period - 1));

    private static double Smooth(double t) => t * t * (3 - (2 * t));
}
