using System.Text;
using FractalEngine.Core;
using FractalEngine.Core.Files;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Mtl;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Wavefront.Writing;

namespace FractalEngine.Parsing;

/// <summary>Reads mesh files, and writes Wavefront files (<c>.obj</c>); what is written reads back as an equal mesh.</summary>
public static class MeshFile
{
    /// <summary>Reads a mesh without its materials.</summary>
    /// <param name="path">
    /// Path of a file that ends in <c>.obj</c>, <c>.obj.gz</c>, <c>.ply</c>, <c>.stl</c>, <c>.glb</c> or <c>.gltf</c>.
    /// </param>
    /// <exception cref="ArgumentException">The path has another ending.</exception>
    /// <exception cref="SourceException">The file can't be loaded.</exception>
    public static Mesh Read(string path)
    {
        FileKinds.Require(path, FileKind.Mesh);
        return MeshReader.Read(path, path).Mesh;
    }

    /// <summary>Creates or replaces the file of a mesh, every number bit for bit.</summary>
    /// <param name="path">Path that ends in <c>.obj</c>; its folder is created if it is missing.</param>
    /// <param name="mesh">Mesh to write; its material files are named but not written.</param>
    /// <exception cref="ArgumentException">The path does not end in <c>.obj</c>.</exception>
    /// <exception cref="FractalEngineException">The mesh can't be expressed in a file, see <see cref="ObjMeshWriter"/>.</exception>
    /// <exception cref="IOException">The file can't be written. Then an existing file stays as it was.</exception>
    public static void Write(string path, Mesh mesh)
    {
        FileKinds.RequirePlainObj(path);
        ArgumentNullException.ThrowIfNull(mesh);
        AtomicFile.Write(path, stream => WriteChecked(mesh, stream));
    }

    /// <summary>Writes a mesh, and its materials if it has any, beside another file without replacing different files.</summary>
    /// <param name="fullPath">Full path of the mesh's file; another name is chosen if it is taken.</param>
    /// <param name="mesh">Mesh to write.</param>
    /// <param name="materials">Materials to write, with full paths of their textures; empty to keep the mesh's material files.</param>
    /// <param name="companions">Receives the files.</param>
    /// <returns>Full path of the file that holds the mesh.</returns>
    internal static string WriteNew(string fullPath, Mesh mesh, IReadOnlyDictionary<string, Material> materials, NewFiles companions)
    {
        if (materials.Count > 0)
        {
            var materialPath = Path.ChangeExtension(fullPath, ".mtl");
            var text = MtlWriter.Write(materials.Values.OrderBy(material => material.Name, StringComparer.Ordinal), materialPath);
            materialPath = companions.Write(materialPath, stream => stream.Write(Encoding.UTF8.GetBytes(text)));
            mesh = mesh.WithGroups(mesh.Groups, [FileReference.Create(fullPath, materialPath)]);
        }

        return companions.Write(fullPath, stream => WriteChecked(mesh, stream));
    }

    private static void WriteChecked(Mesh mesh, Stream stream)
    {
        ObjMeshWriter.Write(mesh, stream);
        // A pipe has no length, and is not read back as a file.
        if (stream.CanSeek && stream.Length > ParsingLimits.ObjBytes.Value)
        {
            throw new FractalEngineException(ErrorKind.Limit,
                $"the mesh can't be written as an OBJ file: its text has more than the limit of {ParsingLimits.ObjBytes.Value} bytes");
        }
    }
}
