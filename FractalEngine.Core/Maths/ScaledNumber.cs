using System.Globalization;

namespace FractalEngine.Core.Maths;

/// <summary>Writes lengths that may be too small for a double, as those deep in a fractal are.</summary>
public static class ScaledNumber
{
    // Natural logarithms that are no denormal numbers.
    private const double MinLog = -700;

    /// <summary>Writes a length in scene units.</summary>
    /// <param name="length">In some unit, not negative.</param>
    /// <param name="logUnit">Natural logarithm of the unit in scene units.</param>
    /// <param name="digits">Number of digits.</param>
    public static string Format(double length, double logUnit, int digits)
    {
        var format = "G" + digits.ToString(CultureInfo.InvariantCulture);
        if (!(length > 0) || Math.Log(length) + logUnit > MinLog)
        {
            return (length * Math.Exp(logUnit)).ToString(format, CultureInfo.InvariantCulture);
        }

        var log10 = (Math.Log(length) + logUnit) / Math.Log(10);
        var exponent = Math.Floor(log10);
        // The logarithm itself has lost digits to its size.
        return FormattableString.Invariant($"{Math.Pow(10, log10 - exponent).ToString("G6", CultureInfo.InvariantCulture)}E{exponent:F0}");
    }
}
