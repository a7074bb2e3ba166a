using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Collapses edges to their middles until a part of the faces is left, short edges first.</summary>
/// <remarks>
/// Lengths count relative to the size of the element, so that small elements do not vanish first, and with a random factor from 0.7 to 1.4,
/// so that no two elements lose the same edges. No collapse may make two faces with equal corners, turn a face, or join what was not.
/// </remarks>
internal sealed class EdgeCollapses
{
    // The least cosine between the normals of a face before and after a collapse.
    private const double MinCosine = 0.2;

    private readonly Vector[] _positions;
    private readonly int[] _indices;
    private readonly double[] _sizes;
    private readonly int[] _versions;
    private readonly List<int>[] _facesAt;
    private readonly SeededRandom _random;
    private readonly PriorityQueue<(int A, int B, int Version), (double Length, int A, int B)> _queue = new();
    private int _faceCount;

    private EdgeCollapses(UnseenInput input, SeededRandom random)
    {
        var mesh = input.Clean;
        (_random, _faceCount) = (random, mesh.FaceCount);
        (_positions, _indices) = (MeshTools.Positions(mesh), [.. mesh.VertexIndices]);
        (_sizes, _versions) = (new double[mesh.VertexCount], new int[mesh.VertexCount]);
        _facesAt = [.. Enumerable.Range(0, mesh.VertexCount).Select(_ => new List<int>())];
        foreach (var element in input.Elements)
        {
            var size = UnseenInput.BoundsOf(mesh, element).Diagonal;
            for (var i = 3 * element.FirstFace; i < 3 * (element.FirstFace + element.FaceCount); i++)
            {
                _facesAt[_indices[i]].Add(i / 3);
                _sizes[_indices[i]] = size;
            }
        }
    }

    /// <summary>Collapses edges of the undamaged model until a fraction of its faces is left, or no edge can be collapsed.</summary>
    public static Mesh Apply(UnseenInput input, double fraction, SeededRandom random)
    {
        var collapses = new EdgeCollapses(input, random);
        collapses.Run((int)Math.Round(fraction * input.Clean.FaceCount));
        return MeshTools.TakeFaces(
            collapses._positions, [.. collapses._indices.Chunk(3).Where(corners => corners[0] >= 0).SelectMany(corners => corners)]);
    }

    private void Run(int target)
    {
        for (var vertex = 0; vertex < _positions.Length; vertex++)
        {
            Enqueue(vertex, neighbour => neighbour > vertex);
        }

        while (_faceCount > target && _queue.TryDequeue(out var edge, out _))
        {
            // A version is the sum of both ends' changes: it differs when either has changed.
            if (edge.Version == _versions[edge.A] + _versions[edge.B] && CanCollapse(edge.A, edge.B))
            {
                Collapse(edge.A, edge.B);
            }
        }
    }

    private void Enqueue(int vertex, Func<int, bool> isWanted)
    {
        foreach (var neighbour in Neighbours(vertex).Where(isWanted))
        {
            var (a, b) = (Math.Min(vertex, neighbour), Math.Max(vertex, neighbour));
            var length = (_positions[a] - _positions[b]).Length() / _sizes[a] * _random.Between(0.7, 1.4);
            _queue.Enqueue((a, b, _versions[a] + _versions[b]), (length, a, b));
        }
    }

    private bool CanCollapse(int a, int b)
    {
        var shared = _facesAt[a].Intersect(_facesAt[b]).Count();
        // Only vertices of the shared faces may be neighbours of both ends.
        if (shared is < 1 or > 2 || Neighbours(a).Intersect(Neighbours(b)).Count() != shared
            || (shared == 2 && IsOnBorder(a) && IsOnBorder(b)))
        {
            return false;
        }

        var middle = 0.5 * (_positions[a] + _positions[b]);
        var corners = new HashSet<(int, int, int)>();
        foreach (var (vertex, other) in new[] { (a, b), (b, a) })
        {
            foreach (var face in _facesAt[vertex].Where(face => !Has(face, other)))
            {
                var (before, after) = (Normal(face, vertex, _positions[vertex]), Normal(face, vertex, middle));
                if (Vector.Dot(before, after) < MinCosine * before.Length() * after.Length() || after.LengthSquared() == 0
                    || !corners.Add(CornersWith(face, vertex, a)))
                {
                    return false;
                }
            }
        }

        return corners.Count > 0;
    }

    private void Collapse(int a, int b)
    {
        _positions[a] = 0.5 * (_positions[a] + _positions[b]);
        foreach (var face in _facesAt[b])
        {
            var corners = _indices.AsSpan(3 * face, 3);
            if (corners.Contains(a))
            {
                foreach (var corner in corners)
                {
                    if (corner != b)
                    {
                        _facesAt[corner].Remove(face);
                    }
                }

                corners.Fill(-1);
                _faceCount--;
            }
            else
            {
                corners[corners.IndexOf(b)] = a;
                _facesAt[a].Add(face);
            }
        }

        _facesAt[b].Clear();
        _versions[a]++;
        // No edge of b is ever right again.
        _versions[b] = int.MinValue / 2;
        Enqueue(a, _ => true);
    }

    private int[] Neighbours(int vertex) =>
        [.. _facesAt[vertex].SelectMany(face => _indices[(3 * face)..((3 * face) + 3)]).Where(corner => corner != vertex).Distinct()];

    private bool IsOnBorder(int vertex) =>
        Neighbours(vertex).Any(neighbour => _facesAt[vertex].Count(face => Has(face, neighbour)) == 1);

    private bool Has(int face, int vertex) => _indices.AsSpan(3 * face, 3).Contains(vertex);

    private Vector Normal(int face, int moved, Vector position)
    {
        var (a, b, c) = (At(0), At(1), At(2));
        return Vector.Cross(b - a, c - a);

        Vector At(int corner)
        {
            var vertex = _indices[(3 * face) + corner];
            return vertex == moved ? position : _positions[vertex];
        }
    }

    private (int, int, int) CornersWith(int face, int replaced, int vertex)
    {
        var corners = _indices.AsSpan(3 * face, 3).ToArray();
        corners[Array.IndexOf(corners, replaced)] = vertex;
        return Welding.Sorted(corners[0], corners[1], corners[2]);
    }
}
