namespace FractalEngine.Parsing.Text;

/// <summary>Tests whether names can be written into files such that the parsers read them back unchanged.</summary>
internal static class WritableNames
{
    /// <summary>Returns whether a name can stand between double quotes, where there are no escapes.</summary>
    public static bool IsQuotable(string name) => IsText(name) && name.AsSpan().IndexOfAny('"', '\n', '\r') < 0;

    /// <summary>Returns whether a name can be the rest of a line of an OBJ file; an empty one can.</summary>
    public static bool IsRestOfLine(string name) =>
        IsText(name) && name.AsSpan().IndexOfAny('\n', '\r') < 0 && name.Trim().Length == name.Length && !name.EndsWith('\\')
        && !name.StartsWith('#') && !name.Contains(" #", StringComparison.Ordinal) && !name.Contains("\t#", StringComparison.Ordinal);

    /// <summary>Returns a name for a message of one line: control characters become spaces.</summary>
    public static string Escape(string name) => string.Concat(name.Select(character => char.IsControl(character) ? ' ' : character));

    /// <summary>Returns whether UTF-8 can express a text and no character makes its file look binary.</summary>
    private static bool IsText(string text)
    {
        for (var i = 0; i < text.Length; i++)
        {
            if (text[i] == '\0' || (char.IsSurrogate(text[i]) && !char.IsSurrogatePair(text, i++)))
            {
                return false;
            }
        }

        return true;
    }
}
