using System.Collections.Immutable;

namespace FractalEngine.App.Window.Panels;

/// <summary>Finds what the author of a fractal's file has written about its numbers.</summary>
internal static class FractalComments
{
    /// <summary>
    /// Finds the comment of each number: that above its line, or above the lines before it that begin with the same word.
    /// </summary>
    /// <param name="text">Text of the file.</param>
    /// <param name="offsets">Where the numbers begin in it.</param>
    /// <returns>The comments without their signs, in the order of the numbers; null where there is none.</returns>
    /// <remarks>Reads the text once: files may have some hundred thousand numbers.</remarks>
    public static ImmutableArray<string?> Above(string text, IEnumerable<int> offsets)
    {
        var lines = text.Split('\n');
        var starts = new int[lines.Length];
        var comments = new string?[lines.Length];
        var above = new List<string>();
        var word = "";
        for (var i = 0; i < lines.Length; i++)
        {
            starts[i] = i == 0 ? 0 : starts[i - 1] + lines[i - 1].Length + 1;
            if (lines[i].StartsWith('#'))
            {
                above.Add(lines[i].TrimStart('#').Trim());
                continue;
            }

            var isContinued = i > 0 && above.Count == 0 && FirstWord(lines[i]) == word;
            word = FirstWord(lines[i]);
            comments[i] = isContinued ? comments[i - 1] : above.Exists(static line => line.Length > 0) ? string.Join(' ', above) : null;
            above.Clear();
        }

        return [.. offsets.Select(offset => comments[LineOf(starts, offset)])];
    }

    private static int LineOf(int[] starts, int offset)
    {
        var index = Array.BinarySearch(starts, offset);
        return index < 0 ? ~index - 1 : index;
    }

    private static string FirstWord(string line) => line.TrimStart().Split(' ', 2)[0];
}
