using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry;

/// <summary>
/// Partitions boxes into groups that lie apart, by the surface area heuristic (SAH) over bins: the plane with the lowest sum, over both
/// sides, of the surface area times the number of boxes.
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
    /// <remarks>Costs time in proportion to the number of boxes times the logarithm of the number of ranges.</remarks>
    public List<Range> Split(Range range, int maxRanges, int enough)
    {
        List<(Range Range, double HalfArea)> parts = [(range, HalfArea(BoundsOf(range)))];
        while (parts.Count < maxRanges)
        {
            var largest = -1;
            for (var i = 0; i < parts.Count; i++)
            {
                if (CountOf(parts[i].Range) > enough && (largest < 0 || parts[i].HalfArea > parts[largest].HalfArea))
                {
                    largest = i;
                }
            }

            if (largest < 0)
            {
                break;
            }

            var (left, right) = SplitInTwo(parts[largest].Range);
            parts[largest] = (left, HalfArea(BoundsOf(left)));
            parts.Insert(largest + 1, (right, HalfArea(BoundsOf(right))));
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

    private (Range Left, Range Right) SplitInTwo(Range range)
    {
        var indices = _order.AsSpan(range);
        var start = range.Start.Value;
        var centreBounds = BoundingBox.Empty;
        foreach (var index in indices)
        {
            centreBounds = centreBounds.Including(boxes[index].Centre);
        }

        var bestCost = double.PositiveInfinity;
        var bestAxis = -1;
        var bestBin = -1;
        for (var axis = 0; axis < 3; axis++)
        {
            if (Component(centreBounds.Size, axis) > 0)
            {
                FindBestBin(indices, centreBounds, axis, ref bestCost, ref bestAxis, ref bestBin);
            }
        }

        var middle = bestAxis < 0 ? indices.Length / 2 : Reorder(indices, centreBounds, bestAxis, bestBin);
        return (new(start, start + middle), new(start + middle, range.End));
    }

    private void FindBestBin(
        ReadOnlySpan<int> indices, BoundingBox centreBounds, int axis, ref double bestCost, ref int bestAxis, ref int bestBin)
    {
        Span<BoundingBox> bounds = new BoundingBox[BinCount];
        Span<int> counts = stackalloc int[BinCount];
        bounds.Fill(BoundingBox.Empty);
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
            rightCosts[bin] = rightCount == 0 ? double.PositiveInfinity : rightCount * HalfArea(rightBounds);
        }

        var leftBounds = BoundingBox.Empty;
        var leftCount = 0;
        for (var bin = 0; bin < BinCount - 1; bin++)
        {
            leftBounds = BoundingBox.Union(leftBounds, bounds[bin]);
            leftCount += counts[bin];
            var cost = leftCount == 0 ? double.PositiveInfinity : (leftCount * HalfArea(leftBounds)) + rightCosts[bin + 1];
            if (cost < bestCost)
            {
                bestCost = cost;
                bestAxis = axis;
                bestBin = bin;
            }
        }
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
        var offset = Component(box.Centre, axis) - Component(centreBounds.Minimum, axis);
        return Math.Clamp((int)(BinCount * (offset / Component(centreBounds.Size, axis))), 0, BinCount - 1);
    }

    // Halves keep boxes of any finite size within the range of a double.
    private static double HalfArea(BoundingBox box)
    {
        var (x, y, z) = box.Size;
        return (x * y) + (y * z) + (z * x);
    }

    private static double Component(Vector v, int axis) => axis switch
    {
        0 => v.X,
        1 => v.Y,
        _ => v.Z,
    };
}
