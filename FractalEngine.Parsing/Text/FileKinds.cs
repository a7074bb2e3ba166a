namespace FractalEngine.Parsing.Text;

/// <summary>Tells the kinds of files apart by the endings of their names.</summary>
internal static class FileKinds
{
    /// <summary>The endings of meshes, for messages.</summary>
    public const string MeshEndings = ".obj, .obj.gz, .ply, .stl, .glb, .gltf";

    private const string CompressedEnding = ".gz";

    /// <summary>Returns the kind of a file; null if the ending of its name is unknown.</summary>
    /// <param name="name">Name or path; upper and lower case are alike.</param>
    public static FileKind? FromName(string name) => Path.GetExtension(name).ToUpperInvariant() switch
    {
        ".OBJ" or ".PLY" or ".STL" or ".GLB" or ".GLTF" => FileKind.Mesh,
        ".GZ" when Path.GetExtension(RemoveCompression(name)).Equals(".obj", StringComparison.OrdinalIgnoreCase) => FileKind.Mesh,
        ".FDO" => FileKind.Fractal,
        ".SDO" => FileKind.Scene,
        _ => null,
    };

    /// <summary>Returns whether a name ends in <c>.gz</c>: the file is compressed.</summary>
    public static bool IsCompressed(string name) => name.EndsWith(CompressedEnding, StringComparison.OrdinalIgnoreCase);

    /// <summary>Returns a name without <c>.gz</c>.</summary>
    public static string RemoveCompression(string name) => IsCompressed(name) ? name[..^CompressedEnding.Length] : name;

    /// <summary>Requires the path of a caller to have the ending of a kind.</summary>
    /// <exception cref="ArgumentException">The path has another ending.</exception>
    public static void Require(string path, FileKind kind)
    {
        ArgumentNullException.ThrowIfNull(path);
        if (FromName(path) != kind)
        {
            throw new ArgumentException($"expected the name of a {Ending(kind)} file", nameof(path));
        }
    }

    /// <summary>Returns whether a name is one of an OBJ file that is not compressed, the only format of meshes that is written.</summary>
    public static bool IsPlainObj(string name) => name.EndsWith(".obj", StringComparison.OrdinalIgnoreCase);

    /// <summary>Requires the path of a caller to be one of an OBJ file that is not compressed.</summary>
    /// <exception cref="ArgumentException">The path has another ending.</exception>
    public static void RequirePlainObj(string path)
    {
        ArgumentNullException.ThrowIfNull(path);
        if (!IsPlainObj(path))
        {
            throw new ArgumentException("expected the name of a .obj file", nameof(path));
        }
    }

    private static string Ending(FileKind kind) => kind switch
    {
        FileKind.Mesh => MeshEndings,
        FileKind.Fractal => ".fdo",
        _ => ".sdo",
    };
}
