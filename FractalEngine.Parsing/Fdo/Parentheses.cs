namespace FractalEngine.Parsing.Fdo;

/// <summary>Tells objects and products in parentheses from the outputs of a function, <c>t. (#, 1, #)</c>.</summary>
internal static class Parentheses
{
    /// <summary>Tells whether a text begins with a product of maps in parentheses, <c>(t. * r.)</c>.</summary>
    /// <remarks>
    /// Outside of inner parentheses, only products have names with dots, <c>*</c> and <c>^</c>, and only outputs have several items.
    /// </remarks>
    public static bool HoldProduct(ReadOnlySpan<char> text)
    {
        var depth = 0;
        var items = 0;
        var isBetween = true;
        for (var i = 0; i < text.Length && text[i] is not ('\n' or '\r'); i++)
        {
            depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
            if (depth == 0)
            {
                return items == 1;
            }

            if (depth == 1 && (text[i] is '*' or '^' || (text[i] == '.' && (char.IsLetter(text[i - 1]) || text[i - 1] == '_'))))
            {
                return true;
            }

            var isSeparator = i == 0 || (depth == 1 && text[i] is ',' or ' ' or '\t');
            items += isBetween && !isSeparator ? 1 : 0;
            isBetween = isSeparator;
        }

        return false;
    }

    /// <summary>Tells whether a text that begins with a parenthesis begins with an object, <c>(a + [t.] b)</c>.</summary>
    /// <remarks>
    /// Outside of inner parentheses, only objects have sets, quotes and plus signs, and only outputs have commas, '#', and three items.
    /// Only choices have colons, and only ends by size the word 'until'.
    /// </remarks>
    public static bool HoldObject(ReadOnlySpan<char> text)
    {
        // What else begins with a number, in however many parentheses, is an output.
        var end = text.IndexOfAny(":)\n\r");
        if (end >= 0 && (text[end] == ':' || text[..end].Contains(" until ", StringComparison.Ordinal)))
        {
            return true;
        }

        if (text.TrimStart("( \t") is not [not (>= '0' and <= '9' or '-' or '.'), ..])
        {
            return false;
        }

        var depth = 0;
        var items = 0;
        var isInItem = false;
        foreach (var character in text)
        {
            depth += character == '(' ? 1 : 0;
            switch (character)
            {
                case '\n' or '\r':
                    return false;
                case '[' or '"' or '+' when depth == 1:
                    return true;
                case ',' or '#' when depth == 1:
                    return false;
                case ')' when --depth == 0:
                    return items is 1 or 2;
            }

            var isBlank = character is ' ' or '\t' || (character == '(' && depth == 1);
            items += !isBlank && !isInItem ? 1 : 0;
            isInItem = !isBlank || depth > 1;
        }

        return false;
    }
}
