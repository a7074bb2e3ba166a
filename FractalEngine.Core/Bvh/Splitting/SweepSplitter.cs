using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Bvh.Splitting;

/// <summary>
/// Splits small ranges of triangles in two by the surface area heuristic. Every place between full leaves is considered, along each axis.
/// </summary>
/// <remarks>
/// A leaf costs the same however many triangles it has, so leaves are to be full. Triangles are sorted by rank: the place of a centre is
/// the number of smaller ones. For so few, counting them eight at a time is faster than any sort that branches.
/// </remarks>
internal static class SweepSplitter
{
    /// <summary>Maximum number of triangles in a range.</summary>
    public const int MaxTriangles = 64;

    // Centres are compared as integers of 24 bits, with the place of the triangle in the last bits: so no two are equal.
    private const float CentreSteps = 1 << 24;
    private const int PlaceBits = 6;

    // Two vectors of ranks are counted at a time.
    private const int RanksAtOnce = 16;

    /// <summary>Sorts a range along the best axis, and returns the number of triangles on the left of the best place.</summary>
    /// <param name="triangles">More triangles than a leaf holds, and at most <see cref="MaxTriangles"/>.</param>
    /// <param name="doubledCentreBounds">Contains the doubled centres of the triangles.</param>
    /// <param name="maxLeafTriangles">Maximum number of triangles in a leaf.</param>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    [SkipLocalsInit]
    public static int Split(Span<TriangleBounds> triangles, SimdBoundingBox doubledCentreBounds, int maxLeafTriangles)
    {
        Span<int> keys = stackalloc int[MaxTriangles];
        Span<int> ranks = stackalloc int[MaxTriangles];
        Span<TriangleBounds> sorted = stackalloc TriangleBounds[MaxTriangles];
        Span<TriangleBounds> best = stackalloc TriangleBounds[MaxTriangles];
        var minimum = doubledCentreBounds.Minimum;
        var size = doubledCentreBounds.Maximum - minimum;
        // As for CentreBins: the least floats would make the factor infinite.
        var scale = Vector128.Create(CentreSteps) / size & Vector128.GreaterThan(size, Vector128.Create(1e-30f));
        var bestCost = float.PositiveInfinity;
        var bestCount = -1;
        for (var axis = 0; axis < 3; axis++)
        {
            ComputeRanks(triangles, axis, minimum[axis], scale[axis], keys, ranks);
            for (var i = 0; i < triangles.Length; i++)
            {
                sorted[ranks[i]] = triangles[i];
            }

            var (cost, count) = FindPlace(sorted[..triangles.Length], maxLeafTriangles);
            if (cost < bestCost || bestCount < 0)
            {
                bestCost = cost;
                bestCount = count;
                var previous = best;
                best = sorted;
                sorted = previous;
            }
        }

        best[..triangles.Length].CopyTo(triangles);
        return bestCount;
    }

    /// <summary>Computes the place of each triangle in the order of centres along an axis.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private static void ComputeRanks(
        ReadOnlySpan<TriangleBounds> triangles, int axis, float minimum, float scale, Span<int> keys, Span<int> ranks)
    {
        ref var extents = ref Unsafe.As<TriangleBounds, float>(ref MemoryMarshal.GetReference(triangles));
        for (var i = 0; i < triangles.Length; i++)
        {
            var centre = Unsafe.Add(ref extents, (8 * i) + axis) - Unsafe.Add(ref extents, (8 * i) + 4 + axis);
            keys[i] = ((int)((centre - minimum) * scale) << PlaceBits) | i;
        }

        ref var key = ref MemoryMarshal.GetReference(keys);
        for (var first = 0; first < triangles.Length; first += RanksAtOnce)
        {
            // Lanes beyond the last triangle are computed from whatever lies there, and never read.
            var keys1 = Vector256.LoadUnsafe(ref key, (nuint)first);
            var keys2 = Vector256.LoadUnsafe(ref key, (nuint)first + 8);
            var ranks1 = Vector256<int>.Zero;
            var ranks2 = Vector256<int>.Zero;
            for (var i = 0; i < triangles.Length; i++)
            {
                var other = Vector256.Create(Unsafe.Add(ref key, i));
                ranks1 -= Vector256.GreaterThan(keys1, other);
                ranks2 -= Vector256.GreaterThan(keys2, other);
            }

            ranks1.CopyTo(ranks[first..]);
            ranks2.CopyTo(ranks[(first + 8)..]);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    [SkipLocalsInit]
    private static (float Cost, int Count) FindPlace(ReadOnlySpan<TriangleBounds> sorted, int maxLeafTriangles)
    {
        // Places that leave full leaves on their left or on their right, two for each leaf.
        Span<int> places = stackalloc int[2 * MaxTriangles];
        Span<float> leftAreas = stackalloc float[2 * MaxTriangles];
        var rest = sorted.Length % maxLeafTriangles;
        var placeCount = 0;
        var bounds = SimdBoundingBox.Empty;
        var i = 0;
        for (var full = 0; full < sorted.Length; full += maxLeafTriangles)
        {
            for (var part = full == 0 ? 1 : 0; part < (rest == 0 ? 1 : 2); part++)
            {
                var place = full + (part * rest);
                for (; i < place; i++)
                {
                    bounds = bounds.Including(sorted[i].Box);
                }

                places[placeCount] = place;
                leftAreas[placeCount] = bounds.HalfArea;
                placeCount++;
            }
        }

        // The last place may be the end of the range.
        placeCount -= places[placeCount - 1] == sorted.Length ? 1 : 0;
        var bestCost = float.PositiveInfinity;
        var bestCount = maxLeafTriangles;
        bounds = SimdBoundingBox.Empty;
        i = sorted.Length;
        for (var place = placeCount - 1; place >= 0; place--)
        {
            var count = places[place];
            for (; i > count; i--)
            {
                bounds = bounds.Including(sorted[i - 1].Box);
            }

            var cost = (leftAreas[place] * LeafCount(count, maxLeafTriangles))
                + (bounds.HalfArea * LeafCount(sorted.Length - count, maxLeafTriangles));
            if (cost < bestCost)
            {
                bestCost = cost;
                bestCount = count;
            }
        }

        return (bestCost, bestCount);
    }

    private static int LeafCount(int triangles, int maxLeafTriangles) => (triangles + maxLeafTriangles - 1) / maxLeafTriangles;
}
