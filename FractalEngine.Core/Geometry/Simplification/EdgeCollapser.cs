using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>Collapses the edges of a surface, the cheapest first.</summary>
/// <param name="positions">[vertices]; vertices that stay are moved. So large at most that no product of six overflows.</param>
/// <param name="stars">Faces around the vertices, which are removed from it.</param>
internal sealed class EdgeCollapser(Vector[] positions, VertexStars stars)
{
    private readonly VertexQuadrics _quadrics = new(positions, stars);
    private readonly VertexStar _star1 = new(stars);
    private readonly VertexStar _star2 = new(stars);

    // The version of a vertex is the number of its collapses. Entries of the queue with an older sum of two versions are out of date.
    private readonly PriorityQueue<(int Vertex1, int Vertex2, int Version), double> _queue = new(2 * stars.FaceCount);
    private readonly int[] _versions = new int[positions.Length];

    /// <summary>Collapses edges until a number of faces is reached.</summary>
    /// <param name="maxFaces">Number of faces, 0 or more.</param>
    /// <param name="cancellation">Ends the work with an <see cref="OperationCanceledException"/>.</param>
    public void Run(int maxFaces, CancellationToken cancellation)
    {
        for (var vertex = 0; vertex < positions.Length && stars.FaceCount > maxFaces; vertex++)
        {
            cancellation.ThrowIfCancellationRequested();
            _star1.Load(vertex);
            foreach (var other in _star1.Neighbours)
            {
                if (other > vertex)
                {
                    Enqueue(vertex, other);
                }
            }
        }

        while (stars.FaceCount > maxFaces && _queue.TryDequeue(out var entry, out var cost))
        {
            var (vertex1, vertex2, version) = entry;
            if (version != _versions[vertex1] + _versions[vertex2])
            {
                continue;
            }

            cancellation.ThrowIfCancellationRequested();
            var collapse = Plan(vertex1, vertex2);
            if (cost < collapse.MaxCost && !KeepsRules(vertex1, vertex2, collapse.Offset))
            {
                _queue.Enqueue(entry, collapse.MaxCost);
            }
            else
            {
                Collapse(vertex1, vertex2, collapse.Offset);
            }
        }
    }

    private bool KeepsRules(int vertex1, int vertex2, Vector offset)
    {
        var position = positions[vertex1] + offset;
        _star1.Load(vertex1);
        _star2.Load(vertex2);
        return CollapseRules.KeepsTopology(_star1, _star2)
            && CollapseRules.KeepsNormals(positions, stars, _star1, vertex2, position)
            && CollapseRules.KeepsNormals(positions, stars, _star2, vertex1, position);
    }

    private void Collapse(int kept, int merged, Vector offset)
    {
        _quadrics.Merge(kept, merged, offset);
        // An end of the edge keeps each bit of its coordinates.
        var isSecondEnd = offset == positions[merged] - positions[kept];
        positions[kept] = isSecondEnd ? positions[merged] : positions[kept] + offset;
        stars.Merge(kept, merged);
        _versions[kept]++;
        _versions[merged]++;
        _star1.Load(kept);
        _quadrics.Update(kept);
        foreach (var neighbour in _star1.Neighbours)
        {
            _quadrics.NoteChange(neighbour);
        }

        foreach (var neighbour in _star1.Neighbours)
        {
            Enqueue(kept, neighbour);
        }
    }

    private EdgeCollapse Plan(int vertex1, int vertex2) =>
        EdgeCollapse.Plan(positions[vertex2] - positions[vertex1], _quadrics[vertex1], _quadrics[vertex2]);

    private void Enqueue(int vertex1, int vertex2) =>
        _queue.Enqueue((vertex1, vertex2, _versions[vertex1] + _versions[vertex2]), Plan(vertex1, vertex2).Cost);
}
