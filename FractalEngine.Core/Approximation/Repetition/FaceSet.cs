using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Repetition;

/// <summary>Faces as sets of points, and the question that the search asks: which face does a map take a face to?</summary>
/// <remarks>Faces are triangles, or convex polygons of several; of faces with the same points one stays.</remarks>
internal sealed class FaceSet
{
    /// <summary>Size of a whole mesh, in tolerances: files with six decimals of some tens of units are met, too.</summary>
    public const double TolerancesOfLength = 3e6;

    private readonly Dictionary<ulong, int> _faces = [];
    private readonly List<(int[] Outline, int[] Triangles)> _outlines = [];
    private readonly PointGrid _grid;

    /// <summary>Takes faces, and of the points those that they use.</summary>
    /// <param name="points">Positions, scene units.</param>
    /// <param name="faces">Indices of positions: corners around each face, and those of its triangles, [triangles × 3].</param>
    /// <param name="tolerance">Largest distance of a mapped point from the one that it should be, scene units.</param>
    public FaceSet(Vector[] points, IEnumerable<(int[] Outline, int[] Triangles)> faces, double tolerance)
    {
        Tolerance = tolerance;
        var used = new List<Vector>();
        var numbers = new int[points.Length];
        var corners = new List<int>();
        var starts = new List<int> { 0 };
        foreach (var (outline, triangles) in faces)
        {
            foreach (var point in outline.Where(point => numbers[point] == 0))
            {
                used.Add(points[point]);
                numbers[point] = used.Count;
            }

            var own = Array.ConvertAll(outline, point => numbers[point] - 1);
            if (_faces.TryAdd(KeyOf(own), Count))
            {
                _outlines.Add((own, outline == triangles ? own : Array.ConvertAll(triangles, point => numbers[point] - 1)));
                corners.AddRange(own);
                starts.Add(corners.Count);
            }
        }

        Points = [.. used];
        Corners = [.. corners];
        Starts = [.. starts];
        FaceAt = [.. Enumerable.Range(0, Count).SelectMany(face => Enumerable.Repeat(face, Starts[face + 1] - Starts[face]))];
        Centroids = [.. _outlines.Select(face => Vector.Mean(Array.ConvertAll(face.Outline, point => Points[point])))];
        Twins = FindTwins();
        _grid = new(Points, tolerance);
    }

    /// <summary>Largest distance of a mapped point from the one that it should be, scene units.</summary>
    public double Tolerance { get; }

    /// <summary>Number of faces in the set.</summary>
    public int Count => _outlines.Count;

    /// <summary>The positions of the faces' corners, scene units.</summary>
    public Vector[] Points { get; }

    /// <summary>Indices of points, face after face, around each.</summary>
    public int[] Corners { get; }

    /// <summary>The first corner of each face, and at last the number of all corners.</summary>
    public int[] Starts { get; }

    /// <summary>For each corner the index of its face.</summary>
    public int[] FaceAt { get; }

    /// <summary>For each corner the next one, in a circle, whose edge to the corner after it is the same.</summary>
    public int[] Twins { get; }

    /// <summary>The mean of each face's corners.</summary>
    public Vector[] Centroids { get; }

    /// <summary>Makes the faces of a mesh a set, with points that are welded; faces without area are left out.</summary>
    public static FaceSet Create(Mesh mesh, double tolerance)
    {
        var points = Enumerable.Range(0, mesh.VertexCount).Select(mesh.Vertex).ToArray();
        var grid = new PointGrid(points, tolerance);
        var firsts = Array.ConvertAll(points, point => grid.PointOf(grid.First(point)));
        var triangles = mesh.VertexIndices.Select(vertex => firsts[vertex]).Chunk(3)
            .Where(face => Vector.Cross(points[face[1]] - points[face[0]], points[face[2]] - points[face[0]]) != Vector.Zero);
        return new(points, triangles.Select(face => (face, face)), tolerance);
    }

    /// <summary>Makes a set of some of the faces.</summary>
    public FaceSet Take(IEnumerable<int> faces) => new(Points, faces.Select(face => _outlines[face]), Tolerance);

    /// <summary>Makes a mesh of all faces.</summary>
    public Mesh ToMesh() => new(
        [.. Points.SelectMany(point => new[] { point.X, point.Y, point.Z })], [.. _outlines.SelectMany(face => face.Triangles)]);

    /// <summary>Returns the corner so many after another one around its face.</summary>
    public int After(int corner, int count = 1)
    {
        var (start, end) = (Starts[FaceAt[corner]], Starts[FaceAt[corner] + 1]);
        return corner + count < end ? corner + count : corner + count - end + start;
    }

    /// <summary>The position of a corner, scene units.</summary>
    public Vector PointOf(int corner) => Points[Corners[corner]];

    /// <summary>Returns the point at a position, or −1.</summary>
    public int PointAt(Vector position) => _grid.First(position) is var entry && entry >= 0 ? _grid.PointOf(entry) : -1;

    /// <summary>Returns the face with the points that the points of another one are taken to, or −1; points below 0 are none.</summary>
    public int ImageOf(int face, Func<int, int> imageOfPoint)
    {
        var key = 0UL;
        for (var corner = Starts[face]; corner < Starts[face + 1]; corner++)
        {
            var image = imageOfPoint(Corners[corner]);
            if (image < 0)
            {
                return -1;
            }

            key += KeyOf(image);
        }

        return _faces.GetValueOrDefault(key, -1);
    }

    /// <summary>Returns the face that a map takes a face to, or −1.</summary>
    public int Image(AffineMap map, int face) => ImageOf(face, point => PointAt(map * Points[point]));

    private static ulong KeyOf(int point) => HashMixing.Mix((ulong)point + HashMixing.GoldenGamma);

    private static ulong KeyOf(int[] points) => points.Aggregate(0UL, (sum, point) => sum + KeyOf(point));

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
