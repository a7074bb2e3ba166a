namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>Counts how many faces each edge of a vertex has: 1 at the border, 2 within a surface.</summary>
/// <param name="stars">Stars of the vertices.</param>
internal sealed class EdgeFaceCounts(VertexStars stars)
{
    private readonly int[] _counts = new int[stars.VertexCount];

    /// <summary>Number of faces at the edge to another vertex; 0 where there is no edge.</summary>
    public int this[int other] => _counts[other];

    /// <summary>Counts the faces of a star. The counts of the last one must have been cleared.</summary>
    public void Count(List<int> star)
    {
        foreach (var corner in star)
        {
            var (next, previous) = stars.OthersOf(corner);
            _counts[next]++;
            _counts[previous]++;
        }
    }

    /// <summary>Clears the counts of a star.</summary>
    public void Clear(List<int> star)
    {
        foreach (var corner in star)
        {
            var (next, previous) = stars.OthersOf(corner);
            _counts[next] = 0;
            _counts[previous] = 0;
        }
    }
}
