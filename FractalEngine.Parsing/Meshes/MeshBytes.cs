using System.Text;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Meshes;

/// <summary>
/// The bytes of a PLY or STL file, which are text, or numbers, or text before numbers. Errors in text have a line and a column, errors in
/// numbers the offset of a byte.
/// </summary>
/// <remarks>A string of a large file would take twice its memory, and can't hold the largest one.</remarks>
internal sealed class MeshBytes
{
    private readonly string _fileName;

    /// <summary>Wraps the contents of a file.</summary>
    /// <param name="fileName">Name of the file in messages.</param>
    /// <param name="contents">All bytes of the file.</param>
    public MeshBytes(string fileName, ReadOnlySpan<byte> contents)
        : this(fileName, contents.Length) => contents.CopyTo(Buffer);

    private MeshBytes(string fileName, int length)
    {
        _fileName = fileName;
        Length = length;
        Buffer = new byte[length + 1 + Utf8NumberReader.Padding];
        Buffer.AsSpan(length).Fill((byte)'\n');
    }

    /// <summary>The file, and behind it a line feed and the padding of <see cref="Utf8NumberReader"/>.</summary>
    public byte[] Buffer { get; }

    /// <summary>Size of the file in bytes.</summary>
    public int Length { get; }

    /// <summary>The bytes of the file.</summary>
    public ReadOnlySpan<byte> Contents => Buffer.AsSpan(0, Length);

    /// <summary>Reads a whole file into memory.</summary>
    /// <param name="path">Path of the file.</param>
    /// <param name="fileName">Name of the file in messages.</param>
    /// <exception cref="SourceException">The file is missing, unreadable or too large.</exception>
    public static MeshBytes Read(string path, string fileName)
    {
        using var stream = SourceText.OpenFile(path, fileName, ParsingLimits.ObjBytes.Value);
        var bytes = new MeshBytes(fileName, (int)stream.Length);
        return SourceText.Access(fileName, () =>
        {
            stream.ReadExactly(bytes.Buffer, 0, bytes.Length);
            return bytes;
        });
    }

    /// <summary>Creates the error of a position in text.</summary>
    /// <param name="position">Offset in bytes.</param>
    /// <param name="message">One line of text without a full stop.</param>
    /// <param name="isLimitExceeded">True when the text is valid but exceeds a stated limit.</param>
    public SourceException TextError(int position, string message, bool isLimitExceeded = false) =>
        new(Diagnose(position, message) with { IsLimitExceeded = isLimitExceeded });

    /// <summary>Creates the error of a position among numbers.</summary>
    /// <param name="position">Offset in bytes.</param>
    /// <param name="message">One line of text without a full stop.</param>
    /// <param name="isLimitExceeded">True when the file is valid but exceeds a stated limit.</param>
    public SourceException ByteError(int position, string message, bool isLimitExceeded = false) =>
        new(_fileName, FormattableString.Invariant($"byte {position}: {message}"), isLimitExceeded);

    /// <summary>Creates a diagnostic for a position in text.</summary>
    /// <param name="position">Offset in bytes.</param>
    /// <param name="message">One line of text without a full stop.</param>
    /// <param name="severity">Severity of the diagnostic.</param>
    public Diagnostic Diagnose(int position, string message, DiagnosticSeverity severity = DiagnosticSeverity.Error)
    {
        var before = Contents[..position];
        var lineStart = before.LastIndexOfAny((byte)'\n', (byte)'\r') + 1;
        var length = Contents[lineStart..].IndexOfAny((byte)'\n', (byte)'\r');
        var end = length < 0 ? Length : lineStart + length;
        // A CR LF is one line break, and only its LF counts.
        var lineBreaks = before.Count((byte)'\n') + before.Count((byte)'\r') - before.Count("\r\n"u8);
        var line = new SourceText(_fileName, Encoding.UTF8.GetString(Contents[lineStart..end])) { FirstLine = 1 + lineBreaks };
        return line.Diagnose(Encoding.UTF8.GetCharCount(Contents[lineStart..position]), message, severity);
    }

    /// <summary>Creates a warning about the file as a whole.</summary>
    /// <param name="message">One line of text without a full stop.</param>
    public Diagnostic Warn(string message) => new(_fileName, 1, 1, DiagnosticSeverity.Warning, message);
}
