namespace FractalEngine.Parsing.Assets;

/// <summary>
/// The folder within which a file may name others, so that a scene from somebody else reads nothing but what came with it: the
/// file's own folder, or the nearest one above it that holds a file called <see cref="MarkerName"/>.
/// </summary>
public sealed class AssetFolder
{
    /// <summary>Put into a folder, it lets all files below refer to each other.</summary>
    public const string MarkerName = ".asset-root";

    private const int MaxLinks = 40;

    private AssetFolder(string path) => Path = path;

    /// <summary>Full path, symbolic links followed.</summary>
    public string Path { get; }

    /// <summary>The folder of a file.</summary>
    /// <param name="file">Full path.</param>
    public static AssetFolder ForFile(string file)
    {
        var ownFolder = System.IO.Path.GetDirectoryName(ResolveLinks(file, MaxLinks))!;
        for (var folder = ownFolder; folder is not null; folder = System.IO.Path.GetDirectoryName(folder))
        {
            if (File.Exists(System.IO.Path.Combine(folder, MarkerName)))
            {
                return new(folder);
            }
        }

        return new(ownFolder);
    }

    /// <summary>True when a file lies in the folder or below it, wherever links lead.</summary>
    /// <param name="file">Full path.</param>
    public bool Contains(string file)
    {
        var relative = System.IO.Path.GetRelativePath(Path, ResolveLinks(file, MaxLinks));
        return !System.IO.Path.IsPathRooted(relative)
            && relative != ".."
            && !relative.StartsWith(".." + System.IO.Path.DirectorySeparatorChar, StringComparison.Ordinal);
    }

    private static string ResolveLinks(string path, int linksLeft)
    {
        var fullPath = System.IO.Path.GetFullPath(path);
        var resolved = System.IO.Path.GetPathRoot(fullPath)!;
        foreach (var segment in fullPath[resolved.Length..].Split(System.IO.Path.DirectorySeparatorChar,
            StringSplitOptions.RemoveEmptyEntries))
        {
            resolved = System.IO.Path.Combine(resolved, segment);
            if (linksLeft > 0 && new FileInfo(resolved) is { LinkTarget: { } target })
            {
                resolved = ResolveLinks(System.IO.Path.Combine(System.IO.Path.GetDirectoryName(resolved)!, target), linksLeft - 1);
            }
        }

        return resolved;
    }
}
