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
    /// <summary>Size of a whole mesh, in tolerances: files with six decimals of some tens of units are met, too.</summary>
    public const double TolerancesOfLength = 3e6;

    private readonly Dictionary<(int, int, int), int> _faces = [];
    private readonly PointGrid _grid;

    /// <summary>Takes some faces of a list.</summary>
    /// <param name="points">Positions, scene units.</param>
    /// <param name="corners">Indices of positions, [faces × 3].</param>
    /// <param name="tolerance">Largest distance of a mapped point from the one that it should be, scene units.</param>
    public FaceSet(Vector[] points, IEnumerable<int> corners, double tolerance)
    {
        Tolerance = tolerance;
        var used = new List<Vector>();
        var numbers = new int[points.Length];
        var kept = new List<int>();
        foreach (var face in corners.Chunk(3))
        {
            var (a, b, c) = (points[face[0]], points[face[1]], points[face[2]]);
            if (Vector.Cross(b - a, c - a) == Vector.Zero || !_faces.TryAdd(Sorted(face[0], face[1], face[2]), kept.Count / 3))
            {
                continue;
            }

            foreach (var point in face)
            {
                if (numbers[point] == 0)
                {
                    used.Add(points[point]);
                    numbers[point] = used.Count;
                }

                kept.Add(numbers[point] - 1);
            }
        }

        Points = [.. used];
        Corners = [.. kept];
        _faces.Clear();
        for (var face = 0; face < Count; face++)
        {
            _faces.Add(Sorted(Corners[3 * face], Corners[(3 * face) + 1], Corners[(3 * face) + 2]), face);
        }

        _grid = new(Points, tolerance);
        Twins = FindTwins();
    }

    /// <summary>Largest distance of a mapped point from the one that it should be, scene units.</summary>
    public double Tolerance { get; }

    /// <summary>Number of faces in the set.</summary>
    public int Count => Corners.Length / 3;

    /// <summary>The positions of the faces' corners, scene units.</summary>
    public Vector[] Points { get; }

    /// <summary>Indices of points, [faces × 3].</summary>
    public int[] Corners { get; }

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
        new(Points, faces.SelectMany(face => Enumerable.Range(3 * face, 3)).Select(corner => Corners[corner]), Tolerance);

    /// <summary>Makes a mesh of all faces.</summary>
    public Mesh ToMesh() => new([.. Points.SelectMany(point => new[] { point.X, point.Y, point.Z })], [.. Corners]);

    /// <summary>The mean of a face's corners.</summary>
    public Vector Centroid(int face) =>
        (Points[Corners[3 * face]] + Points[Corners[(3 * face) + 1]] + Points[Corners[(3 * face) + 2]]) / 3;

    /// <summary>Returns the corner after another one around its face.</summary>
    public static int After(int corner) => corner % 3 == 2 ? corner - 2 : corner + 1;

    /// <summary>Returns the point at a position, or −1.</summary>
    public int PointAt(Vector position) => _grid.First(position) is var entry && entry >= 0 ? _grid.PointOf(entry) : -1;

    /// <summary>Returns the face of three points, or −1; points below 0 are none.</summary>
    public int FaceOf(int a, int b, int c) => Math.Min(a, Math.Min(b, c)) >= 0 && _faces.TryGetValue(Sorted(a, b, c), out var face) ? face : -1;

    /// <summary>Returns the face that a map takes a face to, or −1.</summary>
    public int Image(AffineMap map, int face)
    {
        var a = PointAt(map * Points[Corners[3 * face]]);
        var b = a < 0 ? -1 : PointAt(map * Points[Corners[(3 * face) + 1]]);
        return b < 0 ? -1 : FaceOf(a, b, PointAt(map * Points[Corners[(3 * face) + 2]]));
    }

    private static (int, int, int) Sorted(int a, int b, int c)
    {
        var (least, greatest) = (Math.Min(a, Math.Min(b, c)), Math.Max(a, Math.Max(b, c)));
        return (least, a ^ b ^ c ^ least ^ greatest, greatest);
    }

    private int[] FindTwins()
    {
        var twins = new int[Corners.Length];
        var firsts = new Dictionary<(int, int), int>();
        for (var corner = 0; corner < twins.Length; corner++)
        {
            var (a, b) = (Corners[corner], Corners[After(corner)]);
            ref var first = ref CollectionsMarshal.GetValueRefOrAddDefault(firsts, (Math.Min(a, b), Math.Max(a, b)), out var exists);
            first = exists ? first : corner;
            twins[corner] = corner == first ? corner : twins[first];
            twins[first] = corner;
        }

        return twins;
    }
}
