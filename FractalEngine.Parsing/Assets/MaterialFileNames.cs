namespace FractalEngine.Parsing.Assets;

/// <summary>
/// The names behind one <c>mtllib</c>. The format separates them by blanks, yet programs write names with blanks in them; so a name ends
/// where
/// <c>.mtl</c> stands before a blank. A backslash before a blank makes it a part of the name.
/// </summary>
internal static class MaterialFileNames
{
    private const string Extension = ".mtl";

    /// <summary>The single names, in order.</summary>
    public static IEnumerable<string> Split(string names)
    {
        var start = 0;
        for (var i = 0; i <= names.Length; i++)
        {
            var isEnd = i == names.Length
                || (names[i] is ' ' or '\t' && names.AsSpan(start, i - start).EndsWith(Extension, StringComparison.OrdinalIgnoreCase));
            if (isEnd && names[start..i].Trim() is { Length: > 0 } name)
            {
                yield return name.Replace("\\ ", " ", StringComparison.Ordinal);
                start = i + 1;
            }
        }
    }
}
