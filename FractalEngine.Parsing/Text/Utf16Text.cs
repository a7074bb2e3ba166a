using System.Text;

namespace FractalEngine.Parsing.Text;

/// <summary>Turns UTF-16 text, which Windows programs write behind a byte order mark, into UTF-8.</summary>
internal static class Utf16Text
{
    /// <summary>Number of bytes of a byte order mark.</summary>
    public const int MarkLength = 2;

    /// <summary>Returns the encoding of the byte order mark that a file begins with; null if it is none of UTF-16.</summary>
    /// <param name="bytes">Beginning of the file.</param>
    public static Encoding? FindEncoding(ReadOnlySpan<byte> bytes) => bytes switch
    {
        [0xFF, 0xFE, ..] => Encoding.Unicode,
        [0xFE, 0xFF, ..] => Encoding.BigEndianUnicode,
        _ => null,
    };

    /// <summary>Converts the bytes of a file; the byte order mark becomes that of UTF-8.</summary>
    /// <param name="bytes">The whole file.</param>
    /// <param name="encoding">Encoding of its byte order mark.</param>
    /// <param name="acceptFaults">Whether faulty characters are replaced.</param>
    /// <exception cref="DecoderFallbackException">A character is faulty.</exception>
    public static byte[] ToUtf8(ReadOnlySpan<byte> bytes, Encoding encoding, bool acceptFaults)
    {
        if (!acceptFaults)
        {
            encoding = Encoding.GetEncoding(encoding.CodePage, EncoderFallback.ExceptionFallback, DecoderFallback.ExceptionFallback);
        }

        return Encoding.UTF8.GetBytes(encoding.GetString(bytes));
    }

    /// <summary>Converts a file, replacing faulty characters, without holding it as a string.</summary>
    /// <param name="stream">Stream at its beginning, which stays open.</param>
    /// <param name="encoding">Encoding of its byte order mark.</param>
    public static MemoryStream ToUtf8(Stream stream, Encoding encoding)
    {
        using var transcoder = Encoding.CreateTranscodingStream(stream, encoding, Encoding.UTF8, leaveOpen: true);
        // ASCII characters take half of the bytes.
        var text = new MemoryStream((int)Math.Min((stream.Length / 2) + MarkLength, Array.MaxLength));
        transcoder.CopyTo(text);
        text.Position = 0;
        return text;
    }
}
