using System.Globalization;
using System.Text;
using FractalEngine.Core.Files;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Meshes;

/// <summary>Maintains the comment <c># Mesh count: N</c> at the head of an OBJ file: its number of faces (paper §4.1.1).</summary>
public static class MeshCountHeader
{
    private const string Prefix = "# Mesh count:";

    /// <summary>
    /// Writes the comment into a file or corrects an existing one. All other bytes are kept. A file with the right comment is not
    /// written.
    /// </summary>
    /// <param name="path">Path of an OBJ file in UTF-16 with a byte order mark, or in any encoding that extends ASCII.</param>
    /// <param name="faceCount">Number of triangles to record, not negative.</param>
    /// <returns>True if the file was changed.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative.</exception>
    /// <exception cref="IOException">The file can't be read or written.</exception>
    public static bool Update(string path, int faceCount)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(faceCount);
        // Latin-1 maps bytes to characters one to one, whatever the encoding of the file.
        var bytes = File.ReadAllBytes(path);
        var encoding = Utf16Text.FindEncoding(bytes) ?? Encoding.Latin1;
        var text = encoding.GetString(bytes);
        var updated = WithHeader(text, faceCount);
        if (updated == text)
        {
            return false;
        }

        AtomicFile.Write(path, stream => stream.Write(encoding.GetBytes(updated)));
        return true;
    }

    /// <summary>Returns the comment for a number of triangles, without a line break.</summary>
    internal static string Format(long faceCount) => string.Create(CultureInfo.InvariantCulture, $"{Prefix} {faceCount}");

    private static string WithHeader(string text, int faceCount)
    {
        // The mark of UTF-8 as Latin-1 characters.
        const string byteOrderMark = "\u00EF\u00BB\u00BF";
        var header = Format(faceCount);
        var lineBreak = SourceText.LineBreakOf(text);
        var position = text.StartsWith(byteOrderMark, StringComparison.Ordinal) ? byteOrderMark.Length
            : text.StartsWith('\uFEFF') ? 1 : 0;
        while (position < text.Length && text[position] == '#')
        {
            var lineLength = text.AsSpan(position).IndexOfAny('\r', '\n');
            var end = lineLength < 0 ? text.Length : position + lineLength;
            if (text.AsSpan(position).StartsWith(Prefix, StringComparison.OrdinalIgnoreCase))
            {
                return text[..position] + header + text[end..];
            }

            var isCrLf = text.AsSpan(end).StartsWith("\r\n", StringComparison.Ordinal);
            position = isCrLf ? end + 2 : Math.Min(end + 1, text.Length);
        }

        // The last comment at the head may end the file without a line break.
        var separator = position > 0 && text[position - 1] is not ('\n' or '\r' or '\u00BF' or '\uFEFF') ? lineBreak : "";
        return text[..position] + separator + header + lineBreak + text[position..];
    }
}
