namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>What is around one vertex at a time: the corners of its faces, and its neighbours.</summary>
/// <param name="stars">Faces around all vertices.</param>
internal sealed class VertexStar(VertexStars stars)
{
    private readonly int[] _faceCounts = new int[stars.VertexCount];

    /// <summary>The vertex that was loaded last.</summary>
    public int Vertex { get; private set; }

    /// <summary>Its corners of all faces that are left.</summary>
    public List<int> Corners { get; private set; } = [];

    /// <summary>The vertices at its edges.</summary>
    public List<int> Neighbours { get; } = [];

    /// <summary>Whether an edge at the vertex has a single face.</summary>
    public bool HasBorder => Neighbours.Exists(neighbour => _faceCounts[neighbour] == 1);

    /// <summary>Number of faces at the edge to another vertex: 1 at the border, 2 within a surface; 0 where there is no edge.</summary>
    public int this[int other] => _faceCounts[other];

    /// <summary>Looks at a vertex, as its faces are now.</summary>
    public void Load(int vertex)
    {
        foreach (var neighbour in Neighbours)
        {
            _faceCounts[neighbour] = 0;
        }

        Neighbours.Clear();
        Vertex = vertex;
        Corners = stars.CornersOf(vertex);
        foreach (var corner in Corners)
        {
            var (next, previous) = stars.OthersOf(corner);
            AddFace(next);
            AddFace(previous);
        }
    }

    private void AddFace(int neighbour)
    {
        if (_faceCounts[neighbour]++ == 0)
        {
            Neighbours.Add(neighbour);
        }
    }
}
