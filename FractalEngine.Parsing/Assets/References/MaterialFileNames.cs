namespace FractalEngine.Parsing.Assets.References;

/// <summary>
/// Splits the names behind one <c>mtllib</c>. The format separates them by blanks, yet programs write names that contain blanks. So a
/// name ends at a blank behind <c>.mtl</c> or a quote behind it, and a backslash makes a blank part of the name.
/// </summary>
internal static class MaterialFileNames
{
    private static readonly string[] Endings = [".mtl", ".mtl\"", ".mtl'"];

    /// <summary>Returns the single names in their order.</summary>
    public static IEnumerable<string> Split(string names)
    {
        var start = 0;
        for (var i = 0; i <= names.Length; i++)
        {
            var isEnd = i == names.Length || (names[i] is ' ' or '\t' && HasEnding(names[start..i]));
            if (isEnd && names[start..i].Trim() is { Length: > 0 } name)
            {
                yield return name.Replace("\\ ", " ", StringComparison.Ordinal);
                start = i + 1;
            }
        }
    }

    private static bool HasEnding(string name) =>
        Array.Exists(Endings, ending => name.EndsWith(ending, StringComparison.OrdinalIgnoreCase));
}
