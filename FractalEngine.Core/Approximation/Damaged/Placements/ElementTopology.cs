using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Approximation.Damaged.Placements;

/// <summary>Which faces of an element share edges: what noise and affine maps leave as it is.</summary>
internal sealed class ElementTopology
{
    private const int MaxCorrespondences = 240;

    private readonly int[] _corners;
    private readonly int[] _degrees;
    private readonly Dictionary<(int, int), List<int>> _facesAt = [];

    /// <param name="corners">Indices of vertices, [faces × 3].</param>
    /// <param name="vertexCount">Number of vertices.</param>
    public ElementTopology(int[] corners, int vertexCount)
    {
        _corners = corners;
        _degrees = new int[vertexCount];
        for (var corner = 0; corner < corners.Length; corner++)
        {
            _degrees[corners[corner]]++;
            var edge = EdgeOf(corners[corner], corners[Mesh.NextCorner(corner)]);
            (CollectionsMarshal.GetValueRefOrAddDefault(_facesAt, edge, out _) ??= []).Add(corner / 3);
        }
    }

    /// <summary>Number of vertices and faces, and a number that is equal for equal topologies.</summary>
    public (int Vertices, int Faces, long Hash) Key =>
        (_degrees.Length, _corners.Length / 3, _facesAt.Keys.Sum(edge => (long)_degrees[edge.Item1] * _degrees[edge.Item2])
            + (1_000_003L * _degrees.Sum(degree => (long)degree * degree)));

    /// <summary>Lists the vertices of each two faces that meet at an edge: those of the edge, and then the others.</summary>
    public IEnumerable<(int A, int B, int C, int D)> PairsOfFaces() => _facesAt.Where(pair => pair.Value.Count == 2).Select(pair =>
        (pair.Key.Item1, pair.Key.Item2, OppositeOf(pair.Value[0], pair.Key.Item1, pair.Key.Item2),
        OppositeOf(pair.Value[1], pair.Key.Item1, pair.Key.Item2)));

    /// <summary>Returns for each way in which faces correspond the vertices of the other element, [vertices].</summary>
    public List<int[]> FindCorrespondences(ElementTopology other)
    {
        var found = new List<int[]>();
        var flags = Enumerable.Range(0, _corners.Length).SelectMany(corner => new[] { (corner, false), (corner, true) }).ToArray();
        var start = flags.GroupBy(flag => SignatureOf(flag)).MinBy(group => group.Count())!;
        var from = VerticesOf(start.First());
        foreach (var flag in Enumerable.Range(0, other._corners.Length).SelectMany(corner => new[] { (corner, false), (corner, true) }))
        {
            if (found.Count < MaxCorrespondences && other.SignatureOf(flag) == start.Key
                && Extend(other, start.First().Item1 / 3, flag.Item1 / 3, from, other.VerticesOf(flag)) is { } correspondence)
            {
                found.Add(correspondence);
            }
        }

        return found;
    }

    private static (int, int) EdgeOf(int vertex1, int vertex2) => (Math.Min(vertex1, vertex2), Math.Max(vertex1, vertex2));

    /// <summary>The corners of a face from one of them, in the one or the other direction.</summary>
    private int[] VerticesOf((int Corner, bool IsReversed) flag)
    {
        var (first, second) = (Mesh.NextCorner(flag.Corner), Mesh.NextCorner(Mesh.NextCorner(flag.Corner)));
        return [_corners[flag.Corner], _corners[flag.IsReversed ? second : first], _corners[flag.IsReversed ? first : second]];
    }

    private (int, int, int) SignatureOf((int, bool) flag) =>
        VerticesOf(flag) is var vertices ? (_degrees[vertices[0]], _degrees[vertices[1]], _degrees[vertices[2]]) : default;

    private int[]? Extend(ElementTopology other, int face, int otherFace, int[] from, int[] to)
    {
        var vertices = new int[_degrees.Length];
        var isTaken = new bool[_degrees.Length];
        var faces = new int[_corners.Length / 3];
        Array.Fill(vertices, -1);
        Array.Fill(faces, -1);
        var pending = new Stack<int>([face]);
        faces[face] = otherFace;
        if (other._degrees.Length != _degrees.Length || other._corners.Length != _corners.Length
            || !Enumerable.Range(0, 3).All(index => Assign(from[index], to[index])))
        {
            return null;
        }

        while (pending.TryPop(out face))
        {
            for (var corner = 3 * face; corner < (3 * face) + 3; corner++)
            {
                var (a, b) = (_corners[corner], _corners[Mesh.NextCorner(corner)]);
                var neighbours = _facesAt[EdgeOf(a, b)];
                if (!other._facesAt.TryGetValue(EdgeOf(vertices[a], vertices[b]), out var images) || images.Count != neighbours.Count)
                {
                    return null;
                }

                // Where more than two faces meet at an edge, it does not tell which of them corresponds to which.
                var (next, image) = neighbours.Count == 2
                    ? (neighbours[0] ^ neighbours[1] ^ face, images[0] ^ images[1] ^ faces[face])
                    : (face, faces[face]);
                if (faces[next] >= 0 ? faces[next] != image
                    : !Assign(OppositeOf(next, a, b), other.OppositeOf(image, vertices[a], vertices[b])))
                {
                    return null;
                }

                if (faces[next] < 0)
                {
                    faces[next] = image;
                    pending.Push(next);
                }
            }
        }

        return Array.IndexOf(vertices, -1) < 0 ? vertices : null;

        bool Assign(int vertex, int image)
        {
            if (vertices[vertex] >= 0 || isTaken[image])
            {
                return vertices[vertex] == image;
            }

            vertices[vertex] = image;
            isTaken[image] = true;
            return _degrees[vertex] == other._degrees[image];
        }
    }

    private int OppositeOf(int face, int vertex1, int vertex2) =>
        _corners[3 * face] ^ _corners[(3 * face) + 1] ^ _corners[(3 * face) + 2] ^ vertex1 ^ vertex2;
}
