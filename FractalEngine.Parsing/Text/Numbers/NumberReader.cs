using System.Globalization;

namespace FractalEngine.Parsing.Text.Numbers;

/// <summary>
/// Reads decimal numbers independently of the culture, correctly rounded: always the same bits as <see cref="double.Parse(string)"/>.
/// </summary>
public static class NumberReader
{
    /// <summary>Reads a number at the start of a text: sign, digits, point, digits and exponent.</summary>
    /// <param name="text">Text that may continue behind the number.</param>
    /// <param name="value">Closest double; infinite if the number is out of range.</param>
    /// <param name="length">Number of characters read, 0 on failure.</param>
    /// <returns>False if the text does not start with a number; <c>nan</c> and <c>inf</c> are not numbers.</returns>
    public static bool TryRead(ReadOnlySpan<char> text, out double value, out int length)
    {
        var position = text.Length > 0 && text[0] is '-' or '+' ? 1 : 0;
        var digitCount = SkipDigits(text, ref position);
        if (position < text.Length && text[position] == '.')
        {
            position++;
            digitCount += SkipDigits(text, ref position);
        }

        value = 0;
        length = 0;
        if (digitCount == 0)
        {
            return false;
        }

        SkipExponent(text, ref position);
        length = position;
        value = double.Parse(text[..length], NumberStyles.Float, CultureInfo.InvariantCulture);
        return true;
    }

    /// <summary>Returns whether a word is that of an undefined number: <c>nan</c>, <c>-inf</c> or <c>-nan(ind)</c>.</summary>
    internal static bool IsUndefined(ReadOnlySpan<char> word)
    {
        word = word.Length > 0 && word[0] is '-' or '+' ? word[1..] : word;
        return word.Equals("nan", StringComparison.OrdinalIgnoreCase)
            || word.Equals("inf", StringComparison.OrdinalIgnoreCase)
            || word.Equals("infinity", StringComparison.OrdinalIgnoreCase)
            || (word.StartsWith("nan(", StringComparison.OrdinalIgnoreCase) && word.EndsWith(")"));
    }

    private static int SkipDigits(ReadOnlySpan<char> text, ref int position)
    {
        var start = position;
        while (position < text.Length && char.IsAsciiDigit(text[position]))
        {
            position++;
        }

        return position - start;
    }

    private static void SkipExponent(ReadOnlySpan<char> text, ref int position)
    {
        if (position < text.Length && text[position] is 'e' or 'E')
        {
            var end = position + (position + 1 < text.Length && text[position + 1] is '-' or '+' ? 2 : 1);
            // "2em" is the number 2 followed by something else.
            position = SkipDigits(text, ref end) > 0 ? end : position;
        }
    }
}
