using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Exports;
using FractalEngine.Parsing.Mtl;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Wavefront.Writing;

/// <summary>
/// Writes scenes as one flat OBJ mesh in world space: every instance of every fractal becomes faces of its own.
/// </summary>
/// <remarks>
/// The text is streamed; memory is proportional to the instances at most, see <see cref="ExportedScene"/>. <see cref="ObjMeshWriter"/>
/// writes single meshes.
/// </remarks>
public sealed class ObjSceneWriter
{
    private readonly ObjTextWriter _text;
    private readonly SceneMaterials? _materials;
    private string _material = "";
    private long _positionCount;
    private long _textureCoordinateCount;
    private long _normalCount;

    private ObjSceneWriter(Stream stream, SceneMaterials? materials)
    {
        _text = new(stream);
        _materials = materials;
    }

    /// <summary>Writes all objects of a scene, each under its name.</summary>
    /// <param name="scene">Scene whose fractals are finite.</param>
    /// <param name="stream">Receives UTF-8 text.</param>
    /// <param name="maxFaces">Largest number of faces that may be written.</param>
    /// <exception cref="FractalLimitException">The scene has more faces. Nothing is written then.</exception>
    /// <returns>Number of faces that were written: instances that coincide are written once.</returns>
    public static long Write(LoadedScene scene, Stream stream, long maxFaces) =>
        Write(scene, stream, new ExportSettings { MaxFaces = maxFaces }, null, "");

    /// <inheritdoc cref="Write(LoadedScene, Stream, long)"/>
    /// <param name="scene">Scene whose fractals are finite, unless the settings say how many instances there may be.</param>
    /// <param name="stream">Receives UTF-8 text.</param>
    /// <param name="settings">The limits, and the frame of the coordinates: as they are, unless it says otherwise.</param>
    /// <param name="materials">Materials of the scene that faces refer to; null for none.</param>
    /// <param name="materialFile">Name of the material file relative to the mesh; not used without materials.</param>
    /// <exception cref="FractalEngineException">The format can't express the name of the material file.</exception>
    public static long Write(LoadedScene scene, Stream stream, ExportSettings settings, SceneMaterials? materials, string materialFile)
    {
        if (materials is not null && !SceneMaterials.CanBeNamed(materialFile))
        {
            throw new FractalEngineException(
                $"an OBJ file can't name the material file '{WritableNames.Escape(materialFile)}': it has a line break, a comment, "
                + "a faulty character, blanks at an end, or a backslash at its end");
        }

        var writer = new ObjSceneWriter(stream, materials);
        var exported = ExportedScene.Of(scene, settings, ExportFrame.Unchanged.From(scene, settings));
        writer._text.WriteText(MeshCountHeader.Format(exported.FaceCount) + "\n");
        writer._text.WriteText(materials is null ? "" : $"mtllib {materialFile}\n");
        var (written, count) = (0L, exported.Parts.Sum(static part => part.Count));
        for (var i = 0; i < exported.Parts.Length; i++)
        {
            var part = exported.Parts[i];
            writer._text.WriteText(i > 0 && part.ObjectIndex == exported.Parts[i - 1].ObjectIndex ? "" : $"o {part.ObjectName}\n");
            writer.WritePart(part, () => settings.Progress?.Report((double)++written / count));
        }

        writer._text.Flush();
        return exported.FaceCount;
    }

    private void WritePart(ExportedPart part, Action report)
    {
        var firstTextureCoordinate = _textureCoordinateCount;
        _text.WriteTextureCoordinates(part.Mesh.TextureCoordinates.AsSpan());
        _textureCoordinateCount += part.Mesh.TextureCoordinates.Length / 2;
        foreach (var instance in part.Instances)
        {
            WriteInstance(part, instance, firstTextureCoordinate);
            report();
        }
    }

    private void WriteInstance(ExportedPart part, MeshInstance instance, long firstTextureCoordinate)
    {
        var (mesh, map) = (part.Mesh, instance.Map);
        for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
        {
            _text.WriteVertex(map * mesh.Vertex(vertex), mesh, vertex);
        }

        var isMirrored = map.Linear.Determinant() < 0;
        var before = (_positionCount, firstTextureCoordinate, _normalCount);
        WriteNormals(map.Linear, isMirrored, mesh);
        foreach (var group in part.Groups)
        {
            ChangeMaterial(part.MaterialOf(_materials, group.Material, instance.Tint));
            _text.WriteFaces(mesh, group.FirstFace, group.FaceCount, before, isMirrored);
        }

        _positionCount += mesh.VertexCount;
        _normalCount += mesh.Normals.Length / 3;
    }

    private void ChangeMaterial(string name)
    {
        if (name != _material)
        {
            _text.WriteText($"usemtl {name}\n");
            _material = name;
        }
    }

    private void WriteNormals(Matrix linear, bool isMirrored, Mesh mesh)
    {
        // Normals are mapped by the inverse transpose. The cofactors are a multiple of it, with the sign of the determinant.
        var cofactors = (isMirrored ? -1 : 1) * linear.Cofactors();
        for (var i = 0; i < mesh.Normals.Length; i += 3)
        {
            var normal = cofactors * new Vector(mesh.Normals[i], mesh.Normals[i + 1], mesh.Normals[i + 2]);
            var (x, y, z) = normal.MaxAbsComponent() is > 0 and < double.PositiveInfinity ? normal.UnitVector() : Vector.Zero;
            _text.WriteNumbers("vn", x, y, z);
        }
    }
}
