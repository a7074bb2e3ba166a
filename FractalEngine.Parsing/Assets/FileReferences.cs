using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>Finds the files that others name, within the folder where they may lie.</summary>
/// <param name="folder">Of the file that was opened.</param>
/// <param name="allowsOutside">Whether other folders are allowed too.</param>
internal sealed class FileReferences(AssetFolder folder, bool allowsOutside)
{
    /// <summary>The full path of a file named in another one, and what messages call it.</summary>
    /// <param name="source">The text that names it.</param>
    /// <param name="offset">Where.</param>
    /// <param name="referrer">The full path of that text's file.</param>
    /// <param name="file">As named there.</param>
    /// <exception cref="SourceException">It lies outside, or is not there.</exception>
    public (string Full, string Name) Resolve(SourceText source, int offset, string referrer, string file)
    {
        var full = FullPath(referrer, file);
        if (!allowsOutside && !folder.Contains(full))
        {
            throw source.Error(offset, $"\"{file}\" lies outside the folder of the file that was opened: allow that with --allow-outside");
        }

        if (!File.Exists(full))
        {
            throw source.Error(offset, Directory.Exists(full) ? $"\"{file}\" is a directory, expected a file" : $"the file \"{file}\" is not found");
        }

        return (full, Path.IsPathRooted(source.FileName) ? full : Path.GetRelativePath(Directory.GetCurrentDirectory(), full));
    }

    /// <summary>Whether a file that may be named is there.</summary>
    public bool IsThere(string referrer, string file) =>
        FullPath(referrer, file) is var full && (allowsOutside || folder.Contains(full)) && File.Exists(full);

    private static string FullPath(string referrer, string file) => Path.GetFullPath(Path.Combine(Path.GetDirectoryName(referrer)!, file));
}
