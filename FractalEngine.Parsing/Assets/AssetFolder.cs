namespace FractalEngine.Parsing.Assets;

/// <summary>
/// The folder within which a file may name others, so that a scene from somebody else reads nothing but what came with it: the
/// file's own folder, or the nearest one above it that holds a file called <see cref="MarkerName"/>.
/// </summary>
public sealed class AssetFolder
{
    /// <summary>Put into a folder, it lets all files below refer to each other.</summary>
    public const string MarkerName = ".asset-root";

    private const int MostLinks = 40;

    private AssetFolder(string path) => Path = path;

    /// <summary>Full path, symbolic links followed.</summary>
    public string Path { get; }

    /// <summary>The folder of a file.</summary>
    /// <param name="file">Full path.</param>
    public static AssetFolder Of(string file)
    {
        var own = System.IO.Path.GetDirectoryName(FollowLinks(file, MostLinks))!;
        for (var folder = own; folder is not null; folder = System.IO.Path.GetDirectoryName(folder))
        {
            if (File.Exists(System.IO.Path.Combine(folder, MarkerName)))
            {
                return new(folder);
            }
        }

        return new(own);
    }

    /// <summary>True when a file lies in the folder or below it, wherever links lead.</summary>
    /// <param name="file">Full path.</param>
    public bool Contains(string file)
    {
        var relative = System.IO.Path.GetRelativePath(Path, FollowLinks(file, MostLinks));
        return !System.IO.Path.IsPathRooted(relative)
            && relative != ".."
            && !relative.StartsWith(".." + System.IO.Path.DirectorySeparatorChar, StringComparison.Ordinal);
    }

    private static string FollowLinks(string path, int linksLeft)
    {
        var full = System.IO.Path.GetFullPath(path);
        var followed = System.IO.Path.GetPathRoot(full)!;
        foreach (var part in full[followed.Length..].Split(System.IO.Path.DirectorySeparatorChar, StringSplitOptions.RemoveEmptyEntries))
        {
            followed = System.IO.Path.Combine(followed, part);
            if (linksLeft > 0 && new FileInfo(followed) is { LinkTarget: { } target })
            {
                followed = FollowLinks(System.IO.Path.Combine(System.IO.Path.GetDirectoryName(followed)!, target), linksLeft - 1);
            }
        }

        return followed;
    }
}
