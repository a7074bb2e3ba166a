using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>Collapses the edges of a surface, the cheapest first.</summary>
internal sealed class EdgeCollapser
{
    private readonly Vector[] _positions;
    private readonly VertexStars _stars;
    private readonly VertexQuadrics _quadrics;
    private readonly VertexStar _star1;
    private readonly VertexStar _star2;

    // The version of a vertex is the number of its collapses. Entries of the queue with an older sum of two versions are out of date.
    private readonly PriorityQueue<(int Vertex1, int Vertex2, int Version), double> _queue;
    private readonly int[] _versions;

    /// <summary>Prepares the collapses of a surface.</summary>
    /// <param name="positions">[vertices]; vertices that stay are moved. So large at most that no product of six overflows.</param>
    /// <param name="stars">Faces around the vertices, which are removed from it.</param>
    public EdgeCollapser(Vector[] positions, VertexStars stars)
    {
        _positions = positions;
        _stars = stars;
        _quadrics = new(positions, stars);
        _star1 = new(stars);
        _star2 = new(stars);
        _versions = new int[positions.Length];
        _queue = new(2 * stars.FaceCount);
    }

    /// <summary>Collapses edges until a number of faces is reached.</summary>
    /// <param name="maxFaces">Number of faces, 0 or more.</param>
    /// <param name="cancellation">Ends the work with an <see cref="OperationCanceledException"/>.</param>
    public void Run(int maxFaces, CancellationToken cancellation)
    {
        for (var vertex = 0; vertex < _positions.Length && _stars.FaceCount > maxFaces; vertex++)
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

        while (_stars.FaceCount > maxFaces && _queue.TryDequeue(out var entry, out var cost))
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
        var position = _positions[vertex1] + offset;
        _star1.Load(vertex1);
        _star2.Load(vertex2);
        return CollapseRules.KeepsTopology(_star1, _star2)
            && CollapseRules.KeepsNormals(_positions, _stars, _star1, vertex2, position)
            && CollapseRules.KeepsNormals(_positions, _stars, _star2, vertex1, position);
    }

    private void Collapse(int kept, int merged, Vector offset)
    {
        _quadrics.Merge(kept, merged, offset);
        // An end of the edge keeps each bit of its coordinates.
        var isSecondEnd = offset == _positions[merged] - _positions[kept];
        _positions[kept] = isSecondEnd ? _positions[merged] : _positions[kept] + offset;
        _stars.Merge(kept, merged);
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
        EdgeCollapse.Plan(_positions[vertex2] - _positions[vertex1], _quadrics[vertex1], _quadrics[vertex2]);

    private void Enqueue(int vertex1, int vertex2) =>
        _queue.Enqueue((vertex1, vertex2, _versions[vertex1] + _versions[vertex2]), Plan(vertex1, vertex2).Cost);
}
