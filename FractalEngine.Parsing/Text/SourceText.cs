using System.Text;
using FractalEngine.Core.Files;

namespace FractalEngine.Parsing.Text;

/// <summary>Text of a file, or some lines of it, together with the name that messages use for it.</summary>
/// <param name="fileName">Name of the file in messages.</param>
/// <param name="text">Characters without a byte order mark.</param>
public sealed class SourceText(string fileName, string text)
{
    private static readonly UTF8Encoding StrictUtf8 = new(encoderShouldEmitUTF8Identifier: false, throwOnInvalidBytes: true);

    // Many errors of one text come in order: each search goes on where the last one ended.
    private LineStartPosition? _lastLine;

    /// <summary>Name of the file in messages.</summary>
    public string FileName { get; } = fileName;

    /// <summary>Characters of the text, without a byte order mark.</summary>
    public string Text { get; } = text;

    /// <summary>Number in the file, from 1, of the line that the text begins with: more than 1 for an excerpt.</summary>
    internal int FirstLine { get; init; } = 1;

    /// <summary>Whether the file began with a byte order mark, of UTF-8 or UTF-16; the text is without it.</summary>
    public bool HasByteOrderMark { get; init; }

    /// <summary>Size of the file that was read or decoded, in bytes; 0 for a text that comes from no file.</summary>
    public long ByteCount { get; private init; }

    /// <summary>Line break of the text: CR LF if it occurs anywhere, else LF.</summary>
    public string LineBreak => LineBreakOf(Text);

    /// <summary>Position before the first character.</summary>
    public Cursor Start => new(Text, 0);

    /// <summary>Reads a file that holds UTF-8 text, or UTF-16 behind a byte order mark.</summary>
    /// <param name="path">Path of the file, absolute or relative to the current directory.</param>
    /// <param name="fileName">Name of the file in messages.</param>
    /// <param name="maxBytes">Size limit; larger files are refused before anything is read.</param>
    /// <param name="acceptLatin1">Whether text that is not UTF-8 is read as Latin-1, which old exporters wrote in comments.</param>
    /// <exception cref="SourceException">The file is missing, unreadable, too large or not text of that encoding.</exception>
    public static SourceText Read(string path, string fileName, long maxBytes, bool acceptLatin1 = false)
    {
        return Decode(ReadBytes(path, fileName, maxBytes), fileName, acceptLatin1);
    }

    /// <summary>Reads the bytes of a file, which need not be text.</summary>
    /// <param name="path">Path of the file, absolute or relative to the current directory.</param>
    /// <param name="fileName">Name of the file in messages.</param>
    /// <param name="maxBytes">Size limit; larger files are refused before anything is read.</param>
    /// <exception cref="SourceException">The file is missing, unreadable or too large, or it is a folder, a pipe or a device.</exception>
    public static byte[] ReadBytes(string path, string fileName, long maxBytes)
    {
        using var stream = OpenFile(path, fileName, maxBytes);
        return Access(fileName, () => ReadAll(stream));
    }

    /// <summary>Decodes the bytes of a text file, with the rules of <see cref="Read"/>.</summary>
    /// <exception cref="SourceException">The bytes are not text of that encoding.</exception>
    public static SourceText Decode(ReadOnlySpan<byte> bytes, string fileName, bool acceptLatin1 = false)
    {
        var byteCount = bytes.Length;
        if (Utf16Text.FindEncoding(bytes) is { } utf16)
        {
            bytes = DecodeUtf16(bytes, fileName, utf16, acceptLatin1);
        }

        var hasMark = MeasureByteOrderMark(bytes) > 0;
        bytes = bytes[MeasureByteOrderMark(bytes)..];
        // Text has no NUL bytes; UTF-16 without a byte order mark and all binary formats do.
        if (bytes.IndexOf((byte)0) is >= 0 and var position)
        {
            var before = bytes[..position];
            throw NulError(fileName, before.Count((byte)'\n'), position - before.LastIndexOf((byte)'\n'));
        }

        try
        {
            return new(fileName, StrictUtf8.GetString(bytes)) { ByteCount = byteCount, HasByteOrderMark = hasMark };
        }
        catch (DecoderFallbackException) when (acceptLatin1)
        {
            return new(fileName, Encoding.Latin1.GetString(bytes)) { ByteCount = byteCount };
        }
        catch (DecoderFallbackException exception)
        {
            var before = bytes[..Math.Max(exception.Index, 0)];
            throw new SourceException(new Diagnostic(fileName, 1 + before.Count((byte)'\n'), before.Length - before.LastIndexOf((byte)'\n'),
                DiagnosticSeverity.Error, "the file has a byte that is no UTF-8 text"));
        }
    }

    /// <summary>Opens a file for reading, with the errors of <see cref="Read"/>. The stream has a length and can seek.</summary>
    /// <param name="path">Path of the file, absolute or relative to the current directory.</param>
    /// <param name="fileName">Name of the file in messages.</param>
    /// <param name="maxBytes">Size limit; larger files are refused.</param>
    internal static FileStream OpenFile(string path, string fileName, long maxBytes) =>
        Access(fileName, () => Open(path, fileName, maxBytes));

    /// <summary>Accesses a file, and turns what the system reports into the errors of <see cref="Read"/>.</summary>
    internal static T Access<T>(string fileName, Func<T> access)
    {
        try
        {
            return access();
        }
        catch (Exception exception) when (exception is FileNotFoundException or DirectoryNotFoundException)
        {
            throw new SourceException(fileName, "file not found");
        }
        catch (Exception exception)
            when (exception is IOException or UnauthorizedAccessException or NotSupportedException or ArgumentException)
        {
            throw new SourceException(fileName, $"the file can't be read: {exception.Message}");
        }
    }

    /// <summary>Returns the length in bytes of the UTF-8 mark that a file begins with, or 0.</summary>
    internal static int MeasureByteOrderMark(ReadOnlySpan<byte> bytes) =>
        bytes.StartsWith((ReadOnlySpan<byte>)[0xEF, 0xBB, 0xBF]) ? 3 : 0;

    /// <summary>Creates the error of a file with a NUL byte.</summary>
    /// <param name="fileName">Name of the file in messages.</param>
    /// <param name="lineFeeds">Number of LF bytes before the NUL byte.</param>
    /// <param name="column">Number of the NUL byte behind the last of them, from 1.</param>
    internal static SourceException NulError(string fileName, int lineFeeds, int column) => new(new Diagnostic(
        fileName, 1 + lineFeeds, column, DiagnosticSeverity.Error, "the file is binary (it has a NUL byte), expected UTF-8 text"));

    /// <summary>Returns the line break that a text uses: CR LF if it occurs anywhere, else LF.</summary>
    internal static string LineBreakOf(string text) => text.Contains("\r\n", StringComparison.Ordinal) ? "\r\n" : "\n";

    /// <summary>Creates a diagnostic for a position in this text.</summary>
    /// <param name="offset">Characters before the position; positions behind the end count as the end.</param>
    /// <param name="message">One line of text without a full stop.</param>
    /// <param name="severity">Severity of the diagnostic.</param>
    /// <remarks>Searches the text for the line from the last one that was found: O(offset), but linear for all errors in order.</remarks>
    public Diagnostic Diagnose(int offset, string message, DiagnosticSeverity severity = DiagnosticSeverity.Error)
    {
        offset = Math.Min(offset, Text.Length);
        var line = FindLine(offset, out var lineStart);
        return new(FileName, line, 1 + offset - lineStart, severity, message, new Cursor(Text, lineStart).RestOfLine.ToString());
    }

    /// <summary>Returns the number, from 1, of the line that holds a position. Cost O(offset).</summary>
    /// <param name="offset">Characters before the position; positions behind the end count as the end.</param>
    public int LineOf(int offset) => FindLine(Math.Min(offset, Text.Length), out _);

    /// <summary>Creates an exception for a position in this text.</summary>
    public SourceException Error(int offset, string message, bool isLimitExceeded = false) =>
        new(Diagnose(offset, message) with { IsLimitExceeded = isLimitExceeded });

    private static byte[] DecodeUtf16(ReadOnlySpan<byte> bytes, string fileName, Encoding encoding, bool acceptFaults)
    {
        try
        {
            return Utf16Text.ToUtf8(bytes, encoding, acceptFaults);
        }
        catch (DecoderFallbackException)
        {
            throw new SourceException(fileName, "the file has a character that is no UTF-16 text");
        }
    }

    private int FindLine(int offset, out int lineStart)
    {
        var known = _lastLine is { } last && last.LineStart <= offset ? last : new(FirstLine, 0);
        var line = known.Line;
        lineStart = known.LineStart;
        for (var i = lineStart; i < offset; i++)
        {
            // A line ends with \n, \r\n or, on old systems, \r alone.
            if (Text[i] == '\n' || (Text[i] == '\r' && !(i + 1 < Text.Length && Text[i + 1] == '\n')))
            {
                line++;
                lineStart = i + 1;
            }
        }

        _lastLine = new(line, lineStart);
        return line;
    }

    /// <summary>The start of a line.</summary>
    private sealed record LineStartPosition(int Line, int LineStart);

    private static FileStream Open(string path, string fileName, long maxBytes)
    {
        if (Directory.Exists(path))
        {
            throw new SourceException(fileName, "this is a directory, expected a file");
        }

        // Opening a pipe waits for a writer, perhaps for ever.
        if (FileTypes.IsSpecial(path))
        {
            throw new SourceException(fileName, "this is a pipe or a device, expected a file");
        }

        var stream = new FileStream(path, FileMode.Open, FileAccess.Read, FileShare.Read, bufferSize: 0, FileOptions.SequentialScan);
        try
        {
            if (stream.CanSeek && stream.Length > maxBytes)
            {
                throw new SourceException(fileName, $"the file has {stream.Length} bytes, more than the limit of {maxBytes}",
                    isLimitExceeded: true);
            }

            return stream.Length == 0 && stream.ReadByte() >= 0
                ? throw new SourceException(fileName, "this is a pipe or a device, expected a file")
                : stream;
        }
        catch
        {
            stream.Dispose();
            throw;
        }
    }

    private static byte[] ReadAll(FileStream stream)
    {
        var bytes = new byte[stream.Length];
        stream.ReadExactly(bytes);
        return bytes;
    }
}
