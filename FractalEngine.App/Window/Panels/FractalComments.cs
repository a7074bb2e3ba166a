namespace FractalEngine.App.Window.Panels;

/// <summary>Finds what the author of a fractal's file has written about its numbers.</summary>
internal static class FractalComments
{
    /// <summary>Returns the comment above a line and those that continue it, over lines that begin with the same word.</summary>
    /// <param name="text">Text of the file.</param>
    /// <param name="offset">Place of a character in the line.</param>
    /// <returns>The comment without its sign; null where there is none.</returns>
    public static string? Above(string text, int offset)
    {
        var lines = text[..offset].Split('\n');
        var word = FirstWord(lines[^1]);
        var i = lines.Length - 2;
        while (i >= 0 && FirstWord(lines[i]) == word)
        {
            i--;
        }

        var end = i + 1;
        while (i >= 0 && lines[i].StartsWith('#'))
        {
            i--;
        }

        var comment = string.Join(' ', lines[(i + 1)..end].Select(static line => line.TrimStart('#').Trim()));
        return comment.Length > 0 ? comment : null;
    }

    private static string FirstWord(string line) => line.TrimStart().Split(' ', 2)[0];
}
