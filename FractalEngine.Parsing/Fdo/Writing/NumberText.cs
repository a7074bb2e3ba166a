using System.Globalization;

namespace FractalEngine.Parsing.Fdo.Writing;

/// <summary>Writes numbers as a person would: as whole numbers, fractions of small numbers, or with few digits.</summary>
internal static class NumberText
{
    private const int MaxDenominator = 12;

    /// <summary>Returns the simplest number within a tolerance.</summary>
    public static double Round(double number, double tolerance) => Simplify(number, tolerance).Value;

    /// <summary>Returns the text of the simplest number within a tolerance; it is read as that number.</summary>
    public static string Format(double number, double tolerance) => Simplify(number, tolerance).Text;

    private static (double Value, string Text) Simplify(double number, double tolerance)
    {
        for (var digits = 0; digits <= 4; digits++)
        {
            var rounded = Math.Round(number, digits) + 0.0;
            if (Math.Abs(number - rounded) <= tolerance)
            {
                return (rounded, rounded.ToString("R", CultureInfo.InvariantCulture));
            }
        }

        for (var denominator = 3; denominator <= MaxDenominator; denominator++)
        {
            var numerator = Math.Round(number * denominator);
            var fraction = numerator / denominator;
            if (Math.Abs(numerator) < 100 && Math.Abs(number - fraction) <= tolerance)
            {
                return (fraction, string.Create(CultureInfo.InvariantCulture, $"{numerator}/{denominator}"));
            }
        }

        for (var digits = 5; digits <= 15; digits++)
        {
            var rounded = Math.Round(number, digits);
            if (Math.Abs(number - rounded) <= tolerance)
            {
                return (rounded, rounded.ToString("R", CultureInfo.InvariantCulture));
            }
        }

        return (number, number.ToString("R", CultureInfo.InvariantCulture));
    }
}
