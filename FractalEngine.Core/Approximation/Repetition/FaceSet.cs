using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Repetition;

/// <summary>Faces as sets of three points, and the question that the search asks: which face does a map take a face to?</summary>
/// <remarks>Points within the tolerance are one; faces without area are left out, and of faces with the same points one stays.</remarks>
internal sealed class FaceSet
{
    /// <summary>Size of a whole mesh, in tolerances.</summary>
    public const double TolerancesOfLength = 1e7;

    private readonly Dictionary<(int, int, int), int> _faces = [];
    private readonly Dictionary<int, int> _compact = [];
    private readonly List<Vector> _points = [];
    private readonly List<int> _corners = [];
    private readonly PointGrid _grid;

    /// <summary>Takes some faces of a list.</summary>
    /// <param name="points">Positions, scene units.</param>
    /// <param name="corners">Indices of positions, [faces × 3].</param>
    /// <param name="tolerance">Largest distance of a mapped point from the one that it should be, scene units.</param>
    public FaceSet(IReadOnlyList<Vector> points, IEnumerable<int> corners, double tolerance)
    {
        Tolerance = tolerance;
        foreach (var face in corners.Chunk(3))
        {
            var (a, b, c) = (points[face[0]], points[face[1]], points[face[2]]);
            if (Vector.Cross(b - a, c - a) != Vector.Zero && _faces.TryAdd(Sorted(face[0], face[1], face[2]), 0))
            {
                _corners.AddRange(face);
            }
        }

        _faces.Clear();
        for (var corner = 0; corner < _corners.Count; corner++)
        {
            ref var index = ref CollectionsMarshal.GetValueRefOrAddDefault(_compact, _corners[corner], out var exists);
            if (!exists)
            {
                index = _points.Count;
                _points.Add(points[_corners[corner]]);
            }

            _corners[corner] = index;
        }

        for (var face = 0; face < Count; face++)
        {
            _faces.Add(Sorted(_corners[3 * face], _corners[(3 * face) + 1], _corners[(3 * face) + 2]), face);
        }

        _grid = new(_points, tolerance);
        Twins = FindTwins();
    }

    /// <summary>Largest distance of a mapped point from the one that it should be, scene units.</summary>
    public double Tolerance { get; }

    /// <summary>Number of faces in the set.</summary>
    public int Count => _corners.Count / 3;

    /// <summary>The positions of the faces' corners, scene units.</summary>
    public IReadOnlyList<Vector> Points => _points;

    /// <summary>Indices of points, [faces × 3].</summary>
    public IReadOnlyList<int> Corners => _corners;

    /// <summary>For each corner the next one, in a circle, whose edge to the corner after it is the same; [faces × 3].</summary>
    public int[] Twins { get; }

    /// <summary>Makes the faces of a mesh a set, with points that are welded.</summary>
    public static FaceSet Create(Mesh mesh, double tolerance)
    {
        var points = Enumerable.Range(0, mesh.VertexCount).Select(mesh.Vertex).ToArray();
        var grid = new PointGrid(points, tolerance);
        var firsts = new int[points.Length];
        for (var point = 0; point < firsts.Length; point++)
        {
            firsts[point] = point;
            for (var entry = grid.First(points[point]); entry >= 0; entry = grid.Next(entry, points[point]))
            {
                firsts[point] = Math.Min(firsts[point], firsts[Math.Min(point, grid.PointOf(entry))]);
            }
        }

        return new(points, mesh.VertexIndices.Select(vertex => firsts[vertex]), tolerance);
    }

    /// <summary>Makes a set of some of the faces.</summary>
    public FaceSet Take(IEnumerable<int> faces) =>
        new(_points, faces.SelectMany(face => Enumerable.Range(3 * face, 3)).Select(corner => _corners[corner]), Tolerance);

    /// <summary>Makes a mesh of all faces.</summary>
    public Mesh ToMesh() => new([.. _points.SelectMany(point => new[] { point.X, point.Y, point.Z })], [.. _corners]);

    /// <summary>The mean of a face's corners.</summary>
    public Vector Centroid(int face) =>
        (_points[_corners[3 * face]] + _points[_corners[(3 * face) + 1]] + _points[_corners[(3 * face) + 2]]) / 3;

    /// <summary>Returns the corner after another one around its face.</summary>
    public static int After(int corner) => corner % 3 == 2 ? corner - 2 : corner + 1;

    /// <summary>Returns the point at a position, or −1.</summary>
    public int PointAt(Vector position) => _grid.First(position) is var entry && entry >= 0 ? _grid.PointOf(entry) : -1;

    /// <summary>Returns the face of three points, or −1; points below 0 are none.</summary>
    public int FaceOf(int a, int b, int c) => Math.Min(a, Math.Min(b, c)) >= 0 && _faces.TryGetValue(Sorted(a, b, c), out var face) ? face : -1;

    /// <summary>Returns the face that a map takes a face to, or −1.</summary>
    public int Image(AffineMap map, int face)
    {
        var a = PointAt(map * _points[_corners[3 * face]]);
        var b = a < 0 ? -1 : PointAt(map * _points[_corners[(3 * face) + 1]]);
        return b < 0 ? -1 : FaceOf(a, b, PointAt(map * _points[_corners[(3 * face) + 2]]));
    }

    private static (int, int, int) Sorted(int a, int b, int c)
    {
        var (least, greatest) = (Math.Min(a, Math.Min(b, c)), Math.Max(a, Math.Max(b, c)));
        return (least, a ^ b ^ c ^ least ^ greatest, greatest);
    }

    private int[] FindTwins()
    {
        var twins = new int[_corners.Count];
        var firsts = new Dictionary<(int, int), int>();
        for (var corner = 0; corner < twins.Length; corner++)
        {
            var (a, b) = (_corners[corner], _corners[After(corner)]);
            ref var first = ref CollectionsMarshal.GetValueRefOrAddDefault(firsts, (Math.Min(a, b), Math.Max(a, b)), out var exists);
            first = exists ? first : corner;
            twins[corner] = corner == first ? corner : twins[first];
            twins[first] = corner;
        }

        return twins;
    }
}
