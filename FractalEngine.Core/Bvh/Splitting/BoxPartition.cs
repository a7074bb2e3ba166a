using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Bvh.Splitting;

/// <summary>
/// Partitions boxes into groups that lie apart, by the surface area heuristic (SAH) over bins along the longest side of their centres: the
/// plane with the lowest sum, over both sides, of the size times the number of boxes.
/// </summary>
/// <param name="boxes">The boxes, none of them empty.</param>
internal sealed class BoxPartition(BoundingBox[] boxes)
{
    private const int BinCount = 16;

    private readonly int[] _order = [.. Enumerable.Range(0, boxes.Length)];

    /// <summary>The indices of the boxes in the order of the groups.</summary>
    public ReadOnlySpan<int> Order => _order;

    /// <summary>Splits a range of <see cref="Order"/> into ranges of at least one box each, and reorders it to match.</summary>
    /// <param name="range">The range to split.</param>
    /// <param name="maxRanges">Maximum number of ranges.</param>
    /// <param name="enough">Ranges of no more boxes are not split.</param>
    /// <param name="splitOne">Splits the range with the largest box; null for <see cref="SplitInTwo"/>.</param>
    /// <remarks>Costs time in proportion to the number of boxes times the logarithm of the number of ranges.</remarks>
    public List<Range> Split(Range range, int maxRanges, int enough, Func<Range, (Range Left, Range Right)>? splitOne = null)
    {
        List<(Range Range, double Size)> parts = [(range, SizeOf(BoundsOf(range)))];
        while (parts.Count < maxRanges)
        {
            var largest = -1;
            for (var i = 0; i < parts.Count; i++)
            {
                if (CountOf(parts[i].Range) > enough && (largest < 0 || parts[i].Size > parts[largest].Size))
                {
                    largest = i;
                }
            }

            if (largest < 0)
            {
                break;
            }

            var (left, right) = (splitOne ?? SplitInTwo)(parts[largest].Range);
            parts[largest] = (left, SizeOf(BoundsOf(left)));
            parts.Insert(largest + 1, (right, SizeOf(BoundsOf(right))));
        }

        return [.. parts.Select(part => part.Range)];
    }

    /// <summary>Number of boxes in a range.</summary>
    public static int CountOf(Range range) => range.End.Value - range.Start.Value;

    /// <summary>The box around the boxes of a range.</summary>
    public BoundingBox BoundsOf(Range range)
    {
        var bounds = BoundingBox.Empty;
        foreach (var index in _order.AsSpan(range))
        {
            bounds = BoundingBox.Union(bounds, boxes[index]);
        }

        return bounds;
    }

    /// <summary>Splits a range of at least two boxes in two by the heuristic, or by number where all centres are equal.</summary>
    public (Range Left, Range Right) SplitInTwo(Range range)
    {
        var indices = _order.AsSpan(range);
        var centreBounds = CentreBoundsOf(indices);
        var axis = LongestAxis(centreBounds);
        var bestBin = centreBounds.Size.Component(axis) > 0 ? FindBestBin(indices, centreBounds, axis) : -1;
        var middle = bestBin < 0 ? indices.Length / 2 : Reorder(indices, centreBounds, axis, bestBin);
        return SplitAt(range, middle);
    }

    /// <summary>Splits a range in two by the order of the centres along the longest side of their box.</summary>
    /// <param name="range">The range to split.</param>
    /// <param name="leftCount">Number of boxes on the left side.</param>
    public (Range Left, Range Right) SplitInOrder(Range range, int leftCount)
    {
        var indices = _order.AsSpan(range);
        var axis = LongestAxis(CentreBoundsOf(indices));
        indices.Sort((index1, index2) => (boxes[index1].Centre.Component(axis), index1).CompareTo(
            (boxes[index2].Centre.Component(axis), index2)));
        return SplitAt(range, leftCount);
    }

    private static (Range Left, Range Right) SplitAt(Range range, int leftCount)
    {
        var middle = range.Start.Value + leftCount;
        return (new(range.Start, middle), new(middle, range.End));
    }

    private BoundingBox CentreBoundsOf(ReadOnlySpan<int> indices)
    {
        var bounds = BoundingBox.Empty;
        foreach (var index in indices)
        {
            bounds = bounds.Including(boxes[index].Centre);
        }

        return bounds;
    }

    private static int LongestAxis(BoundingBox box)
    {
        var (x, y, z) = box.Size;
        return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    }

    /// <summary>Finds the last bin on the left side of the cheapest plane; −1 where no plane has a finite cost.</summary>
    private int FindBestBin(ReadOnlySpan<int> indices, BoundingBox centreBounds, int axis)
    {
        Span<BoundingBox> bounds = stackalloc BoundingBox[BinCount];
        Span<int> counts = stackalloc int[BinCount];
        bounds.Fill(BoundingBox.Empty);
        counts.Clear();
        foreach (var index in indices)
        {
            var bin = BinOf(boxes[index], centreBounds, axis);
            bounds[bin] = BoundingBox.Union(bounds[bin], boxes[index]);
            counts[bin]++;
        }

        Span<double> rightCosts = stackalloc double[BinCount];
        var rightBounds = BoundingBox.Empty;
        var rightCount = 0;
        for (var bin = BinCount - 1; bin > 0; bin--)
        {
            rightBounds = BoundingBox.Union(rightBounds, bounds[bin]);
            rightCount += counts[bin];
            rightCosts[bin] = rightCount == 0 ? double.PositiveInfinity : rightCount * SizeOf(rightBounds);
        }

        var bestBin = -1;
        var bestCost = double.PositiveInfinity;
        var leftBounds = BoundingBox.Empty;
        var leftCount = 0;
        for (var bin = 0; bin < BinCount - 1; bin++)
        {
            leftBounds = BoundingBox.Union(leftBounds, bounds[bin]);
            leftCount += counts[bin];
            var cost = leftCount == 0 ? double.PositiveInfinity : (leftCount * SizeOf(leftBounds)) + rightCosts[bin + 1];
            if (cost < bestCost)
            {
                bestCost = cost;
                bestBin = bin;
            }
        }

        return bestBin;
    }

    /// <summary>Moves the boxes of the first bins to the front.</summary>
    /// <returns>Their number.</returns>
    private int Reorder(Span<int> indices, BoundingBox centreBounds, int axis, int lastLeftBin)
    {
        // The order within each side stays, so that the result does not depend on how ranges were split before.
        var right = new List<int>(indices.Length);
        var left = 0;
        foreach (var index in indices)
        {
            if (BinOf(boxes[index], centreBounds, axis) <= lastLeftBin)
            {
                indices[left++] = index;
            }
            else
            {
                right.Add(index);
            }
        }

        right.CopyTo(indices[left..]);
        return left;
    }

    private static int BinOf(BoundingBox box, BoundingBox centreBounds, int axis)
    {
        var offset = box.Centre.Component(axis) - centreBounds.Minimum.Component(axis);
        return Math.Clamp((int)(BinCount * (offset / centreBounds.Size.Component(axis))), 0, BinCount - 1);
    }

    /// <summary>
    /// The size of a box for estimates of how often it is visited: like the surface area, but above zero for lines and planes as well.
    /// </summary>
    public static double SizeOf(BoundingBox box)
    {
        var (x, y, z) = box.Size;
        var sum = x + y + z;
        return sum * sum;
    }
}
