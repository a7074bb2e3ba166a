using System.Collections.Immutable;
using System.Globalization;
using System.Text.RegularExpressions;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Finds what the author of a fractal's file has written about its numbers.</summary>
public static partial class FractalComments
{
    private const string Number = "[0-9]{1,6}";

    /// <summary>
    /// Finds the comment of each number: that behind it in its line, that above the line, or above the lines before it that begin with the
    /// same word.
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
            if (lines[i].StartsWith('#') || lines[i].TrimStart().StartsWith("//", StringComparison.Ordinal))
            {
                above.Add(lines[i].TrimStart('#', '/', ' ', '\t').Trim());
                continue;
            }

            var behind = lines[i].IndexOf("//", StringComparison.Ordinal);

            var isContinued = i > 0 && above.Count == 0 && FirstWord(lines[i]) == word;
            word = FirstWord(lines[i]);
            comments[i] = behind >= 0 ? lines[i][(behind + 2)..].Trim()
                : isContinued ? comments[i - 1]
                : above.Exists(static line => line.Length > 0) ? string.Join(' ', above) : null;
            above.Clear();
        }

        return [.. offsets.Select(offset => comments[LineOf(starts, offset)])];
    }

    /// <summary>Returns what a comment says about one of the vectors, as in <c>1: the trunk. 2 to 4: where branches leave.</c></summary>
    /// <param name="comment">Comment of several vectors.</param>
    /// <param name="vector">Number of the vector, from 1.</param>
    /// <returns>The words behind the number, without the full stop; null where the comment does not tell the vectors apart.</returns>
    public static string? About(string comment, int vector)
    {
        foreach (Match match in NumberedPart().Matches(comment))
        {
            var first = int.Parse(match.Groups["first"].ValueSpan, CultureInfo.InvariantCulture);
            var last = match.Groups["last"].Success ? int.Parse(match.Groups["last"].ValueSpan, CultureInfo.InvariantCulture) : first;
            if (vector == first || vector == last || (match.Groups["word"].Value == "to" && vector > first && vector < last))
            {
                return match.Groups["text"].Value.TrimEnd('.', ' ');
            }
        }

        return null;
    }

    private static int LineOf(int[] starts, int offset)
    {
        var index = Array.BinarySearch(starts, offset);
        return index < 0 ? ~index - 1 : index;
    }

    private static string FirstWord(string line) => line.TrimStart().Split(' ', 2)[0];

    [GeneratedRegex(
        $@"\b(?<first>{Number})(?: (?<word>to|and) (?<last>{Number}))?: (?<text>.*?)"
        + $"(?= {Number}(?: (?:to|and) {Number})?: |$)")]
    private static partial Regex NumberedPart();
}
