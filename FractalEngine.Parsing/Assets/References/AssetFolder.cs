using System.Collections.Concurrent;

namespace FractalEngine.Parsing.Assets.References;

/// <summary>
/// Folder within which a file may refer to others: the file's own, or the closest ancestor that holds a file called
/// <see cref="MarkerName"/>. So a scene from somebody else reads only what came with it.
/// </summary>
public sealed class AssetFolder
{
    /// <summary>Name of the marker file that lets all files in its folder and in subfolders refer to each other.</summary>
    public const string MarkerName = ".asset-root";

    // As Linux. The links of a path are counted together: links through links could double their number each time.
    private const int MaxLinks = 40;

    private readonly ConcurrentDictionary<string, string> _resolvedFolders = new();

    private AssetFolder(string path) => Path = path;

    /// <summary>Full path with all symbolic links resolved.</summary>
    public string Path { get; }

    /// <summary>Finds the folder within which a file may refer to others.</summary>
    /// <param name="file">Full path of the file.</param>
    public static AssetFolder ForFile(string file)
    {
        var ownFolder = System.IO.Path.GetDirectoryName(ResolveLinks(file))!;
        for (var folder = ownFolder; folder is not null; folder = System.IO.Path.GetDirectoryName(folder))
        {
            if (File.Exists(System.IO.Path.Combine(folder, MarkerName)))
            {
                return new(folder);
            }
        }

        return new(ownFolder);
    }

    /// <summary>Returns whether a file lies in the folder or a subfolder once its symbolic links are resolved.</summary>
    /// <param name="file">Full path of the file, which need not exist.</param>
    public bool Contains(string file)
    {
        var relative = System.IO.Path.GetRelativePath(Path, ResolveFile(file));
        return !System.IO.Path.IsPathRooted(relative)
            && relative != ".."
            && !relative.StartsWith(".." + System.IO.Path.DirectorySeparatorChar, StringComparison.Ordinal);
    }

    /// <summary>Resolves the folder of a file once for all its files.</summary>
    private string ResolveFile(string file)
    {
        var fullPath = System.IO.Path.GetFullPath(file);
        if (System.IO.Path.GetDirectoryName(fullPath) is not { } folder)
        {
            return fullPath;
        }

        var inFolder = System.IO.Path.Combine(
            _resolvedFolders.GetOrAdd(folder, ResolveLinks), System.IO.Path.GetFileName(fullPath));
        return new FileInfo(inFolder).LinkTarget is null ? inFolder : ResolveLinks(inFolder);
    }

    /// <summary>Follows all symbolic links of a path, those of its folders too. At most 40, as Linux does; the rest stay.</summary>
    /// <param name="path">Path of a file or a folder, which need not exist.</param>
    public static string ResolveLinks(string path)
    {
        var linksLeft = MaxLinks;
        return ResolveLinks(path, ref linksLeft);
    }

    private static string ResolveLinks(string path, ref int linksLeft)
    {
        var fullPath = System.IO.Path.GetFullPath(path);
        var resolved = System.IO.Path.GetPathRoot(fullPath)!;
        var segments = fullPath[resolved.Length..].Split(System.IO.Path.DirectorySeparatorChar, StringSplitOptions.RemoveEmptyEntries);
        foreach (var segment in segments)
        {
            resolved = System.IO.Path.Combine(resolved, segment);
            if (linksLeft > 0 && new FileInfo(resolved) is { LinkTarget: { } target })
            {
                linksLeft--;
                resolved = ResolveLinks(System.IO.Path.Combine(System.IO.Path.GetDirectoryName(resolved)!, target), ref linksLeft);
            }
        }

        return resolved;
    }
}
