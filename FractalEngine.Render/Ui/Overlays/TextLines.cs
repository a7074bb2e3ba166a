namespace FractalEngine.Render.Ui.Overlays;

/// <summary>Breaks text into lines.</summary>
internal static class TextLines
{
    /// <summary>Breaks a text so that no line is too long: between its parts, else at blanks, else anywhere.</summary>
    /// <param name="text">Text of one line.</param>
    /// <param name="columns">Characters in a line at most; positive.</param>
    /// <param name="separator">Stands between the parts, and is dropped where a line breaks.</param>
    public static IEnumerable<string> Wrap(string text, int columns, string separator = " ")
    {
        while (text.Length > columns)
        {
            var end = text.LastIndexOf(separator, columns, StringComparison.Ordinal) is > 0 and var part ? part
                : text.LastIndexOf(' ', columns) is > 0 and var blank ? blank
                : columns;
            yield return text[..end];
            end += text[end..].StartsWith(separator, StringComparison.Ordinal) ? separator.Length : 0;
            text = text[end..].TrimStart();
        }

        yield return text;
    }
}
