using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Meshes;

namespace FractalEngine.Parsing.Ply;

/// <summary>Collects the vertices and polygons of a PLY file. Normals, texture coordinates and colours belong to vertices.</summary>
internal sealed class PlyMeshBuilder
{
    private static readonly int MaxFaces = Array.MaxLength / 3;

    private readonly MeshBlockBuilder _block = new();
    private readonly List<double> _normals = [];
    private readonly List<double> _textureCoordinates = [];
    private bool _hasNormals;
    private bool _hasTextureCoordinates;
    private bool _hasColours;

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
        _block.ReservePositions(VertexCount);
        _normals.EnsureCapacity(_hasNormals ? 3 * VertexCount : 0);
        _textureCoordinates.EnsureCapacity(_hasTextureCoordinates ? 2 * VertexCount : 0);
    }

    /// <summary>Adds a vertex behind all others.</summary>
    /// <param name="values">Value of each role; those that are not finite become 0.</param>
    public void AddVertex(Span<double> values)
    {
        if (_hasNormals)
        {
            _normals.AddRange(MakeFinite(values[PlyVertex.NormalX..PlyVertex.U]));
        }

        if (_hasTextureCoordinates)
        {
            _textureCoordinates.AddRange(MakeFinite(values[PlyVertex.U..PlyVertex.Red]));
        }

        if (_hasColours)
        {
            _block.AddColour(MakeFinite(values[PlyVertex.Red..]));
        }

        _block.AddPosition(new(values[0], values[1], values[2]));
    }

    /// <summary>Adds a corner to the current polygon.</summary>
    /// <param name="vertex">Index of a vertex, from 0.</param>
    public void AddCorner(int vertex) => _block.AddCorner(vertex);

    /// <summary>Ends the current polygon. False if there would be more triangles than an array can hold.</summary>
    public bool TryEndPolygon()
    {
        ShortFaceCount += _block.EndPolygon() ? 0 : 1;
        return _block.Counts.Faces <= MaxFaces;
    }

    /// <summary>Creates the mesh; its polygons are cut as those of OBJ files are.</summary>
    public Mesh Complete()
    {
        var block = _block.ToBlock();
        var mesh = MeshAssembler.Assemble([block], block.Counts, threadCount: 1);
        if (_hasTextureCoordinates && mesh.FaceCount > 0)
        {
            mesh = mesh.WithTextureCoordinates([.. _textureCoordinates], mesh.VertexIndices);
        }

        return _hasNormals && mesh.FaceCount > 0 ? mesh.WithNormals([.. _normals], mesh.VertexIndices) : mesh;
    }

    private Span<double> MakeFinite(Span<double> values)
    {
        foreach (ref var value in values)
        {
            if (!double.IsFinite(value))
            {
                value = 0;
                UndefinedCount++;
            }
        }

        return values;
    }
}
