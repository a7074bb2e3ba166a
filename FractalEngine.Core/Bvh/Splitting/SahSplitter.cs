using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Bvh.Splitting;

/// <summary>
/// Splits ranges of triangles in two for the builder of a hierarchy, by the surface area heuristic (SAH) over bins: it takes the plane
/// between two bins with the lowest sum, over both sides, of the surface area times the number of leaves.
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

    private readonly int _leafBits = BitOperations.Log2((uint)maxLeafTriangles);

    private const int MaxBins = 16;

    // Three axes, twice.
    private const int Rows = 6;

    // Ranges of fewer triangles are split over half as many bins.
    private const int MinTrianglesForMaxBins = 64;

    /// <summary>Finds the range to split next: the one with the largest surface or, deep in the tree, with the most triangles.</summary>
    /// <param name="ranges">The ranges to choose from.</param>
    /// <param name="depth">Depth of the node that they are to be children of.</param>
    /// <param name="total">Number of triangles in the node.</param>
    /// <returns>The place of the range; −1 when all are small enough for leaves.</returns>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
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

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
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
        Span<SimdBoundingBox> binBounds = stackalloc SimdBoundingBox[Rows * MaxBins];
        Span<int> binTriangles = stackalloc int[Rows * MaxBins];
        FillBins(triangles.AsSpan(range.Start, range.Count), bins, binBounds, binTriangles);
        var bestAxis = -1;
        var lastLeftBin = -1;
        var bestCost = float.PositiveInfinity;
        Span<float> rightAreas = stackalloc float[MaxBins];
        for (var axis = 0; axis < 3; axis++)
        {
            if (bins.Scale[axis] == 0)
            {
                continue;
            }

            ref var axisBounds = ref binBounds[axis * MaxBins];
            ref var axisTriangles = ref binTriangles[axis * MaxBins];
            var bounds = SimdBoundingBox.Empty;
            for (var bin = binCount - 1; bin > 0; bin--)
            {
                bounds = bounds.Including(Unsafe.Add(ref axisBounds, bin));
                rightAreas[bin] = bounds.HalfArea;
            }

            bounds = SimdBoundingBox.Empty;
            var count = 0;
            for (var bin = 0; bin < binCount - 1; bin++)
            {
                bounds = bounds.Including(Unsafe.Add(ref axisBounds, bin));
                count += Unsafe.Add(ref axisTriangles, bin);
                var cost = (bounds.HalfArea * LeafCount(count)) + (rightAreas[bin + 1] * LeafCount(range.Count - count));
                // Sides without triangles have infinite areas, and so no cost that is less.
                if (cost < bestCost)
                {
                    bestCost = cost;
                    bestAxis = axis;
                    lastLeftBin = bin;
                }
            }
        }

        plane = bestAxis < 0 ? default : new(
            bestAxis, lastLeftBin, bins, UnionOf(binBounds.Slice(bestAxis * MaxBins, lastLeftBin + 1)),
            UnionOf(binBounds.Slice((bestAxis * MaxBins) + lastLeftBin + 1, binCount - lastLeftBin - 1)));
        return bestAxis >= 0;
    }

    /// <summary>Joins the boxes of the triangles in each bin, and counts them.</summary>
    /// <param name="range">The triangles.</param>
    /// <param name="bins">Divides their centres.</param>
    /// <param name="binBounds">Receives the boxes of the bins, [axes × bins]; the rows after them are scratch memory.</param>
    /// <param name="binTriangles">Receives the numbers of triangles, likewise.</param>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private static void FillBins(
        ReadOnlySpan<TriangleBounds> range, CentreBins bins, Span<SimdBoundingBox> binBounds, Span<int> binTriangles)
    {
        binBounds.Fill(SimdBoundingBox.Empty);
        binTriangles.Clear();
        // Neighbours fall into the same bins. Every other one has rows of its own, so that they don't wait for each other.
        ref var bounds1 = ref MemoryMarshal.GetReference(binBounds);
        ref var bounds2 = ref Unsafe.Add(ref bounds1, 3 * MaxBins);
        ref var counts = ref MemoryMarshal.GetReference(binTriangles);
        ref var first = ref MemoryMarshal.GetReference(range);
        var i = 0;
        for (; i + 1 < range.Length; i += 2)
        {
            Add(bins, Unsafe.Add(ref first, i).Box, ref bounds1, ref counts);
            Add(bins, Unsafe.Add(ref first, i + 1).Box, ref bounds2, ref Unsafe.Add(ref counts, 3 * MaxBins));
        }

        if (i < range.Length)
        {
            Add(bins, Unsafe.Add(ref first, i).Box, ref bounds1, ref counts);
        }

        for (var bin = 0; bin < 3 * MaxBins; bin++)
        {
            binBounds[bin] = binBounds[bin].Including(binBounds[(3 * MaxBins) + bin]);
            binTriangles[bin] += binTriangles[(3 * MaxBins) + bin];
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static void Add(CentreBins bins, SimdBoundingBox box, ref SimdBoundingBox bounds, ref int counts)
    {
        // The bin along an axis is at most the last one, so that these references stay within their rows.
        var bin = bins.IndicesOf(box.DoubledCentre);
        nint x = bin[0];
        nint y = MaxBins + bin[1];
        nint z = (2 * MaxBins) + bin[2];
        ref var boundsX = ref Unsafe.Add(ref bounds, x);
        ref var boundsY = ref Unsafe.Add(ref bounds, y);
        ref var boundsZ = ref Unsafe.Add(ref bounds, z);
        boundsX = boundsX.Including(box);
        boundsY = boundsY.Including(box);
        boundsZ = boundsZ.Including(box);
        Unsafe.Add(ref counts, x)++;
        Unsafe.Add(ref counts, y)++;
        Unsafe.Add(ref counts, z)++;
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private static SimdBoundingBox UnionOf(ReadOnlySpan<SimdBoundingBox> boxes)
    {
        var union = SimdBoundingBox.Empty;
        foreach (var box in boxes)
        {
            union = union.Including(box);
        }

        return union;
    }

    /// <summary>Number of full leaves that so many triangles need.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private int LeafCount(int triangleCount) => (triangleCount + maxLeafTriangles - 1) >> _leafBits;

    /// <summary>A plane between two bins.</summary>
    /// <param name="Axis">The axis that it is perpendicular to; −1 for none.</param>
    /// <param name="LastLeftBin">Index of the bin on its left.</param>
    /// <param name="Bins">The bins.</param>
    /// <param name="LeftBounds">Contains the triangles of the bins on its left.</param>
    /// <param name="RightBounds">Contains the triangles of the bins on its right.</param>
    private readonly record struct SplitPlane(
        int Axis, int LastLeftBin, CentreBins Bins, SimdBoundingBox LeftBounds, SimdBoundingBox RightBounds);
}
