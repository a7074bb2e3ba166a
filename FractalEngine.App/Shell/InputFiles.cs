using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Assets.References;

namespace FractalEngine.App.Shell;

/// <summary>The files that a command has read, so that its output replaces none of them.</summary>
internal static class InputFiles
{
    private static readonly HashSet<string> Paths = new(
        OperatingSystem.IsWindows() || OperatingSystem.IsMacOS() ? StringComparer.OrdinalIgnoreCase : StringComparer.Ordinal);

    /// <summary>Remembers a file, and what its links lead to.</summary>
    public static void Add(string path)
    {
        Paths.Add(Path.GetFullPath(path));
        Paths.Add(AssetFolder.ResolveLinks(path));
    }

    public static void Add(AssetCache cache)
    {
        foreach (var path in cache.Files.Keys.Where(File.Exists))
        {
            Add(path);
        }
    }

    /// <summary>Refuses an output that would replace one of these files.</summary>
    /// <param name="output">Path of the output; <c>-</c> for the standard output.</param>
    /// <exception cref="UsageException">It is one of them, or a link to one.</exception>
    public static void Protect(string output)
    {
        if (output != StandardInput.Name && File.Exists(output) && Paths.Contains(AssetFolder.ResolveLinks(output)))
        {
            throw new UsageException($"{output} is one of the files that are read, and is not overwritten");
        }
    }
}
