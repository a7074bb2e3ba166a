using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Meshes;

namespace FractalEngine.Parsing.Ply;

/// <summary>Collects the vertices and polygons of a PLY file. Normals, texture coordinates and colours belong to vertices.</summary>
internal sealed class PlyMeshBuilder
{
    private static readonly int MaxFaces = Array.MaxLength / 3;

    private readonly List<double> _positions = [];
    private readonly List<double> _normals = [];
    private readonly List<double> _textureCoordinates = [];
    private readonly List<int> _corners = [];
    private readonly List<ushort> _polygonSizes = [];
    private readonly List<double> _colours = [];
    private bool _hasNormals;
    private bool _hasTextureCoordinates;
    private bool _hasColours;
    private int _faceCount;

    /// <summary>Number of vertices that the header declares.</summary>
    public int VertexCount { get; set; }

    /// <summary>Number of polygons that were omitted, since they had fewer than three corners.</summary>
    public int ShortFaceCount { get; private set; }

    /// <summary>Number of components of normals, texture coordinates and colours that were not finite.</summary>
    public long UndefinedCount { get; private set; }

    /// <summary>Prepares for vertices with some roles, see <see cref="PlyVertex"/>.</summary>
    public void BeginVertices(int[] roles)
    {
        _hasNormals = PlyVertex.HasAll(roles, PlyVertex.NormalX, 3);
        _hasTextureCoordinates = PlyVertex.HasAll(roles, PlyVertex.U, 2);
        _hasColours = PlyVertex.HasAll(roles, PlyVertex.Red, 3);
        _colours.EnsureCapacity(_hasColours ? 3 * VertexCount : 0);
        _positions.EnsureCapacity(3 * VertexCount);
        _normals.EnsureCapacity(_hasNormals ? 3 * VertexCount : 0);
        _textureCoordinates.EnsureCapacity(_hasTextureCoordinates ? 2 * VertexCount : 0);
    }

    /// <summary>Adds a vertex behind all others.</summary>
    /// <param name="values">Value of each role.</param>
    public void AddVertex(ReadOnlySpan<double> values)
    {
        _positions.AddRange(values[..PlyVertex.NormalX]);
        if (_hasNormals)
        {
            AddFinite(_normals, values[PlyVertex.NormalX..PlyVertex.U]);
        }

        if (_hasTextureCoordinates)
        {
            AddFinite(_textureCoordinates, values[PlyVertex.U..PlyVertex.Red]);
        }

        if (_hasColours)
        {
            AddFinite(_colours, values[PlyVertex.Red..]);
        }
    }

    /// <summary>Adds a corner to the current polygon.</summary>
    /// <param name="vertex">Index of a vertex, from 0.</param>
    public void AddCorner(int vertex) => _corners.Add(vertex);

    /// <summary>Ends the current polygon. False if there would be more triangles than an array can hold.</summary>
    public bool TryEndPolygon(uint cornerCount)
    {
        if (cornerCount < 3)
        {
            _corners.RemoveRange(_corners.Count - (int)cornerCount, (int)cornerCount);
            ShortFaceCount++;
            return true;
        }

        _polygonSizes.Add((ushort)cornerCount);
        _faceCount += (int)cornerCount - 2;
        return _faceCount <= MaxFaces;
    }

    /// <summary>Creates the mesh; its polygons are cut as those of OBJ files are.</summary>
    public Mesh Complete()
    {
        var block = new ObjBlock
        {
            Counts = new(_positions.Count / 3, 0, 0, _faceCount),
            Positions = [.. _positions],
            Colours = [.. _colours],
            TextureCoordinates = [],
            Normals = [],
            PositionIndices = [.. _corners],
            TextureIndices = [],
            NormalIndices = [],
            PolygonSizes = _faceCount == _polygonSizes.Count ? [] : [.. _polygonSizes],
        };
        var mesh = ObjMeshAssembler.Assemble([block], block.Counts, threadCount: 1);
        if (_hasTextureCoordinates && _faceCount > 0)
        {
            mesh = mesh.WithTextureCoordinates([.. _textureCoordinates], mesh.VertexIndices);
        }

        return _hasNormals && _faceCount > 0 ? mesh.WithNormals([.. _normals], mesh.VertexIndices) : mesh;
    }

    private void AddFinite(List<double> list, ReadOnlySpan<double> values)
    {
        foreach (var value in values)
        {
            var isFinite = double.IsFinite(value);
            UndefinedCount += isFinite ? 0 : 1;
            list.Add(isFinite ? value : 0);
        }
    }
}
