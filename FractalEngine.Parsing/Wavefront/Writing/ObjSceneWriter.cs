using System.Collections.Immutable;
using System.Globalization;
using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Mtl;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Wavefront.Writing;

/// <summary>
/// Writes scenes as one flat OBJ mesh in world space: every instance of every fractal becomes faces of its own.
/// </summary>
/// <remarks>
/// The text is streamed; memory is proportional to the instances, not to the faces. <see cref="ObjMeshWriter"/> writes single meshes.
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
    public static long Write(LoadedScene scene, Stream stream, long maxFaces) => Write(scene, stream, maxFaces, null, "");

    /// <inheritdoc cref="Write(LoadedScene, Stream, long)"/>
    /// <param name="scene">Scene whose fractals are finite.</param>
    /// <param name="stream">Receives UTF-8 text.</param>
    /// <param name="maxFaces">Largest number of faces that may be written.</param>
    /// <param name="materials">Materials of the scene that faces refer to; null for none.</param>
    /// <param name="materialFile">Name of the material file relative to the mesh; not used without materials.</param>
    /// <exception cref="FractalEngineException">The format can't express the name of the material file.</exception>
    public static long Write(LoadedScene scene, Stream stream, long maxFaces, SceneMaterials? materials, string materialFile)
    {
        if (materials is not null && !SceneMaterials.CanBeNamed(materialFile))
        {
            throw new FractalEngineException(
                $"an OBJ file can't name the material file '{WritableNames.Escape(materialFile)}': it has a line break, a comment, "
                + "a faulty character, blanks at an end, or a backslash at its end");
        }

        var writer = new ObjSceneWriter(stream, materials);
        var objects = scene.Objects.Select((placed, index) => placed.Parts.Select(
            (part, mesh) => (Placed: part, Index: index + mesh, Instances: ExpandInstances(part.Model, maxFaces))).ToArray()).ToArray();
        var faceCount = objects.SelectMany(static parts => parts).Sum(
            static item => (long)item.Instances.Maps.Length * item.Placed.Model.Mesh.FaceCount);
        if (faceCount > maxFaces)
        {
            throw new FractalLimitException(
                string.Create(CultureInfo.InvariantCulture, $"the scene has {faceCount} faces, more than the limit of {maxFaces}"));
        }

        writer._text.WriteText(MeshCountHeader.Format(faceCount) + "\n");
        writer._text.WriteText(materials is null ? "" : $"mtllib {materialFile}\n");
        foreach (var parts in objects)
        {
            writer._text.WriteText($"o {ObjectName(parts[0].Placed)}\n");
            foreach (var (placed, index, (maps, tints)) in parts)
            {
                writer.WriteObject(placed, index, maps, tints);
            }
        }

        writer._text.Flush();
        return faceCount;
    }

    private static string ObjectName(PlacedModel placed) =>
        placed.Declaration.Name ?? Path.GetFileNameWithoutExtension(placed.Declaration.DisplayName);

    private static (ImmutableArray<AffineMap> Maps, ImmutableArray<Tint> Tints) ExpandInstances(Model model, long maxFaces)
    {
        if (model is not FractalModel { Fractal: var fractal })
        {
            return ([AffineMap.Identity], []);
        }

        try
        {
            return FractalGenerator.ExpandTinted(fractal, maxFaces / Math.Max(1, fractal.BaseMesh.FaceCount));
        }
        catch (FractalLimitException exception)
        {
            var message = string.Create(CultureInfo.InvariantCulture,
                $"{model.Name} has more faces than the limit of {maxFaces}: "
                + $"its base has {fractal.BaseMesh.FaceCount}, and {exception.Message}");
            throw new FractalLimitException(message, exception);
        }
    }

    private void WriteObject(PlacedModel placed, int index, ImmutableArray<AffineMap> maps, ImmutableArray<Tint> tints)
    {
        var mesh = placed.Model.Mesh;
        var firstTextureCoordinate = _textureCoordinateCount;
        _text.WriteTextureCoordinates(mesh.TextureCoordinates.AsSpan());
        _textureCoordinateCount += mesh.TextureCoordinates.Length / 2;
        for (var i = 0; i < maps.Length; i++)
        {
            var tint = tints.IsEmpty ? (Tint?)null : tints[i];
            WriteInstance(placed, group => NameOf(placed, index, group, tint), placed.ObjectToWorld * maps[i], firstTextureCoordinate);
        }
    }

    private void WriteInstance(PlacedModel placed, Func<string, string> nameOf, AffineMap map, long firstTextureCoordinate)
    {
        var mesh = placed.Model.Mesh;
        for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
        {
            _text.WriteVertex(map * mesh.Vertex(vertex), mesh, vertex);
        }

        var isMirrored = map.Linear.Determinant() < 0;
        var before = (_positionCount, firstTextureCoordinate, _normalCount);
        WriteNormals(map.Linear, isMirrored, mesh);
        // Groups that were made in code may leave faces out.
        if (_materials is null || mesh.Groups.Sum(static group => group.FaceCount) != mesh.FaceCount)
        {
            ChangeMaterial(nameOf(""));
            _text.WriteFaces(mesh, 0, mesh.FaceCount, before, isMirrored);
        }
        else
        {
            foreach (var group in mesh.Groups)
            {
                ChangeMaterial(nameOf(group.Material));
                _text.WriteFaces(mesh, group.FirstFace, group.FaceCount, before, isMirrored);
            }
        }

        _positionCount += mesh.VertexCount;
        _normalCount += mesh.Normals.Length / 3;
    }

    /// <summary>The name of the material of faces of an instance, by that in its mesh; empty for none.</summary>
    private string NameOf(PlacedModel placed, int index, string group, Tint? tint) => (tint is { } known
        ? _materials?.NameOf(placed, index, group, known)
        : _materials?.NameOf(placed, group)) ?? "";

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
            _text.WriteVector("vn", normal.MaxAbsComponent() is > 0 and < double.PositiveInfinity ? normal.UnitVector() : Vector.Zero);
        }
    }
}
