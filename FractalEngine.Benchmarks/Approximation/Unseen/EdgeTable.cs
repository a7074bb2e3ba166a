using System.Runtime.InteropServices;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>The faces at each edge of a mesh whose faces change one after the other.</summary>
internal sealed class EdgeTable
{
    private readonly Dictionary<(int, int), List<int>> _facesAt = [];
    private readonly List<(int, int)> _edges = [];
    private readonly List<int> _indices;

    /// <summary>Begins with the faces of a mesh.</summary>
    public EdgeTable(IEnumerable<int> indices)
    {
        _indices = [.. indices];
        for (var face = 0; face < _indices.Count / 3; face++)
        {
            Register(face);
        }

        InitialEdges = _edges.Count;
    }

    /// <summary>Indices of the corners of all faces, [faces × 3].</summary>
    public IReadOnlyList<int> Indices => _indices;

    /// <summary>The number of edges that the mesh had at first.</summary>
    public int InitialEdges { get; }

    /// <summary>Returns an edge that the mesh had at first, by its index.</summary>
    public (int Vertex1, int Vertex2) Edge(int index) => _edges[index];

    /// <summary>Lists the faces that have an edge at present.</summary>
    public IReadOnlyList<int> FacesAt(int vertex1, int vertex2) =>
        _facesAt.TryGetValue(Key(vertex1, vertex2), out var faces) ? faces : [];

    /// <summary>Returns the corner of a face that is not on an edge of it.</summary>
    public int Opposite(int face, int vertex1, int vertex2)
    {
        var corners = CollectionsMarshal.AsSpan(_indices).Slice(3 * face, 3);
        return corners[0] ^ corners[1] ^ corners[2] ^ vertex1 ^ vertex2;
    }

    /// <summary>Adds a face, and returns its index.</summary>
    public int Add(int corner1, int corner2, int corner3)
    {
        _indices.AddRange([corner1, corner2, corner3]);
        Register((_indices.Count / 3) - 1);
        return (_indices.Count / 3) - 1;
    }

    /// <summary>Puts a vertex in the place of a corner of a face; the order of its corners stays.</summary>
    public void Replace(int face, int corner, int vertex)
    {
        for (var i = 0; i < 3; i++)
        {
            var (a, b) = Side(face, i);
            _facesAt[Key(a, b)].Remove(face);
        }

        _indices[_indices.IndexOf(corner, 3 * face, 3)] = vertex;
        Register(face);
    }

    private void Register(int face)
    {
        for (var i = 0; i < 3; i++)
        {
            var (a, b) = Side(face, i);
            ref var faces = ref CollectionsMarshal.GetValueRefOrAddDefault(_facesAt, Key(a, b), out var exists);
            if (!exists)
            {
                faces = [];
                _edges.Add(Key(a, b));
            }

            faces!.Add(face);
        }
    }

    private (int, int) Side(int face, int side) => (_indices[(3 * face) + side], _indices[(3 * face) + ((side + 1) % 3)]);

    private static (int, int) Key(int vertex1, int vertex2) => (Math.Min(vertex1, vertex2), Math.Max(vertex1, vertex2));
}
