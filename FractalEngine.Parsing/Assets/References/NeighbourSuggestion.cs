using FractalEngine.Core;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets.References;

/// <summary>Proposes a file of the same folder and kind whose name is nearly that of a missing one.</summary>
internal static class NeighbourSuggestion
{
    // A folder of textures may have more, but listing them for one message would take long.
    private const int MaxNeighbours = 10_000;

    /// <summary>Returns the question <c>: did you mean "name"?</c>, why no such name can be opened, or nothing.</summary>
    /// <param name="fullPath">Full path of the missing file.</param>
    public static string Ask(string fullPath)
    {
        var missing = Path.GetFileName(fullPath);
        // The runtime puts this character where a name has bytes that are not UTF-8.
        if (missing.Contains('\uFFFD', StringComparison.Ordinal))
        {
            return ": a name that is not UTF-8 can't be opened";
        }

        try
        {
            var kind = FileKinds.FromName(fullPath);
            var names = Directory.EnumerateFiles(Path.GetDirectoryName(fullPath)!).Take(MaxNeighbours).Select(Path.GetFileName)
                .OfType<string>().Where(name => FileKinds.FromName(name) == kind && name != missing);
            return NameSuggestion.Find(missing, names) is { } name ? $": did you mean \"{name}\"?" : "";
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            return "";
        }
    }
}
