namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>The faces around each vertex (its star), while vertices are merged and faces vanish.</summary>
internal sealed class VertexStars
{
    // Vertex of the corners of a face that was removed.
    private const int Removed = -1;

    private readonly int[] _vertices;
    private readonly List<int>[] _stars;
    private readonly Predicate<int> _isRemoved;
    private readonly HashSet<(int, int)> _others = [];

    /// <summary>
    /// Collects the corners of faces. Those without three different vertices are removed, and of those with the same three all but the
    /// first.
    /// </summary>
    /// <param name="vertices">Vertex of each corner, [faces × 3]; kept and changed.</param>
    /// <param name="vertexCount">Number of vertices.</param>
    public VertexStars(int[] vertices, int vertexCount)
    {
        _vertices = vertices;
        _stars = [.. Enumerable.Range(0, vertexCount).Select(static _ => new List<int>())];
        _isRemoved = corner => _vertices[corner] == Removed;
        FaceCount = vertices.Length / 3;
        for (var corner = 0; corner < vertices.Length; corner++)
        {
            _stars[vertices[corner]].Add(corner);
        }

        for (var vertex = 0; vertex < vertexCount; vertex++)
        {
            RemoveRepeated(vertex);
        }
    }

    /// <summary>Number of faces that are left.</summary>
    public int FaceCount { get; private set; }

    /// <summary>Number of vertices, merged ones included.</summary>
    public int VertexCount => _stars.Length;

    /// <summary>Vertices of the faces that are left, three a face.</summary>
    public IEnumerable<int> VertexIndices => _vertices.Where(static vertex => vertex != Removed);

    /// <summary>Returns the other two vertices of a corner's face, in the order of its winding.</summary>
    public (int Next, int Previous) OthersOf(int corner) => (corner % 3) switch
    {
        0 => (_vertices[corner + 1], _vertices[corner + 2]),
        1 => (_vertices[corner + 1], _vertices[corner - 1]),
        _ => (_vertices[corner - 2], _vertices[corner - 1]),
    };

    /// <summary>Number of faces around a vertex, at most: some of them may have been removed.</summary>
    public int CountOf(int vertex) => _stars[vertex].Count;

    /// <summary>Returns a vertex's corners of all faces that are left.</summary>
    public List<int> CornersOf(int vertex)
    {
        _stars[vertex].RemoveAll(_isRemoved);
        return _stars[vertex];
    }

    /// <summary>
    /// Merges two vertices. Faces with both of them vanish, and so do all but one of those that have the same three vertices afterwards.
    /// </summary>
    /// <param name="kept">The vertex that stays.</param>
    /// <param name="merged">The vertex that has no faces afterwards.</param>
    public void Merge(int kept, int merged)
    {
        foreach (var corner in CornersOf(merged))
        {
            _vertices[corner] = kept;
            _stars[kept].Add(corner);
        }

        _stars[merged].Clear();
        RemoveRepeated(kept);
    }

    private void RemoveRepeated(int vertex)
    {
        _others.Clear();
        foreach (var corner in CornersOf(vertex))
        {
            var (next, previous) = OthersOf(corner);
            if (_vertices[corner] == vertex && (next == vertex || previous == vertex || next == previous
                || !_others.Add((Math.Min(next, previous), Math.Max(next, previous)))))
            {
                _vertices.AsSpan(corner - (corner % 3), 3).Fill(Removed);
                FaceCount--;
            }
        }
    }
}
