using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App.Shell;

/// <summary>Reads text from the standard input, where a file is named <c>-</c>.</summary>
internal static class StandardInput
{
    /// <summary>The name that stands for the standard input, or for the standard output where something is written.</summary>
    public const string Name = "-";

    // A shell passes a pipe under these names, which can't be opened as a file.
    private static readonly string[] Paths = [Name, "/dev/stdin", "/dev/fd/0", "/proc/self/fd/0"];

    private static bool _isRead;

    public static bool IsNamedBy(string path) => Paths.Contains(path);

    /// <summary>Reads all text of the standard input.</summary>
    /// <param name="name">Name of the text in messages.</param>
    /// <param name="maxBytes">Size limit; more is refused.</param>
    /// <exception cref="SourceException">The input is closed, unreadable, too large, or no text.</exception>
    /// <exception cref="UsageException">It was read before.</exception>
    public static SourceText Read(string name, long maxBytes)
    {
        if (_isRead)
        {
            throw NamedTwice();
        }

        _isRead = true;
        if (StandardStreams.IsClosed(0))
        {
            throw new SourceException(name, "the standard input is closed");
        }

        using var bytes = new MemoryStream();
        try
        {
            ReadAll(bytes, name, maxBytes);
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            throw new SourceException(name, $"the standard input can't be read: {exception.Message}");
        }

        return SourceText.Decode(bytes.GetBuffer().AsSpan(0, (int)bytes.Length), name);
    }

    /// <summary>Reads all text of a file, or of the standard input where that is named.</summary>
    /// <param name="path">Path of the file, which is its name in messages.</param>
    /// <param name="maxBytes">Size limit; more is refused.</param>
    /// <exception cref="SourceException">The text can't be read.</exception>
    /// <exception cref="UsageException">It is the standard input, and was read before.</exception>
    public static SourceText ReadOrFile(string path, long maxBytes) =>
        IsNamedBy(path) ? Read(path, maxBytes) : SourceText.Read(Path.GetFullPath(path), path, maxBytes);

    /// <summary>Refuses two names of the standard input before either is read.</summary>
    /// <exception cref="UsageException">Both are the standard input.</exception>
    public static void RequireOnce(string path1, string path2)
    {
        if (IsNamedBy(path1) && IsNamedBy(path2))
        {
            throw NamedTwice();
        }
    }

    private static UsageException NamedTwice() => new("the standard input is named twice, and can be read once");

    private static void ReadAll(MemoryStream bytes, string name, long maxBytes)
    {
        using var input = Console.OpenStandardInput();
        var buffer = new byte[1 << 16];
        for (var count = input.Read(buffer); count > 0; count = input.Read(buffer))
        {
            bytes.Write(buffer, 0, count);
            if (bytes.Length > maxBytes)
            {
                throw new SourceException(name, $"the standard input has more than the limit of {maxBytes} bytes", isLimitExceeded: true);
            }
        }
    }

    /// <summary>Adds the text of the standard input to the options of a file that is named <c>-</c>.</summary>
    public static LoadOptions AddTo(LoadOptions options, string path) =>
        path == Name ? options with { Text = Read(Name, Parsing.Text.ParsingLimits.DescriptionBytes.Value) } : options;
}
