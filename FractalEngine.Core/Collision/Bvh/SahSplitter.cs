using System.Runtime.CompilerServices;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>
/// Splits ranges of triangles in two for <see cref="TriangleBvhBuilder"/>, by the surface area heuristic (SAH) over bins: it takes the
/// plane between two bins with the lowest sum, over both sides, of the surface area times the number of leaves.
/// </summary>
/// <param name="triangles">The triangles, which are reordered within the ranges.</param>
/// <param name="maxLeafTriangles">Maximum number of triangles in a leaf.</param>
internal sealed class SahSplitter(TriangleBounds[] triangles, int maxLeafTriangles)
{
    /// <summary>
    /// Maximum depth at which the heuristic is followed. Below it, ranges are split by number, so that no arrangement of triangles makes
    /// a tree of more than this and log₈(2³¹) levels.
    /// </summary>
    private const int MaxSahDepth = 20;

    private const int MaxBins = 16;

    // Ranges of fewer triangles are split over half as many bins.
    private const int MinTrianglesForMaxBins = 64;

    /// <summary>Finds the range to split next: the one with the largest surface or, deep in the tree, with the most triangles.</summary>
    /// <param name="ranges">The ranges to choose from.</param>
    /// <param name="depth">Depth of the node that they are to be children of.</param>
    /// <param name="total">Number of triangles in the node.</param>
    /// <returns>The place of the range; −1 when all are small enough for leaves.</returns>
    public int FindLargestSplittable(ReadOnlySpan<TriangleRange> ranges, int depth, int total)
    {
        var maxCount = total > 8 * maxLeafTriangles ? 8 * maxLeafTriangles : maxLeafTriangles;
        var largest = -1;
        var largestSize = -1f;
        for (var i = 0; i < ranges.Length; i++)
        {
            var rangeSize = depth < MaxSahDepth ? ranges[i].Bounds.HalfArea : ranges[i].Count;
            if (ranges[i].Count > maxCount && rangeSize > largestSize)
            {
                largest = i;
                largestSize = rangeSize;
            }
        }

        return largest;
    }

    /// <summary>Splits a range in two, neither of them empty.</summary>
    /// <param name="range">A range of at least two triangles.</param>
    /// <param name="depth">Depth of the node that the halves are to be children of.</param>
    // A mesh is built once, often before the tiers of the compiler have warmed up.
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    public (TriangleRange Left, TriangleRange Right) Split(TriangleRange range, int depth)
    {
        if (range.Count <= SweepSplitter.MaxTriangles && range.Count > maxLeafTriangles)
        {
            var leftCount = SweepSplitter.Split(triangles.AsSpan(range.Start, range.Count), maxLeafTriangles);
            return (CreateRange(range.Start, leftCount), CreateRange(range.Start + leftCount, range.Count - leftCount));
        }

        if (depth >= MaxSahDepth || !TryFindSplitPlane(range, out var axis, out var lastLeftBin, out var bins))
        {
            return SplitInHalf(range);
        }

        var rangeTriangles = triangles.AsSpan(range.Start, range.Count);
        var leftBounds = SimdBoundingBox.Empty;
        var leftCentreBounds = SimdBoundingBox.Empty;
        var rightBounds = SimdBoundingBox.Empty;
        var rightCentreBounds = SimdBoundingBox.Empty;
        var left = 0;
        var right = rangeTriangles.Length - 1;
        while (left <= right)
        {
            var triangle = rangeTriangles[left];
            var doubledCentre = triangle.DoubledCentre;
            if (bins.IndicesOf(doubledCentre)[axis] <= lastLeftBin)
            {
                leftBounds = leftBounds.Including(triangle.Minimum, triangle.Maximum);
                leftCentreBounds = leftCentreBounds.Including(doubledCentre, doubledCentre);
                left++;
            }
            else
            {
                rightBounds = rightBounds.Including(triangle.Minimum, triangle.Maximum);
                rightCentreBounds = rightCentreBounds.Including(doubledCentre, doubledCentre);
                (rangeTriangles[left], rangeTriangles[right]) = (rangeTriangles[right], triangle);
                right--;
            }
        }

        return (
            new(range.Start, left, leftBounds, leftCentreBounds),
            new(range.Start + left, range.Count - left, rightBounds, rightCentreBounds));
    }

    /// <summary>Splits by number, for triangles that no plane separates and for trees that are deep already.</summary>
    private (TriangleRange Left, TriangleRange Right) SplitInHalf(TriangleRange range)
    {
        var half = range.Count / 2;
        return (CreateRange(range.Start, half), CreateRange(range.Start + half, range.Count - half));
    }

    private TriangleRange CreateRange(int start, int count)
    {
        var bounds = SimdBoundingBox.Empty;
        var doubledCentreBounds = SimdBoundingBox.Empty;
        foreach (var triangle in triangles.AsSpan(start, count))
        {
            bounds = bounds.Including(triangle.Minimum, triangle.Maximum);
            doubledCentreBounds = doubledCentreBounds.Including(triangle.DoubledCentre, triangle.DoubledCentre);
        }

        return new(start, count, bounds, doubledCentreBounds);
    }

    /// <summary>Finds the plane between two bins with the lowest expected cost.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private bool TryFindSplitPlane(TriangleRange range, out int bestAxis, out int lastLeftBin, out CentreBins bins)
    {
        var binCount = range.Count >= MinTrianglesForMaxBins ? MaxBins : MaxBins / 2;
        bins = CentreBins.Create(range.DoubledCentreBounds, binCount);
        Span<SimdBoundingBox> binBounds = stackalloc SimdBoundingBox[3 * MaxBins];
        Span<int> binTriangles = stackalloc int[3 * MaxBins];
        binBounds.Fill(SimdBoundingBox.Empty);
        foreach (ref readonly var triangle in triangles.AsSpan(range.Start, range.Count))
        {
            var minimum = triangle.Minimum;
            var maximum = triangle.Maximum;
            var bin = bins.IndicesOf(minimum + maximum);
            var x = bin[0];
            var y = MaxBins + bin[1];
            var z = (2 * MaxBins) + bin[2];
            binBounds[x] = binBounds[x].Including(minimum, maximum);
            binBounds[y] = binBounds[y].Including(minimum, maximum);
            binBounds[z] = binBounds[z].Including(minimum, maximum);
            binTriangles[x]++;
            binTriangles[y]++;
            binTriangles[z]++;
        }

        bestAxis = -1;
        lastLeftBin = -1;
        var bestCost = float.PositiveInfinity;
        Span<float> rightCosts = stackalloc float[MaxBins];
        for (var axis = 0; axis < 3; axis++)
        {
            if (bins.Scale[axis] == 0)
            {
                continue;
            }

            var axisBounds = binBounds.Slice(axis * MaxBins, binCount);
            var axisTriangles = binTriangles.Slice(axis * MaxBins, binCount);
            var bounds = SimdBoundingBox.Empty;
            var count = 0;
            for (var bin = binCount - 1; bin > 0; bin--)
            {
                bounds = bounds.Including(axisBounds[bin]);
                count += axisTriangles[bin];
                rightCosts[bin] = ExpectedCost(bounds, count);
            }

            bounds = SimdBoundingBox.Empty;
            count = 0;
            for (var bin = 0; bin < binCount - 1; bin++)
            {
                bounds = bounds.Including(axisBounds[bin]);
                count += axisTriangles[bin];
                var cost = ExpectedCost(bounds, count) + rightCosts[bin + 1];
                if (count > 0 && count < range.Count && cost < bestCost)
                {
                    bestCost = cost;
                    bestAxis = axis;
                    lastLeftBin = bin;
                }
            }
        }

        return bestAxis >= 0;
    }

    /// <summary>The surface of a range times its leaves.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private float ExpectedCost(SimdBoundingBox bounds, int triangleCount) => triangleCount == 0
        ? 0
        : bounds.HalfArea * ((triangleCount + maxLeafTriangles - 1) / maxLeafTriangles);
}
