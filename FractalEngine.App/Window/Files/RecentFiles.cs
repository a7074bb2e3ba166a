using System.Collections.Immutable;

namespace FractalEngine.App.Window.Files;

/// <summary>The files that were opened last, in the settings folder of the user: one full path a line, the latest first.</summary>
/// <param name="path">Full path of the list; null where the system has no settings folder, and nothing is kept.</param>
/// <param name="report">Shows a message about a list that can't be used.</param>
internal sealed class RecentFiles(string? path, Action<string> report)
{
    public const int MaxFiles = 10;

    private bool _isBrokenReported;

    /// <summary>Full path of the list of this user; null where the system has no settings folder.</summary>
    public static string? DefaultPath => UserFile.PathOf("recent.txt");

    /// <summary>Reads the list. A broken one counts as empty, with one message.</summary>
    public ImmutableArray<string> Read() => UserFile.Read<ImmutableArray<string>>(
        path, [],
        static text =>
        {
            var lines = text.Split('\n', StringSplitOptions.RemoveEmptyEntries);
            return Array.TrueForAll(lines, static line => Path.IsPathFullyQualified(line) && !line.Any(char.IsControl))
                ? [.. lines.Take(MaxFiles)]
                : throw new InvalidDataException("a line is no path");
        },
        "the list of recent files is", Report);

    /// <summary>Puts a file at the beginning of the list.</summary>
    /// <param name="file">Full path of the file.</param>
    public void Add(string file)
    {
        if (path is not null && !file.Any(char.IsControl))
        {
            var lines = Read().Remove(file).Insert(0, file).Take(MaxFiles);
            UserFile.Write(path, string.Concat(lines.Select(static line => line + "\n")), "the list of recent files", Report);
        }
    }

    private void Report(string message)
    {
        if (!_isBrokenReported)
        {
            _isBrokenReported = true;
            report(message);
        }
    }
}
