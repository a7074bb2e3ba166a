using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets.References;

/// <summary>Resolves references from one file to another and enforces the asset folder.</summary>
/// <param name="folder">Asset folder of the file that was opened.</param>
/// <param name="allowOutsideFiles">Whether references may lead out of that folder.</param>
/// <param name="record">Receives the paths of all files that are looked for, missing ones included.</param>
internal sealed class FileReferenceResolver(AssetFolder folder, bool allowOutsideFiles, FileRecord record)
{
    private readonly ForeignFileNames _foreignNames = new(path => allowOutsideFiles || folder.Contains(path), record);

    /// <summary>Returns the full path of a file that another one refers to, and its name in messages.</summary>
    /// <param name="source">Text that holds the reference.</param>
    /// <param name="offset">Offset of the reference in that text.</param>
    /// <param name="referrer">Full path of the file with that text.</param>
    /// <param name="file">Name as written there, relative to the referrer's folder.</param>
    /// <exception cref="SourceException">The file lies outside the asset folder or does not exist.</exception>
    public (string FullPath, string DisplayName) Resolve(SourceText source, int offset, string referrer, string file)
    {
        var fullPath = FullPath(referrer, file);
        if (!IsAllowed(fullPath))
        {
            throw source.Error(
                offset,
                $"\"{file}\" lies outside the folder of the file that was opened: allow that with --allow-outside "
                + "(LoadOptions.AllowOutsideFiles)");
        }

        record.Add(fullPath);
        if (!File.Exists(fullPath))
        {
            throw source.Error(offset, Directory.Exists(fullPath)
                ? $"\"{file}\" is a directory, expected a file"
                : $"the file \"{file}\" is not found{NeighbourSuggestion.Ask(fullPath)}");
        }

        var isRooted = Path.IsPathRooted(source.FileName);
        return (fullPath, isRooted ? fullPath : Path.GetRelativePath(Directory.GetCurrentDirectory(), fullPath));
    }

    /// <summary>Likewise for a name that another program wrote, see <see cref="ForeignFileNames"/>.</summary>
    /// <param name="source">Text that holds the reference.</param>
    /// <param name="offset">Offset of the reference in that text.</param>
    /// <param name="referrer">Full path of the file with that text.</param>
    /// <param name="file">Name as written there.</param>
    /// <exception cref="SourceException">The file lies outside the asset folder or does not exist.</exception>
    public (string FullPath, string DisplayName) ResolveForeign(SourceText source, int offset, string referrer, string file) =>
        Resolve(source, offset, referrer, FindForeign(referrer, file) ?? file);

    /// <summary>
    /// Returns the full path of a file by a name that another program wrote; null if it does not exist or is not allowed.
    /// </summary>
    /// <param name="referrer">Full path of the file with the reference.</param>
    /// <param name="file">Name as written there.</param>
    public string? FindForeign(string referrer, string file) => _foreignNames.Find(Path.GetDirectoryName(referrer)!, file);

    /// <summary>Returns whether a file exists that the referrer may refer to.</summary>
    /// <param name="referrer">Full path of the file with the reference.</param>
    /// <param name="file">Name as written there, relative to the referrer's folder.</param>
    public bool Exists(string referrer, string file)
    {
        var fullPath = FullPath(referrer, file);
        return IsAllowed(fullPath) && File.Exists(fullPath);
    }

    private bool IsAllowed(string fullPath) => allowOutsideFiles || folder.Contains(fullPath);

    private static string FullPath(string referrer, string file) => Path.GetFullPath(Path.Combine(Path.GetDirectoryName(referrer)!, file));
}
