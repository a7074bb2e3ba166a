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
        if (FirstRounded(0, 4) is { } decimalNumber)
        {
            return WithText(decimalNumber);
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

        return WithText(FirstRounded(5, 15) ?? number);

        double? FirstRounded(int minDigits, int maxDigits) => Enumerable.Range(minDigits, maxDigits + 1 - minDigits)
            .Select(digits => (double?)(Math.Round(number, digits) + 0.0))
            .FirstOrDefault(rounded => Math.Abs(number - rounded!.Value) <= tolerance);

        static (double Value, string Text) WithText(double value) => (value, value.ToString("R", CultureInfo.InvariantCulture));
    }
}
