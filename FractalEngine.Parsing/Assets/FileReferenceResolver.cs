using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>Finds the files that others name, within the folder where they may lie.</summary>
/// <param name="folder">Of the file that was opened.</param>
/// <param name="allowOutsideFiles">Whether other folders are allowed too.</param>
internal sealed class FileReferenceResolver(AssetFolder folder, bool allowOutsideFiles)
{
    /// <summary>The full path of a file named in another one, and what messages call it.</summary>
    /// <param name="source">The text that names it.</param>
    /// <param name="offset">Where.</param>
    /// <param name="referrer">The full path of that text's file.</param>
    /// <param name="file">As named there.</param>
    /// <exception cref="SourceException">It lies outside, or is not there.</exception>
    public (string Full, string Name) Resolve(SourceText source, int offset, string referrer, string file)
    {
        var fullPath = FullPath(referrer, file);
        if (!allowOutsideFiles && !folder.Contains(fullPath))
        {
            throw source.Error(offset, $"\"{file}\" lies outside the folder of the file that was opened: allow that with --allow-outside");
        }

        if (!File.Exists(fullPath))
        {
            throw source.Error(offset, Directory.Exists(fullPath)
                ? $"\"{file}\" is a directory, expected a file"
                : $"the file \"{file}\" is not found");
        }

        return (fullPath, Path.IsPathRooted(source.FileName) ? fullPath : Path.GetRelativePath(Directory.GetCurrentDirectory(), fullPath));
    }

    /// <summary>Whether a file that may be named is there.</summary>
    public bool Exists(string referrer, string file) =>
        FullPath(referrer, file) is var fullPath && (allowOutsideFiles || folder.Contains(fullPath)) && File.Exists(fullPath);

    private static string FullPath(string referrer, string file) => Path.GetFullPath(Path.Combine(Path.GetDirectoryName(referrer)!, file));
}
