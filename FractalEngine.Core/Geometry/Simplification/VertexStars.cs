namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>The faces around each vertex (its star), as a linked list of corners, while vertices are merged and faces vanish.</summary>
internal sealed class VertexStars
{
    // Vertex of the corners of a face that was removed.
    private const int Removed = -1;

    private readonly int[] _vertices;
    private readonly int[] _nextCorners;
    private readonly int[] _firstCorners;
    private readonly HashSet<(int, int)> _others = [];

    /// <summary>Links the corners of faces.</summary>
    /// <param name="vertices">Vertex of each corner, [faces × 3]; kept and changed. The three of a face differ.</param>
    /// <param name="vertexCount">Number of vertices.</param>
    public VertexStars(int[] vertices, int vertexCount)
    {
        _vertices = vertices;
        _nextCorners = new int[vertices.Length];
        _firstCorners = new int[vertexCount];
        Array.Fill(_firstCorners, -1);
        for (var corner = vertices.Length - 1; corner >= 0; corner--)
        {
            Link(corner, vertices[corner]);
        }

        FaceCount = vertices.Length / 3;
    }

    /// <summary>Number of faces that are left.</summary>
    public int FaceCount { get; private set; }

    /// <summary>Number of vertices, merged ones included.</summary>
    public int VertexCount => _firstCorners.Length;

    /// <summary>Vertices of the faces that are left, three a face.</summary>
    public IEnumerable<int> VertexIndices => _vertices.Where(static vertex => vertex != Removed);

    /// <summary>Returns the other two vertices of a corner's face, in the order of its winding.</summary>
    public (int Next, int Previous) OthersOf(int corner) => (corner % 3) switch
    {
        0 => (_vertices[corner + 1], _vertices[corner + 2]),
        1 => (_vertices[corner + 1], _vertices[corner - 1]),
        _ => (_vertices[corner - 2], _vertices[corner - 1]),
    };

    /// <summary>Fills a list with a vertex's corners of all faces that are left.</summary>
    public void Collect(int vertex, List<int> star)
    {
        star.Clear();
        var corner = _firstCorners[vertex];
        while (corner >= 0)
        {
            if (_vertices[corner] == vertex)
            {
                star.Add(corner);
            }

            corner = _nextCorners[corner];
        }
    }

    /// <summary>
    /// Merges two vertices. Faces with both of them vanish, and so do all but one of those that have the same three vertices afterwards.
    /// </summary>
    /// <param name="kept">The vertex that stays.</param>
    /// <param name="keptStar">Its star.</param>
    /// <param name="merged">The vertex that has no faces afterwards.</param>
    /// <param name="mergedStar">Its star.</param>
    public void Merge(int kept, List<int> keptStar, int merged, List<int> mergedStar)
    {
        _firstCorners[kept] = -1;
        _firstCorners[merged] = -1;
        _others.Clear();
        for (var i = keptStar.Count + mergedStar.Count - 1; i >= 0; i--)
        {
            var corner = i < keptStar.Count ? keptStar[i] : mergedStar[i - keptStar.Count];
            if (_vertices[corner] == Removed)
            {
                continue;
            }

            var (next, previous) = OthersOf(corner);
            if (next == kept || next == merged || previous == kept || previous == merged
                || !_others.Add((Math.Min(next, previous), Math.Max(next, previous))))
            {
                Remove(corner / 3);
                continue;
            }

            _vertices[corner] = kept;
            Link(corner, kept);
        }
    }

    private void Link(int corner, int vertex)
    {
        _nextCorners[corner] = _firstCorners[vertex];
        _firstCorners[vertex] = corner;
    }

    private void Remove(int face)
    {
        _vertices.AsSpan(3 * face, 3).Fill(Removed);
        FaceCount--;
    }
}
