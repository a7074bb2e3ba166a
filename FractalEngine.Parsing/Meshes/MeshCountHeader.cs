using System.Globalization;
using System.Text;
using FractalEngine.Parsing.Assets;

namespace FractalEngine.Parsing.Meshes;

/// <summary>The comment <c># Mesh count: N</c> at the head of an OBJ file, which tells its number of faces (paper §4.1.1).</summary>
public static class MeshCountHeader
{
    private const string Prefix = "# Mesh count:";

    /// <summary>
    /// Writes the comment into a file, or corrects the one that is there; everything else stays byte for byte. A file that is
    /// right already is not touched.
    /// </summary>
    /// <returns>True when the file was changed.</returns>
    /// <exception cref="IOException">The file can't be written.</exception>
    public static bool Update(string path, int faceCount)
    {
        // Latin-1 maps bytes to characters and back one to one, whatever the file's encoding.
        var text = Encoding.Latin1.GetString(File.ReadAllBytes(path));
        var updated = WithHeader(text, faceCount);
        if (updated == text)
        {
            return false;
        }

        AtomicFile.Write(path, stream => stream.Write(Encoding.Latin1.GetBytes(updated)));
        return true;
    }

    private static string WithHeader(string text, int faceCount)
    {
        const string byteOrderMark = "\u00EF\u00BB\u00BF";
        var header = string.Create(CultureInfo.InvariantCulture, $"{Prefix} {faceCount}");
        var lineBreak = text.Contains("\r\n", StringComparison.Ordinal) ? "\r\n" : "\n";
        var position = text.StartsWith(byteOrderMark, StringComparison.Ordinal) ? byteOrderMark.Length : 0;
        while (position < text.Length && text[position] == '#')
        {
            var end = text.AsSpan(position).IndexOfAny('\r', '\n') is >= 0 and var length ? position + length : text.Length;
            if (text.AsSpan(position).StartsWith(Prefix, StringComparison.OrdinalIgnoreCase))
            {
                return text[..position] + header + text[end..];
            }

            position = end < text.Length && text[end] == '\r' && end + 1 < text.Length && text[end + 1] == '\n'
                ? end + 2
                : Math.Min(end + 1, text.Length);
        }

        // The last comment of the head may be the end of the file, without a line break.
        var separator = position > 0 && text[position - 1] is not ('\n' or '\r' or '\u00BF') ? lineBreak : "";
        return text[..position] + separator + header + lineBreak + text[position..];
    }
}
