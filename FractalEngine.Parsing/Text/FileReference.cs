using FractalEngine.Core;

namespace FractalEngine.Parsing.Text;

/// <summary>Makes the names by which fractal and scene files refer to other files.</summary>
internal static class FileReference
{
    /// <summary>Returns the name of a file relative to the folder of another one, with slashes on every system.</summary>
    /// <param name="referrer">Full path of the file that will hold the name.</param>
    /// <param name="file">Full path of the file that is named.</param>
    public static string Create(string referrer, string file)
    {
        var name = Path.GetRelativePath(Path.GetDirectoryName(referrer)!, file);
        return OperatingSystem.IsWindows() ? name.Replace('\\', '/') : name;
    }

    /// <summary>Tests whether a name can be written between quotes.</summary>
    /// <exception cref="FractalEngineException">The name has a character that the files can't express.</exception>
    public static void RequireQuotable(string name)
    {
        if (!WritableNames.IsQuotable(name))
        {
            var shown = WritableNames.Escape(name);
            throw new FractalEngineException(
                $"the name '{shown}' can't be written into a file: it has a quote, a line break or a faulty character");
        }
    }
}
