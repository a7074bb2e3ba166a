using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Exports.Gltf;

/// <summary>The corners of a group of faces as glTF has them: each different one once, with all that it has under one index.</summary>
internal sealed class GltfVertices
{
    private readonly Mesh _mesh;
    private readonly (int Vertex, int Normal, int Coordinate)[] _sources;

    /// <summary>Finds the corners of a group.</summary>
    /// <param name="mesh">Mesh with a normal for each corner of a face that has an area.</param>
    /// <param name="group">Its faces.</param>
    public GltfVertices(Mesh mesh, MeshGroup group)
    {
        _mesh = mesh;
        Indices = new uint[3 * group.FaceCount];
        var numbers = new Dictionary<(int, int, int), uint>();
        var sources = new List<(int, int, int)>();
        for (var i = 0; i < Indices.Length; i++)
        {
            var corner = (3 * group.FirstFace) + i;
            var source = (
                mesh.VertexIndices[corner], mesh.NormalIndices.IsEmpty ? -1 : mesh.NormalIndices[corner],
                mesh.TextureIndices.IsEmpty ? -1 : mesh.TextureIndices[corner]);
            if (!numbers.TryGetValue(source, out Indices[i]))
            {
                numbers.Add(source, Indices[i] = (uint)sources.Count);
                sources.Add(source);
            }
        }

        _sources = [.. sources];
        HasCoordinates = !mesh.TextureIndices.IsEmpty;
    }

    /// <summary>Number of different corners.</summary>
    public int Count => _sources.Length;

    /// <summary>The corners of the faces, [faces × 3].</summary>
    public uint[] Indices { get; }

    /// <summary>Whether the mesh has texture coordinates.</summary>
    public bool HasCoordinates { get; }

    /// <summary>Whether the mesh has colours.</summary>
    public bool HasColours => !_mesh.Colours.IsEmpty;

    /// <summary>The position of a corner.</summary>
    public Vector PositionAt(int index) => _mesh.Vertex(_sources[index].Vertex);

    /// <summary>The normal of a corner: of length 1, also where its face has no area.</summary>
    public Vector NormalAt(int index)
    {
        var i = 3 * _sources[index].Normal;
        var normal = i < 0 ? Vector.Zero : new Vector(_mesh.Normals[i], _mesh.Normals[i + 1], _mesh.Normals[i + 2]);
        return normal.MaxAbsComponent() is > 0 and < double.PositiveInfinity ? normal.UnitVector() : Vector.J;
    }

    /// <summary>The texture coordinates of a corner; 0 where it has none.</summary>
    public (double U, double V) CoordinateAt(int index)
    {
        var i = 2 * _sources[index].Coordinate;
        return i < 0 ? (0, 0) : (_mesh.TextureCoordinates[i], _mesh.TextureCoordinates[i + 1]);
    }

    /// <summary>The colour of a corner, linear light; white where the mesh has no colours.</summary>
    public Vector ColourAt(int index)
    {
        if (!HasColours)
        {
            return Vector.One;
        }

        var own = _mesh.Colours.AsSpan(3 * _sources[index].Vertex, 3);
        return new Colour(own[0], own[1], own[2]).ToLinearVector();
    }
}
