using System.Collections.Immutable;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Sdo.Merging;

/// <summary>
/// Merges changes of a scene into the text of its file as it is now, line by line. It knows the declarations that a scene has at most
/// once: camera, projection, aspect, clip planes, background, sky, probe, exposure,
/// tone, fog, gravity, player and handedness. All other lines are those of the file.
/// </summary>
/// <remarks>
/// A declaration is found by its first word, wherever its line stands. So a file that is broken elsewhere can be merged too, and no
/// declaration is written twice. Lines without a change stay to the byte, their line breaks included.
/// </remarks>
public static class SceneMerge
{
    private static readonly ImmutableHashSet<string> UniqueWords = [.. SceneParser.UniqueKeywords];

    /// <summary>Merges the changes from one text to another into a third.</summary>
    /// <param name="original">Text that both sides began with.</param>
    /// <param name="mine">The original with the changes of the side that saves.</param>
    /// <param name="theirs">The original with the changes in the file.</param>
    /// <param name="preference">Which side wins where both have changed the same declaration.</param>
    /// <returns>The merged text, and the declarations that were left to decide.</returns>
    public static MergedScene Merge(string original, string mine, string theirs, MergePreference preference = MergePreference.None)
    {
        var originalLines = FindDeclarations(SplitLines(original));
        var mineLines = FindDeclarations(SplitLines(mine));
        var lines = SplitLines(theirs);
        var theirLines = FindDeclarations(lines);
        var conflicts = ImmutableArray.CreateBuilder<MergeConflict>();
        foreach (var word in originalLines.Keys.Union(mineLines.Keys).Order(StringComparer.Ordinal))
        {
            var before = originalLines.GetValueOrDefault(word).Content;
            var wanted = mineLines.GetValueOrDefault(word).Content;
            var isThere = theirLines.TryGetValue(word, out var found);
            if (wanted == before || wanted == found.Content)
            {
                continue;
            }

            if (found.Content != before && preference != MergePreference.Mine)
            {
                if (preference == MergePreference.None)
                {
                    conflicts.Add(new(wanted, found.Content));
                }

                continue;
            }

            if (isThere)
            {
                var line = lines[found.Index];
                lines[found.Index] = line[..MarkLength(line)] + (wanted is null ? "" : wanted + line[ContentLength(line)..]);
            }
            else
            {
                Append(lines, wanted!, SourceText.LineBreakOf(theirs));
            }
        }

        return new(string.Concat(lines), conflicts.ToImmutable());
    }

    private static void Append(List<string> lines, string content, string lineBreak)
    {
        if (lines is [.., var last] && ContentLength(last) == last.Length)
        {
            lines[^1] = last + lineBreak;
        }

        lines.Add(content + lineBreak);
    }

    /// <summary>Finds the first line of each declaration that a scene has at most once, without blanks at its ends.</summary>
    private static Dictionary<string, (int Index, string? Content)> FindDeclarations(List<string> lines)
    {
        var declarations = new Dictionary<string, (int Index, string? Content)>();
        for (var i = 0; i < lines.Count; i++)
        {
            var content = lines[i][MarkLength(lines[i])..].Trim();
            var wordLength = content.AsSpan().IndexOfAny(' ', '\t', '(');
            var word = wordLength < 0 ? content : content[..wordLength];
            if (UniqueWords.Contains(word))
            {
                declarations.TryAdd(word, (i, content));
            }
        }

        return declarations;
    }

    /// <summary>Splits a text behind its line breaks: \n, \r\n, or \r alone.</summary>
    private static List<string> SplitLines(string text)
    {
        var lines = new List<string>();
        for (var start = 0; start < text.Length;)
        {
            var end = Parser.SkipLine(new(text, start)).Offset;
            lines.Add(text[start..end]);
            start = end;
        }

        return lines;
    }

    /// <summary>
    /// Length of the byte order mark that a line begins with: as a character, or as bytes of UTF-8 that were read one by one.
    /// </summary>
    private static int MarkLength(string line) =>
        line.StartsWith('\uFEFF') ? 1 : line.StartsWith("\u00EF\u00BB\u00BF", StringComparison.Ordinal) ? 3 : 0;

    private static int ContentLength(string line) => line.AsSpan().TrimEnd("\r\n").Length;
}
