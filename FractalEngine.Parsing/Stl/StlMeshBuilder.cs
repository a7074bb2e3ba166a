using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Meshes;

namespace FractalEngine.Parsing.Stl;

/// <summary>Collects the triangles of an STL file, which has no vertices but repeats their positions.</summary>
internal sealed class StlMeshBuilder
{
    private readonly Dictionary<Vector, int> _vertices = [];
    private readonly List<double> _positions = [];
    private readonly List<int> _indices = [];
    private readonly MeshGroupList _groups = new();

    /// <summary>Begins a part with a name, which may be empty.</summary>
    public void BeginSolid(string name) => _groups.ChangeObject(name, _indices.Count / 3);

    /// <summary>Adds a corner; three of them make a triangle.</summary>
    public void AddCorner(Vector position)
    {
        if (!_vertices.TryGetValue(position, out var vertex))
        {
            vertex = _vertices.Count;
            _vertices.Add(position, vertex);
            _positions.AddRange([position.X, position.Y, position.Z]);
        }

        _indices.Add(vertex);
    }

    /// <summary>Creates the mesh of all triangles.</summary>
    public Mesh Complete() => new Mesh([.. _positions], [.. _indices]).WithGroups(_groups.Complete(_indices.Count / 3), []);
}
