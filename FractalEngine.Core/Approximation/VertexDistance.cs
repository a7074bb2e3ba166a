using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Geometry;
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
        return FindLargest(points1, points2, within) is { } there && FindLargest(points2, points1, within) is { } back
            ? Math.Max(there, back)
            : null;
    }

    private static Vector[] PointsOf(Mesh mesh)
    {
        var points = new HashSet<Vector>();
        foreach (var vertex in mesh.VertexIndices)
        {
            points.Add(mesh.Vertex(vertex));
        }

        return [.. points];
    }

    private static double? FindLargest(Vector[] from, Vector[] to, double within)
    {
        var grid = new PointGrid(to, within);
        var largest = 0.0;
        foreach (var point in from)
        {
            var nearest = double.PositiveInfinity;
            for (var entry = grid.First(point); entry >= 0; entry = grid.Next(entry, point))
            {
                nearest = Math.Min(nearest, (to[grid.PointOf(entry)] - point).LengthSquared());
            }

            if (double.IsPositiveInfinity(nearest))
            {
                return null;
            }

            largest = Math.Max(largest, nearest);
        }

        return Math.Sqrt(largest);
    }
}
