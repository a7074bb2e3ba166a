using System.Text;

namespace FractalEngine.Parsing.Text;

/// <summary>The text of a file together with the name that messages call it by.</summary>
public sealed class SourceText
{
    private static readonly UTF8Encoding StrictUtf8 = new(encoderShouldEmitUTF8Identifier: false, throwOnInvalidBytes: true);

    /// <summary>A text that need not come from a file.</summary>
    public SourceText(string fileName, string text) => (FileName, Text) = (fileName, text);

    /// <summary>What messages call the file.</summary>
    public string FileName { get; }

    /// <summary>The characters, without a byte order mark.</summary>
    public string Text { get; }

    /// <summary>The place before the first character.</summary>
    public Cursor Start => new(Text, 0);

    /// <summary>Reads a file of UTF-8 text.</summary>
    /// <param name="path">Where the file is.</param>
    /// <param name="fileName">What messages call it.</param>
    /// <param name="maxBytes">Longer files are refused before anything is read.</param>
    /// <param name="acceptLatin1">Whether bytes that are no UTF-8 are read as Latin-1, as old exporters wrote their comments.</param>
    /// <exception cref="SourceException">The file is missing, unreadable, too long, or no text of that encoding.</exception>
    public static SourceText Read(string path, string fileName, long maxBytes, bool acceptLatin1 = false)
    {
        var bytes = ReadBytes(path, fileName, maxBytes);
        return Decode(bytes, fileName, acceptLatin1);
    }

    /// <summary>Decodes the bytes of a file; see <see cref="Read"/>.</summary>
    public static SourceText Decode(ReadOnlySpan<byte> bytes, string fileName, bool acceptLatin1 = false)
    {
        if (bytes.StartsWith((ReadOnlySpan<byte>)[0xFF, 0xFE]) || bytes.StartsWith((ReadOnlySpan<byte>)[0xFE, 0xFF]))
        {
            throw new SourceException(fileName, "the file is UTF-16 text, expected UTF-8: save it in that encoding");
        }

        if (bytes.StartsWith((ReadOnlySpan<byte>)[0xEF, 0xBB, 0xBF]))
        {
            bytes = bytes[3..];
        }

        // No text has NUL bytes; UTF-16 without a byte order mark and all binary formats do.
        if (bytes.IndexOf((byte)0) is >= 0 and var position)
        {
            throw BinaryFileError(bytes, position, fileName, "the file is binary (it has a NUL byte), expected UTF-8 text");
        }

        try
        {
            return new(fileName, StrictUtf8.GetString(bytes));
        }
        catch (DecoderFallbackException) when (acceptLatin1)
        {
            return new(fileName, Encoding.Latin1.GetString(bytes));
        }
        catch (DecoderFallbackException exception)
        {
            throw BinaryFileError(bytes, Math.Max(exception.Index, 0), fileName, "the file has a byte that is no UTF-8 text");
        }
    }

    /// <summary>A diagnostic for a place in this text.</summary>
    public Diagnostic Diagnose(int offset, string message, DiagnosticSeverity severity = DiagnosticSeverity.Error)
    {
        offset = Math.Min(offset, Text.Length);
        var (line, lineStart) = (1, 0);
        for (var i = 0; i < offset; i++)
        {
            // A line ends with \n, \r\n or, on old systems, \r alone.
            if (Text[i] == '\n' || (Text[i] == '\r' && !(i + 1 < Text.Length && Text[i + 1] == '\n')))
            {
                (line, lineStart) = (line + 1, i + 1);
            }
        }

        var length = Text.AsSpan(lineStart).IndexOfAny('\n', '\r');
        return new(
            FileName,
            line,
            1 + offset - lineStart,
            severity,
            message,
            length < 0 ? Text[lineStart..] : Text.Substring(lineStart, length));
    }

    /// <summary>An exception for a place in this text.</summary>
    public SourceException Error(int offset, string message, bool isLimitExceeded = false) =>
        new(Diagnose(offset, message) with { IsLimitExceeded = isLimitExceeded });

    private static byte[] ReadBytes(string path, string fileName, long maxBytes)
    {
        try
        {
            if (Directory.Exists(path))
            {
                throw new SourceException(fileName, "this is a directory, expected a file");
            }

            if (new FileInfo(path) is { Exists: true, Length: 0 } && IsPipe(path))
            {
                throw new SourceException(fileName, "this is a pipe or a device, expected a file");
            }

            using var stream = new FileStream(path, FileMode.Open, FileAccess.Read, FileShare.Read, bufferSize: 0,
                FileOptions.SequentialScan);
            if (stream.CanSeek && stream.Length > maxBytes)
            {
                throw new SourceException(fileName, $"the file has {stream.Length} bytes, more than the limit of {maxBytes}",
                    isLimitExceeded: true);
            }

            return stream.Length == 0 && stream.ReadByte() >= 0
                ? throw new SourceException(fileName, "this is a pipe or a device, expected a file")
                : ReadAll(stream);
        }
        catch (Exception exception) when (exception is FileNotFoundException or DirectoryNotFoundException)
        {
            throw new SourceException(fileName, "file not found");
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException or NotSupportedException
        or ArgumentException)
        {
            throw new SourceException(fileName, $"the file can't be read: {exception.Message}");
        }
    }

    /// <summary>
    /// Pipes say that they are empty, and opening one for reading waits for a writer, perhaps for ever. Opening it for both does not wait,
    /// and does an empty file no harm.
    /// </summary>
    private static bool IsPipe(string path)
    {
        try
        {
            using var stream = new FileStream(path, FileMode.Open, FileAccess.ReadWrite, FileShare.ReadWrite, bufferSize: 0);
            return !stream.CanSeek;
        }
        catch (UnauthorizedAccessException)
        {
            // A file that may only be read; opening it says more.
            return false;
        }
    }

    private static byte[] ReadAll(FileStream stream)
    {
        var bytes = new byte[stream.Length];
        stream.ReadExactly(bytes);
        return bytes;
    }

    private static SourceException BinaryFileError(ReadOnlySpan<byte> bytes, int position, string fileName, string message)
    {
        var before = bytes[..position];
        return new(new Diagnostic(
            fileName, 1 + before.Count((byte)'\n'), position - before.LastIndexOf((byte)'\n'), DiagnosticSeverity.Error, message));
    }
}
