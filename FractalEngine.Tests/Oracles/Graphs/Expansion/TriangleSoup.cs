using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Oracles.Graphs.Expansion;

/// <summary>All triangles of an expansion. Questions are answered by a look at each of them.</summary>
internal sealed class TriangleSoup
{
    private readonly OracleTriangle[] _triangles;

    public TriangleSoup(ImmutableArray<PlacedMesh> instances)
    {
        Instances = instances;
        _triangles = [.. instances.SelectMany(TrianglesOf)];
        (Minimum, Maximum) = (double.PositiveInfinity * Vector.One, double.NegativeInfinity * Vector.One);
        foreach (ref readonly var triangle in _triangles.AsSpan())
        {
            Minimum = Vector.Min(Minimum, Vector.Min(triangle.A, Vector.Min(triangle.B, triangle.C)));
            Maximum = Vector.Max(Maximum, Vector.Max(triangle.A, Vector.Max(triangle.B, triangle.C)));
            Reach = Math.Max(Reach, triangle.Reach);
        }
    }

    public ImmutableArray<PlacedMesh> Instances { get; }

    public ReadOnlySpan<OracleTriangle> Triangles => _triangles;

    /// <summary>The smallest coordinates of corners.</summary>
    public Vector Minimum { get; }

    /// <summary>The largest coordinates of corners.</summary>
    public Vector Maximum { get; }

    /// <summary>The largest reach of a triangle.</summary>
    public double Reach { get; }

    public static double Largest(Vector v) => Math.Max(Math.Abs(v.X), Math.Max(Math.Abs(v.Y), Math.Abs(v.Z)));

    /// <summary>Finds the closest point of all triangles, and the triangle that it belongs to.</summary>
    public (double Distance, Vector Point, int Triangle) FindClosest(Vector position)
    {
        var best = (Distance: double.PositiveInfinity, Point: Vector.Zero, Triangle: -1);
        for (var i = 0; i < _triangles.Length; i++)
        {
            ref readonly var triangle = ref _triangles[i];
            if (best.Triangle >= 0 && IsBeyond(in triangle, position, best.Distance))
            {
                continue;
            }

            var point = triangle.ClosestPoint(position);
            var distance = (point - position).Length();
            if (distance < best.Distance)
            {
                best = (distance, point, i);
            }
        }

        return best;
    }

    /// <summary>Describes a triangle in messages.</summary>
    public string Describe(int triangle)
    {
        var found = _triangles[triangle];
        var mesh = Instances[found.Instance].Mesh.Name;
        return FormattableString.Invariant(
            $"face {found.Face} of instance {found.Instance}, {mesh}, {found.LongestEdge} long, reach {Reach}");
    }

    /// <summary>The distances of all triangles, in their order.</summary>
    public double[] FindDistances(Vector position) =>
        Array.ConvertAll(_triangles, triangle => (triangle.ClosestPoint(position) - position).Length());

    // The box of the triangle, along one axis after the other. It is exact, so that equal distances count as beyond.
    private static bool IsBeyond(in OracleTriangle triangle, Vector position, double distance) =>
        Gap(triangle.A.X, triangle.B.X, triangle.C.X, position.X) >= distance
        || Gap(triangle.A.Y, triangle.B.Y, triangle.C.Y, position.Y) >= distance
        || Gap(triangle.A.Z, triangle.B.Z, triangle.C.Z, position.Z) >= distance;

    private static double Gap(double a, double b, double c, double position) =>
        Math.Max(Math.Min(a, Math.Min(b, c)) - position, position - Math.Max(a, Math.Max(b, c)));

    private static IEnumerable<OracleTriangle> TrianglesOf(PlacedMesh instance, int index)
    {
        var vertices = instance.Mesh.Vertices.Select(instance.Map.Apply).ToArray();
        var indices = instance.Mesh.Indices;
        for (var face = 0; face < instance.Mesh.FaceCount; face++)
        {
            var (i, j, k) = (indices[3 * face], indices[(3 * face) + 1], indices[(3 * face) + 2]);
            var reach = Math.Max(instance.Reach, Math.Max(Largest(vertices[i]), Math.Max(Largest(vertices[j]), Largest(vertices[k]))));
            yield return new(vertices[i], vertices[j], vertices[k], index, face, reach);
        }
    }
}
