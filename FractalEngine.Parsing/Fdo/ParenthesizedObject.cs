namespace FractalEngine.Parsing.Fdo;

/// <summary>Tells objects in parentheses, <c>y. (a + [t.] b)</c>, from the outputs of a function, <c>t. (#, 1, #)</c>.</summary>
internal static class ParenthesizedObject
{
    /// <summary>Tells whether a text that begins with a parenthesis begins with an object.</summary>
    /// <remarks>
    /// Outside of inner parentheses, only objects have sets, quotes and plus signs, and only outputs have commas, '#', and three items.
    /// </remarks>
    public static bool Begins(ReadOnlySpan<char> text)
    {
        // What begins with a number, in however many parentheses, is an output.
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
