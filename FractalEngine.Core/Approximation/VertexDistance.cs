using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation;

/// <summary>Compares meshes by their vertices, whatever their order and their faces.</summary>
public static class VertexDistance
{
    /// <summary>Finds how far vertices of either mesh are from the nearest vertex of the other one, at most.</summary>
    /// <param name="mesh1">One mesh; only vertices of its faces count.</param>
    /// <param name="mesh2">The other mesh.</param>
    /// <param name="within">Distances beyond are not looked for, scene units, above 0.</param>
    /// <returns>The largest distance, scene units; null where a vertex has none so near.</returns>
    /// <remarks>Cost O(vertices).</remarks>
    public static double? FindLargest(Mesh mesh1, Mesh mesh2, double within)
    {
        ArgumentNullException.ThrowIfNull(mesh1);
        ArgumentNullException.ThrowIfNull(mesh2);
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(within);
        var (points1, points2) = (PointsOf(mesh1), PointsOf(mesh2));
        var largest = SquaresOf(points1, points2, within).Concat(SquaresOf(points2, points1, within)).Append(0).Max();
        return double.IsFinite(largest) ? Math.Sqrt(largest) : null;
    }

    /// <summary>Counts the vertices of a mesh that have a vertex of another one so near, and all. Cost O(vertices).</summary>
    /// <param name="mesh">The mesh; only vertices of its faces count, and those at one place once.</param>
    /// <param name="other">The other mesh.</param>
    /// <param name="within">Largest distance, scene units, above 0.</param>
    public static (int Near, int All) CountWithin(Mesh mesh, Mesh other, double within)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        ArgumentNullException.ThrowIfNull(other);
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(within);
        var points = PointsOf(mesh);
        return (SquaresOf(points, PointsOf(other), within).Count(double.IsFinite), points.Length);
    }

    private static Vector[] PointsOf(Mesh mesh) => [.. mesh.VertexIndices.Select(mesh.Vertex).Distinct()];

    /// <summary>The squared distance of each point from the nearest other one, infinite where none is so near.</summary>
    private static IEnumerable<double> SquaresOf(Vector[] from, Vector[] to, double within)
    {
        var grid = new PointGrid(to, within);
        foreach (var point in from)
        {
            var nearest = double.PositiveInfinity;
            for (var entry = grid.First(point); entry >= 0; entry = grid.Next(entry, point))
            {
                nearest = Math.Min(nearest, (to[grid.PointOf(entry)] - point).LengthSquared());
            }

            yield return nearest;
        }
    }
}
