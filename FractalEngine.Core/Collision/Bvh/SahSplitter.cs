using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

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
            var leftCount = SweepSplitter.Split(
                triangles.AsSpan(range.Start, range.Count), range.DoubledCentreBounds, maxLeafTriangles);
            return (CreateRange(range.Start, leftCount), CreateRange(range.Start + leftCount, range.Count - leftCount));
        }

        return depth < MaxSahDepth && TryFindSplitPlane(range, out var plane) ? Partition(range, in plane) : SplitInHalf(range);
    }

    /// <summary>Moves the triangles on the left of a plane before the others.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private (TriangleRange Left, TriangleRange Right) Partition(TriangleRange range, in SplitPlane plane)
    {
        ref var first = ref MemoryMarshal.GetReference(triangles.AsSpan(range.Start, range.Count));
        var axis = plane.Axis;
        var minimum = plane.Bins.Minimum[axis];
        var scale = plane.Bins.Scale[axis];
        var firstRightBin = plane.LastLeftBin + 1f;
        var infinity = Vector256.Create(float.PositiveInfinity);
        var leftCentres = infinity;
        var rightCentres = infinity;
        var leftCount = 0;
        // No branch depends on a triangle: both are written, and the left part grows or does not.
        for (var i = 0; i < range.Count; i++)
        {
            ref var current = ref Unsafe.Add(ref first, i);
            ref var extents = ref Unsafe.As<TriangleBounds, float>(ref current);
            // As in CentreBins, so that triangles fall on the side of their bin.
            var bin = (Unsafe.Add(ref extents, axis) - Unsafe.Add(ref extents, 4 + axis) - minimum) * scale;
            var triangle = current;
            var isLeft = Vector256.LessThan(Vector256.Create(bin), Vector256.Create(firstRightBin));
            var centre = SimdBoundingBox.Of(triangle.DoubledCentre).Extents;
            leftCentres = Vector256.MinNative(leftCentres, Vector256.ConditionalSelect(isLeft, centre, infinity));
            rightCentres = Vector256.MinNative(rightCentres, Vector256.ConditionalSelect(isLeft, infinity, centre));
            ref var firstRight = ref Unsafe.Add(ref first, leftCount);
            current = firstRight;
            firstRight = triangle;
            leftCount -= isLeft.AsInt32()[0];
        }

        return (
            new(range.Start, leftCount, plane.LeftBounds, new(leftCentres)),
            new(range.Start + leftCount, range.Count - leftCount, plane.RightBounds, new(rightCentres)));
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
        foreach (ref readonly var triangle in triangles.AsSpan(start, count))
        {
            bounds = bounds.Including(triangle.Box);
            doubledCentreBounds = doubledCentreBounds.Including(SimdBoundingBox.Of(triangle.DoubledCentre));
        }

        return new(start, count, bounds, doubledCentreBounds);
    }

    /// <summary>Finds the plane between two bins with the lowest expected cost.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private bool TryFindSplitPlane(TriangleRange range, out SplitPlane plane)
    {
        var binCount = range.Count >= MinTrianglesForMaxBins ? MaxBins : MaxBins / 2;
        var bins = CentreBins.Create(range.DoubledCentreBounds, binCount);
        Span<SimdBoundingBox> binBounds = stackalloc SimdBoundingBox[3 * MaxBins];
        Span<int> binTriangles = stackalloc int[3 * MaxBins];
        binBounds.Fill(SimdBoundingBox.Empty);
        ref var firstBounds = ref MemoryMarshal.GetReference(binBounds);
        ref var firstCount = ref MemoryMarshal.GetReference(binTriangles);
        foreach (ref readonly var triangle in triangles.AsSpan(range.Start, range.Count))
        {
            var box = triangle.Box;
            // The bin along an axis is at most the last one, so that these references stay within their rows.
            var bin = bins.IndicesOf(box.DoubledCentre);
            var x = bin[0];
            var y = MaxBins + bin[1];
            var z = (2 * MaxBins) + bin[2];
            Unsafe.Add(ref firstBounds, x) = Unsafe.Add(ref firstBounds, x).Including(box);
            Unsafe.Add(ref firstBounds, y) = Unsafe.Add(ref firstBounds, y).Including(box);
            Unsafe.Add(ref firstBounds, z) = Unsafe.Add(ref firstBounds, z).Including(box);
            Unsafe.Add(ref firstCount, x)++;
            Unsafe.Add(ref firstCount, y)++;
            Unsafe.Add(ref firstCount, z)++;
        }

        plane = new(-1, -1, bins, default, default);
        var bestCost = float.PositiveInfinity;
        Span<SimdBoundingBox> rightBounds = stackalloc SimdBoundingBox[MaxBins];
        for (var axis = 0; axis < 3; axis++)
        {
            if (bins.Scale[axis] == 0)
            {
                continue;
            }

            var axisBounds = binBounds.Slice(axis * MaxBins, binCount);
            var axisTriangles = binTriangles.Slice(axis * MaxBins, binCount);
            var bounds = SimdBoundingBox.Empty;
            for (var bin = binCount - 1; bin > 0; bin--)
            {
                bounds = bounds.Including(axisBounds[bin]);
                rightBounds[bin] = bounds;
            }

            bounds = SimdBoundingBox.Empty;
            var count = 0;
            for (var bin = 0; bin < binCount - 1; bin++)
            {
                bounds = bounds.Including(axisBounds[bin]);
                count += axisTriangles[bin];
                var cost = ExpectedCost(bounds, count) + ExpectedCost(rightBounds[bin + 1], range.Count - count);
                if (count > 0 && count < range.Count && cost < bestCost)
                {
                    bestCost = cost;
                    plane = new(axis, bin, bins, bounds, rightBounds[bin + 1]);
                }
            }
        }

        return plane.Axis >= 0;
    }

    /// <summary>The surface of a range times its leaves.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private float ExpectedCost(SimdBoundingBox bounds, int triangleCount) => triangleCount == 0
        ? 0
        : bounds.HalfArea * ((triangleCount + maxLeafTriangles - 1) / maxLeafTriangles);

    /// <summary>A plane between two bins.</summary>
    /// <param name="Axis">The axis that it is perpendicular to; −1 for none.</param>
    /// <param name="LastLeftBin">Index of the bin on its left.</param>
    /// <param name="Bins">The bins.</param>
    /// <param name="LeftBounds">Contains the triangles of the bins on its left.</param>
    /// <param name="RightBounds">Contains the triangles of the bins on its right.</param>
    private readonly record struct SplitPlane(
        int Axis, int LastLeftBin, CentreBins Bins, SimdBoundingBox LeftBounds, SimdBoundingBox RightBounds);
}
