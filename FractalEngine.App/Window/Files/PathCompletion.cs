using System.Collections.Immutable;

namespace FractalEngine.App.Window.Files;

/// <summary>Suggests the paths of files that can be opened, and of folders, from a beginning.</summary>
internal static class PathCompletion
{
    // A folder of photographs must not stop the window.
    private const int MaxSuggestions = 200;

    private static readonly string[] Endings = [".sdo", ".fdo", ".obj", ".obj.gz", ".ply", ".stl", ".glb", ".gltf"];

    private static readonly EnumerationOptions Listing = new() { IgnoreInaccessible = true, AttributesToSkip = 0 };

    /// <summary>Returns texts that begin with a text: folders, which end with a slash, before files.</summary>
    /// <param name="text">Beginning of a path, relative to the current folder; <c>~</c> is the home folder.</param>
    public static ImmutableArray<string> Suggest(string text)
    {
        var nameStart = text.LastIndexOf('/') + 1;
        if (OperatingSystem.IsWindows())
        {
            nameStart = Math.Max(nameStart, text.LastIndexOf('\\') + 1);
        }

        var (folderText, name) = (text[..nameStart], text[nameStart..]);
        var folder = folderText.Length == 0 ? Directory.GetCurrentDirectory() : PathText.Expand(folderText);
        if (folder.Length == 0 || !Directory.Exists(folder))
        {
            return [];
        }

        try
        {
            return
            [
                .. new DirectoryInfo(folder).EnumerateFileSystemInfos("*", Listing)
                    .Where(entry => entry.Name.StartsWith(name, StringComparison.Ordinal) && (name.Length > 0 || entry.Name[0] != '.'))
                    .Select(static entry => (IsFolder: entry is DirectoryInfo || Directory.Exists(entry.FullName), entry.Name))
                    .Where(static entry => entry.IsFolder
                        || Endings.Any(ending => entry.Name.EndsWith(ending, StringComparison.OrdinalIgnoreCase)))
                    .OrderByDescending(static entry => entry.IsFolder).ThenBy(static entry => entry.Name, StringComparer.Ordinal)
                    .Take(MaxSuggestions)
                    .Select(entry => folderText + entry.Name + (entry.IsFolder ? "/" : "")),
            ];
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            return [];
        }
    }
}
