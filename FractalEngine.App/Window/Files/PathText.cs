namespace FractalEngine.App.Window.Files;

/// <summary>Turns paths into the texts that people write, and back.</summary>
internal static class PathText
{
    /// <summary>Returns a path relative to the current folder if it lies there, else in full.</summary>
    public static string Shorten(string path)
    {
        var relative = Path.GetRelativePath(Directory.GetCurrentDirectory(), path);
        return relative.StartsWith("..", StringComparison.Ordinal) || Path.IsPathRooted(relative) ? path : relative;
    }

    /// <summary>Returns the full path of a text; <c>~</c> is the home folder.</summary>
    /// <param name="text">What a user has typed.</param>
    /// <param name="ending">What a name gets that has no ending.</param>
    public static string Expand(string text, string ending = "")
    {
        var path = text.Trim();
        path = path.Length > 0 && Path.GetExtension(path).Length == 0 ? path + ending : path;
        if (path is "~" || path.StartsWith("~/", StringComparison.Ordinal))
        {
            path = Environment.GetFolderPath(Environment.SpecialFolder.UserProfile) + path[1..];
        }

        return path.Length == 0 || path.Contains('\0', StringComparison.Ordinal) ? "" : Path.GetFullPath(path);
    }
}
