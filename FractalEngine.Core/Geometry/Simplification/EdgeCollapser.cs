using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>Collapses the edges of a surface, the cheapest first.</summary>
internal sealed class EdgeCollapser
{
    // A collapse that breaks a rule is tried again when those up to this multiple of its cost have been made, as its faces may have changed
    // by then; and not more than a dozen times.
    private const double RetryFactor = 8;
    private const double MinRetryPart = 1.0 / 4096;

    private readonly Vector[] _positions;
    private readonly VertexStars _stars;
    private readonly VertexQuadrics _quadrics;
    private readonly CollapseRules _rules;

    // The version of a vertex is the number of its collapses. Entries of the queue with an older sum of two versions are out of date.
    private readonly PriorityQueue<(int Vertex1, int Vertex2, int Version), double> _queue;
    private readonly int[] _versions;
    private readonly List<int> _neighbours = [];
    private readonly int[] _marks;
    private readonly List<int> _star1 = [];
    private readonly List<int> _star2 = [];
    private int _mark;

    /// <summary>Prepares the collapses of a surface.</summary>
    /// <param name="positions">[vertices]; vertices that stay are moved. From −2 to 2, so that no product overflows.</param>
    /// <param name="stars">Faces around the vertices, which are removed from it.</param>
    public EdgeCollapser(Vector[] positions, VertexStars stars)
    {
        _positions = positions;
        _stars = stars;
        _quadrics = new(positions, stars);
        _rules = new(positions, stars);
        _versions = new int[positions.Length];
        _marks = new int[positions.Length];
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
            FindNeighbours(vertex);
            foreach (var other in _neighbours)
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
            _stars.Collect(vertex1, _star1);
            _stars.Collect(vertex2, _star2);
            var collapse = Plan(vertex1, vertex2);
            if (cost < collapse.MaxCost && !KeepsRules(vertex1, vertex2, collapse.Offset))
            {
                var retryCost = Math.Max(RetryFactor * cost, MinRetryPart * collapse.MaxCost);
                _queue.Enqueue(entry, Math.Min(retryCost, collapse.MaxCost));
                continue;
            }

            Collapse(vertex1, vertex2, collapse.Offset);
        }
    }

    private bool KeepsRules(int vertex1, int vertex2, Vector offset)
    {
        var position = _positions[vertex1] + offset;
        return _rules.KeepsTopology(vertex1, _star1, vertex2, _star2)
            && _rules.KeepsNormals(vertex1, _star1, vertex2, position) && _rules.KeepsNormals(vertex2, _star2, vertex1, position);
    }

    private void Collapse(int kept, int merged, Vector offset)
    {
        _quadrics.Merge(kept, merged, offset);
        // An end of the edge keeps each bit of its coordinates.
        var isSecondEnd = offset == _positions[merged] - _positions[kept];
        _positions[kept] = isSecondEnd ? _positions[merged] : _positions[kept] + offset;
        _stars.Merge(kept, _star1, merged, _star2);
        _versions[kept]++;
        _versions[merged]++;
        FindNeighbours(kept);
        _quadrics.Update(kept);
        foreach (var neighbour in _neighbours)
        {
            _quadrics.NoteChange(neighbour);
        }

        foreach (var neighbour in _neighbours)
        {
            Enqueue(kept, neighbour);
        }
    }

    private void FindNeighbours(int vertex)
    {
        _stars.Collect(vertex, _star1);
        _neighbours.Clear();
        _mark++;
        foreach (var corner in _star1)
        {
            var (next, previous) = _stars.OthersOf(corner);
            AddNeighbour(next);
            AddNeighbour(previous);
        }
    }

    private void AddNeighbour(int vertex)
    {
        if (_marks[vertex] != _mark)
        {
            _marks[vertex] = _mark;
            _neighbours.Add(vertex);
        }
    }

    private EdgeCollapse Plan(int vertex1, int vertex2) =>
        EdgeCollapse.Plan(_positions[vertex2] - _positions[vertex1], _quadrics[vertex1], _quadrics[vertex2]);

    private void Enqueue(int vertex1, int vertex2) =>
        _queue.Enqueue((vertex1, vertex2, _versions[vertex1] + _versions[vertex2]), Plan(vertex1, vertex2).Cost);
}
