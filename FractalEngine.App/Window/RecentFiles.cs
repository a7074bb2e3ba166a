using System.Collections.Immutable;
using System.Text;
using FractalEngine.Core.Files;

namespace FractalEngine.App.Window;

/// <summary>The files that were opened last, in the settings folder of the user: one full path a line, the latest first.</summary>
/// <param name="path">Full path of the list; null where the system has no settings folder, and nothing is kept.</param>
/// <param name="report">Shows a message about a list that can't be used.</param>
internal sealed class RecentFiles(string? path, Action<string> report)
{
    /// <summary>Maximum number of files in the list.</summary>
    public const int MaxFiles = 10;

    private const int MaxBytes = 1 << 16;

    private static readonly UTF8Encoding StrictUtf8 = new(encoderShouldEmitUTF8Identifier: false, throwOnInvalidBytes: true);

    private bool _isBrokenReported;

    /// <summary>Full path of the list of this user; null where the system has no settings folder.</summary>
    public static string? DefaultPath
    {
        get
        {
            var folder = Environment.GetFolderPath(
                Environment.SpecialFolder.ApplicationData, Environment.SpecialFolderOption.DoNotVerify);
            return folder.Length == 0 ? null : Path.Combine(folder, "FractalEngine", "recent.txt");
        }
    }

    /// <summary>Reads the list. A broken one counts as empty, with one message.</summary>
    public ImmutableArray<string> Read()
    {
        if (path is null || !File.Exists(path))
        {
            return [];
        }

        try
        {
            if (new FileInfo(path).Length > MaxBytes)
            {
                throw new InvalidDataException("it is too large");
            }

            var lines = StrictUtf8.GetString(File.ReadAllBytes(path)).Split('\n', StringSplitOptions.RemoveEmptyEntries);
            return Array.TrueForAll(lines, static line => Path.IsPathFullyQualified(line) && !line.Any(char.IsControl))
                ? [.. lines.Take(MaxFiles)]
                : throw new InvalidDataException("a line is no path");
        }
        catch (Exception exception)
            when (exception is IOException or UnauthorizedAccessException or InvalidDataException or DecoderFallbackException)
        {
            Report($"the list of recent files is ignored: {path}: {exception.Message}");
            return [];
        }
    }

    /// <summary>Puts a file at the beginning of the list.</summary>
    /// <param name="file">Full path of the file.</param>
    public void Add(string file)
    {
        if (path is null || file.Any(char.IsControl))
        {
            return;
        }

        var lines = Read().Remove(file).Insert(0, file).Take(MaxFiles);
        try
        {
            var text = StrictUtf8.GetBytes(string.Concat(lines.Select(static line => line + "\n")));
            AtomicFile.Write(path, stream => stream.Write(text));
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException or EncoderFallbackException)
        {
            Report($"the list of recent files can't be written: {exception.Message}");
        }
    }

    private void Report(string message)
    {
        if (!_isBrokenReported)
        {
            _isBrokenReported = true;
            report($"warning: {message}");
        }
    }
}
