using System.Globalization;
using System.Text;
using FractalEngine.Core.Files;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Wavefront.Writing;

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
        var start = text.StartsWith(byteOrderMark, StringComparison.Ordinal) ? byteOrderMark.Length
            : text.StartsWith('\uFEFF') ? 1 : 0;
        var lineBreak = FirstLineBreak(text);
        var position = start;
        while (position < text.Length && text[position] == '#')
        {
            var lineLength = text.AsSpan(position).IndexOfAny('\r', '\n');
            var end = lineLength < 0 ? text.Length : position + lineLength;
            if (FindNumber(text.AsSpan(position, end - position)) is var (numberStart, length))
            {
                var blank = text[position + numberStart - 1] == ':' ? " " : "";
                var number = blank + faceCount.ToString(CultureInfo.InvariantCulture);
                return text[..(position + numberStart)] + number + text[(position + numberStart + length)..];
            }

            // The new line ends as the one before it.
            lineBreak = end < text.Length ? LineBreakAt(text, end) : lineBreak;
            position = Math.Min(end + lineBreak.Length, text.Length);
        }

        // The last comment at the head may end the file without a line break.
        var separator = position > start && text[position - 1] is not ('\n' or '\r') ? lineBreak : "";
        return text[..position] + separator + Format(faceCount) + lineBreak + text[position..];
    }

    /// <summary>Finds the number of the comment, or the place for it; null for any other comment.</summary>
    private static (int Start, int Length)? FindNumber(ReadOnlySpan<char> comment)
    {
        if (!comment.StartsWith(Prefix, StringComparison.OrdinalIgnoreCase))
        {
            return null;
        }

        var rest = comment[Prefix.Length..];
        var number = rest.TrimStart(" \t");
        var digits = number.IndexOfAnyExceptInRange('0', '9') is var count and >= 0 ? count : number.Length;
        var behind = number[digits..];
        if (number.IsEmpty)
        {
            return (Prefix.Length, 0);
        }

        // "# Mesh count: 5.5 kg" is somebody's remark.
        return digits > 0 && (behind.IsEmpty || behind[0] is ' ' or '\t' or ',' or ';' or '(')
            ? (comment.Length - number.Length, digits)
            : null;
    }

    private static string FirstLineBreak(string text) =>
        text.AsSpan().IndexOfAny('\r', '\n') is var index and >= 0 ? LineBreakAt(text, index) : "\n";

    private static string LineBreakAt(string text, int index) =>
        text.AsSpan(index).StartsWith("\r\n", StringComparison.Ordinal) ? "\r\n" : text[index..(index + 1)];
}
