using System.Runtime.CompilerServices;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>
/// Splits small ranges of triangles in two by the surface area heuristic. Every place between full leaves is considered, along each axis.
/// </summary>
/// <remarks>A leaf costs the same however many triangles it has, so leaves are to be full.</remarks>
internal static class SweepSplitter
{
    /// <summary>Maximum number of triangles in a range.</summary>
    public const int MaxTriangles = 64;

    /// <summary>Sorts a range along the best axis, and returns the number of triangles on the left of the best place.</summary>
    /// <param name="triangles">More triangles than a leaf holds, and at most <see cref="MaxTriangles"/>.</param>
    /// <param name="maxLeafTriangles">Maximum number of triangles in a leaf.</param>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    public static int Split(Span<TriangleBounds> triangles, int maxLeafTriangles)
    {
        Span<TriangleBounds> sorted = stackalloc TriangleBounds[triangles.Length];
        Span<TriangleBounds> best = stackalloc TriangleBounds[triangles.Length];
        Span<float> centres = stackalloc float[triangles.Length];
        var bestCost = float.PositiveInfinity;
        var bestCount = -1;
        for (var axis = 0; axis < 3; axis++)
        {
            triangles.CopyTo(sorted);
            for (var i = 0; i < sorted.Length; i++)
            {
                centres[i] = sorted[i].DoubledCentre[axis];
            }

            centres.Sort(sorted);
            var (cost, count) = FindPlace(sorted, maxLeafTriangles);
            if (cost < bestCost || bestCount < 0)
            {
                bestCost = cost;
                bestCount = count;
                sorted.CopyTo(best);
            }
        }

        best.CopyTo(triangles);
        return bestCount;
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private static (float Cost, int Count) FindPlace(ReadOnlySpan<TriangleBounds> sorted, int maxLeafTriangles)
    {
        // One more than the full leaves of the largest range, if leaves hold but one triangle.
        Span<float> leftAreas = stackalloc float[MaxTriangles + 1];
        var bounds = SimdBoundingBox.Empty;
        for (var i = 0; i < sorted.Length; i++)
        {
            bounds = bounds.Including(sorted[i].Minimum, sorted[i].Maximum);
            leftAreas[i + 1] = bounds.HalfArea;
        }

        var bestCost = float.PositiveInfinity;
        var bestCount = maxLeafTriangles;
        bounds = SimdBoundingBox.Empty;
        for (var count = sorted.Length - 1; count > 0; count--)
        {
            bounds = bounds.Including(sorted[count].Minimum, sorted[count].Maximum);
            if (count % maxLeafTriangles == 0 || (sorted.Length - count) % maxLeafTriangles == 0)
            {
                var cost = (leftAreas[count] * LeafCount(count, maxLeafTriangles))
                    + (bounds.HalfArea * LeafCount(sorted.Length - count, maxLeafTriangles));
                if (cost < bestCost)
                {
                    bestCost = cost;
                    bestCount = count;
                }
            }
        }

        return (bestCost, bestCount);
    }

    private static int LeafCount(int triangles, int maxLeafTriangles) => (triangles + maxLeafTriangles - 1) / maxLeafTriangles;
}
