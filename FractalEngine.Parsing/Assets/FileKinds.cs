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
}
