using System.Globalization;

namespace FractalEngine.Parsing.Text.Numbers;

/// <summary>
/// Reads decimal numbers independently of the culture, correctly rounded: always the same bits as <see cref="double.Parse(string)"/>.
/// </summary>
/// <remarks>The framework reads numbers of more than 19 digits, and exponents of more than six.</remarks>
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
        var digitsStart = position;
        var mantissa = 0UL;
        ReadDigits(text, ref position, ref mantissa);
        var digitCount = position - digitsStart;
        var exponent = 0;
        if (position < text.Length && text[position] == '.')
        {
            position++;
            var fractionStart = position;
            ReadDigits(text, ref position, ref mantissa);
            exponent = fractionStart - position;
            digitCount -= exponent;
        }

        value = 0;
        length = 0;
        if (digitCount == 0)
        {
            return false;
        }

        var isExponentUsable = TryReadExponent(text, ref position, ref exponent);
        length = position;
        if (digitCount <= DecimalConversion.MaxDigits && isExponentUsable)
        {
            value = DecimalConversion.ToDouble(mantissa, exponent);
            value = text[0] == '-' ? -value : value;
            return true;
        }

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

    private static void ReadDigits(ReadOnlySpan<char> text, ref int position, ref ulong mantissa)
    {
        for (; position < text.Length && (uint)(text[position] - '0') <= 9; position++)
        {
            // Overflow is harmless: mantissas of more than 19 digits are not used.
            mantissa = unchecked((mantissa * 10) + (ulong)(text[position] - '0'));
        }
    }

    /// <summary>Adds a written exponent to the given one; false if it has too many digits for the fast path.</summary>
    private static bool TryReadExponent(ReadOnlySpan<char> text, ref int position, ref int exponent)
    {
        if (position >= text.Length || text[position] is not ('e' or 'E'))
        {
            return true;
        }

        var digitsStart = position + (position + 1 < text.Length && text[position + 1] is '-' or '+' ? 2 : 1);
        var digitsEnd = digitsStart;
        var magnitude = 0UL;
        ReadDigits(text, ref digitsEnd, ref magnitude);
        if (digitsEnd == digitsStart)
        {
            // "2em" is the number 2 followed by something else.
            return true;
        }

        var isNegative = text[position + 1] == '-';
        position = digitsEnd;
        if (digitsEnd - digitsStart > 6)
        {
            return false;
        }

        exponent += isNegative ? -(int)magnitude : (int)magnitude;
        return true;
    }
}
