using FractalEngine.Core;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets.References;

/// <summary>Proposes a file of the same folder and kind whose name is nearly that of a missing one.</summary>
internal static class NeighbourSuggestion
{
    // A folder of textures may have more, but listing them for one message would take long.
    private const int MaxNeighbours = 10_000;

    /// <summary>Returns the question <c>: did you mean "name"?</c>, or nothing where no file is near.</summary>
    /// <param name="fullPath">Full path of the missing file.</param>
    public static string Ask(string fullPath)
    {
        try
        {
            var kind = FileKinds.FromName(fullPath);
            var names = Directory.EnumerateFiles(Path.GetDirectoryName(fullPath)!).Take(MaxNeighbours).Select(Path.GetFileName)
                .OfType<string>().Where(name => FileKinds.FromName(name) == kind);
            return NameSuggestion.Find(Path.GetFileName(fullPath), names) is { } name ? $": did you mean \"{name}\"?" : "";
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            return "";
        }
    }
}
