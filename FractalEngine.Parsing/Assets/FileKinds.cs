namespace FractalEngine.Parsing.Assets;

/// <summary>Tells the kinds of files apart by the endings of their names.</summary>
internal static class FileKinds
{
    /// <summary>Returns the kind of a file; null if the ending of its name is unknown.</summary>
    /// <param name="name">Name or path; upper and lower case are alike.</param>
    public static FileKind? FromName(string name) => Path.GetExtension(name).ToUpperInvariant() switch
    {
        ".OBJ" => FileKind.Mesh,
        ".FDO" => FileKind.Fractal,
        ".SDO" => FileKind.Scene,
        _ => null,
    };

    /// <summary>Requires the path of a caller to have the ending of a kind.</summary>
    /// <exception cref="ArgumentException">The path has another ending.</exception>
    public static void Require(string path, FileKind kind)
    {
        if (FromName(path) != kind)
        {
            throw new ArgumentException($"expected the name of a {Ending(kind)} file", nameof(path));
        }
    }

    private static string Ending(FileKind kind) => kind switch
    {
        FileKind.Mesh => ".obj",
        FileKind.Fractal => ".fdo",
        _ => ".sdo",
    };
}
