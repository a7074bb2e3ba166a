using FractalEngine.Core;

namespace FractalEngine.App.Shell.Reports;

/// <summary>Writes what the renderer has to tell about a scene to stderr.</summary>
internal static class Notices
{
    /// <summary>Writes each notice on a line. Files below the current folder are named relative to it, as the user names them.</summary>
    public static void Write(IEnumerable<string> notices)
    {
        var folder = CurrentFolder();
        foreach (var notice in notices)
        {
            Console.Error.WriteLine(DisplayText.Escape(
                folder is not null && notice.StartsWith(folder, StringComparison.Ordinal) ? notice[folder.Length..] : notice));
        }
    }

    /// <summary>The current folder with a slash at its end; null where it has been removed.</summary>
    private static string? CurrentFolder()
    {
        try
        {
            return Path.TrimEndingDirectorySeparator(Directory.GetCurrentDirectory()) + Path.DirectorySeparatorChar;
        }
        catch (IOException)
        {
            return null;
        }
    }
}
