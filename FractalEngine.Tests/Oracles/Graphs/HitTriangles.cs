using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Oracles.Graphs.Models;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>Finds the triangles of the oracle that answers of the engine name.</summary>
internal sealed class HitTriangles
{
    private readonly Fractal _fractal;
    private readonly TriangleSoup _soup;

    /// <summary>Compares the base meshes with those of the expansion.</summary>
    /// <exception cref="GraphMismatch">The fractal has a mesh that the expansion has not, and instances of it.</exception>
    public HitTriangles(Fractal fractal, TriangleSoup soup)
    {
        _fractal = fractal;
        _soup = soup;
        var known = soup.Instances.Select(static instance => instance.Mesh).Distinct().ToArray();
        Meshes = [.. fractal.BaseMeshes.Select(mesh => known.FirstOrDefault(item => IsSame(mesh, item)))];
        var found = Meshes.Where(static mesh => mesh is not null).ToArray();
        GraphMismatch.ThrowUnless(found.Length == known.Length, "meshes", $"{found.Length} of the {known.Length} meshes are there once");
    }

    /// <summary>The meshes of the model, in the order of those of the fractal; null for one that no instance shows.</summary>
    public ImmutableArray<OracleMesh?> Meshes { get; }

    /// <summary>
    /// Finds the triangle of a mesh and a face whose corners are closest to those under a map, relative to their reach: of instances that
    /// rounding tells apart, the one that rounding explains.
    /// </summary>
    /// <returns>The index of the triangle, −1 for none, and how far its corners are off.</returns>
    public (int Triangle, double Corners) Find(int meshIndex, int faceIndex, AffineMap map)
    {
        var (a, b, c) = _fractal.BaseMeshes[meshIndex].Face(faceIndex);
        (a, b, c) = (map * a, map * b, map * c);
        var (index, _) = FindBest(meshIndex, faceIndex, (in OracleTriangle triangle) => CornersOff(in triangle) / triangle.Reach);
        return (index, index < 0 ? double.PositiveInfinity : CornersOff(in _soup.Triangles[index]));

        double CornersOff(in OracleTriangle triangle) =>
            Math.Max((triangle.A - a).Length(), Math.Max((triangle.B - b).Length(), (triangle.C - c).Length()));
    }

    /// <summary>Finds the triangle of a mesh and a face that is closest to a point.</summary>
    public (int Triangle, double Distance) Find(int meshIndex, int faceIndex, Vector point) => FindBest(
        meshIndex, faceIndex, (in OracleTriangle triangle) => (triangle.ClosestPoint(point) - point).Length());

    private (int Triangle, double Distance) FindBest(int meshIndex, int faceIndex, TriangleMeasure measure)
    {
        var best = (Triangle: -1, Distance: double.PositiveInfinity);
        for (var i = 0; i < _soup.Triangles.Length; i++)
        {
            ref readonly var triangle = ref _soup.Triangles[i];
            if (triangle.Face == faceIndex && ReferenceEquals(_soup.Instances[triangle.Instance].Mesh, Meshes[meshIndex]))
            {
                var distance = measure(in triangle);
                best = distance < best.Distance ? (i, distance) : best;
            }
        }

        return best;
    }

    private static bool IsSame(Mesh mesh, OracleMesh other) => other.Indices.SequenceEqual(mesh.VertexIndices)
        && other.Vertices.SequenceEqual(Enumerable.Range(0, mesh.VertexCount).Select(mesh.Vertex));

    private delegate double TriangleMeasure(in OracleTriangle triangle);
}
