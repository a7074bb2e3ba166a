using FractalEngine.Parsing.Assets.References;
using FractalEngine.Parsing.Gltf;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Ply;
using FractalEngine.Parsing.Stl;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Wavefront;

namespace FractalEngine.Parsing.Assets;

/// <summary>Reads mesh files of all formats, told apart by the endings of their names.</summary>
internal static class MeshReader
{
    /// <summary>Reads a mesh without its materials.</summary>
    /// <param name="path">Path of a file that ends in .obj, .obj.gz, .ply, .stl, .glb or .gltf.</param>
    /// <param name="fileName">Name of the file in messages.</param>
    /// <param name="progress">Receives the fraction that is done, from 0 to 1; only of OBJ files.</param>
    /// <param name="references">Finds the files that a .gltf names; null for those beside it and below.</param>
    /// <param name="keepsInstances">Whether meshes that stand at several places are kept once, where the format has instances.</param>
    /// <exception cref="SourceException">The file can't be read, or is not of the format.</exception>
    public static ParsedObj Read(
        string path, string fileName, IProgress<double>? progress = null, FileReferenceResolver? references = null,
        bool keepsInstances = false) =>
        Path.GetExtension(path).ToUpperInvariant() switch
        {
            ".PLY" => PlyReader.Read(path, fileName),
            ".STL" => StlReader.Read(path, fileName),
            ".GLB" or ".GLTF" => GltfReader.Read(
                path, fileName, name => ReadOther(Path.GetFullPath(path), fileName, name, references), keepsInstances),
            _ => ObjReader.Read(path, fileName, progress),
        };

    /// <summary>Tells whether a format has instances of meshes.</summary>
    public static bool HasInstances(string path) => Path.GetExtension(path).ToUpperInvariant() is ".GLB" or ".GLTF";

    private static byte[] ReadOther(string path, string fileName, string name, FileReferenceResolver? references)
    {
        references ??= new(AssetFolder.ForFile(path), false, new());
        var (other, displayName) = references.ResolveForeign(new(fileName, ""), 0, path, Uri.UnescapeDataString(name));
        return SourceText.ReadBytes(other, displayName, ParsingLimits.ObjBytes.Value);
    }
}
