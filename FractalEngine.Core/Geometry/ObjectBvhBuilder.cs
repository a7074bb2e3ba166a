using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry;

/// <summary>
/// Builds an <see cref="ObjectBvh"/> from the root down with the surface area heuristic, over bins of the objects' centres.
/// </summary>
/// <remarks>Unbounded and empty objects get subtrees of their own, so that they enlarge no box of the others.</remarks>
internal sealed class ObjectBvhBuilder
{
    private const int BinCount = 16;

    // Below this depth nodes are halved, which ends within 16 levels: a path has room for 32.
    private const int MaxHeuristicDepth = 14;

    // A node of nodes with leaves only: here full nodes are worth more than the best split.
    private const int MaxFilledCount = ObjectBvhNode.Width * ObjectBvhNode.Width;

    private readonly Entry[] _entries;

    /// <summary>Prepares to build over some objects.</summary>
    /// <param name="leaves">At least one.</param>
    public ObjectBvhBuilder(ReadOnlySpan<ObjectBvhLeaf> leaves)
    {
        _entries = new Entry[leaves.Length];
        for (var i = 0; i < leaves.Length; i++)
        {
            _entries[i] = new(leaves[i].Bounds, leaves[i]);
        }
    }

    /// <summary>Builds the tree from the root down.</summary>
    public ObjectBvhNode Build()
    {
        var boundedCount = Partition(_entries, static box => double.IsFinite(ObjectBvh.SizeOf(box)) && !box.IsEmpty);
        var others = _entries.AsSpan(boundedCount);
        var unboundedCount = Partition(others, static box => !box.IsEmpty);
        var children = new List<object>();
        AddSubtree(_entries.AsSpan(0, boundedCount), children);
        AddSubtree(others[..unboundedCount], children);
        AddSubtree(others[unboundedCount..], children);
        return children is [ObjectBvhNode onlyNode] ? onlyNode : new([.. children]);
    }

    private static void AddSubtree(Span<Entry> objects, List<object> children)
    {
        if (objects.Length > 0)
        {
            // One level below the root.
            children.Add(BuildSubtree(objects, BoxOf(objects), 1));
        }
    }

    private static object BuildSubtree(Span<Entry> objects, BoundingBox box, int depth)
    {
        if (objects.Length == 1)
        {
            return objects[0].Leaf;
        }

        // The group with the largest box is split until there are as many groups as children.
        Span<Group> groups = stackalloc Group[ObjectBvhNode.Width];
        groups[0] = new(0, objects.Length, box);
        var count = 1;
        while (count < ObjectBvhNode.Width && TryFindLargestGroup(groups[..count], out var largest))
        {
            var (start, end, _) = groups[largest];
            var middle = start + Split(objects[start..end], depth);
            groups[largest] = new(start, middle, BoxOf(objects[start..middle]));
            groups[count] = new(middle, end, BoxOf(objects[middle..end]));
            count++;
        }

        var children = new object[count];
        for (var slot = 0; slot < count; slot++)
        {
            var (start, end, groupBox) = groups[slot];
            children[slot] = BuildSubtree(objects[start..end], groupBox, depth + 1);
        }

        return new ObjectBvhNode(children);
    }

    private static bool TryFindLargestGroup(ReadOnlySpan<Group> groups, out int largest)
    {
        largest = -1;
        var largestSize = 0.0;
        for (var i = 0; i < groups.Length; i++)
        {
            var size = ObjectBvh.SizeOf(groups[i].Box);
            if (groups[i].Count > 1 && (largest < 0 || size > largestSize))
            {
                largest = i;
                largestSize = size;
            }
        }

        return largest >= 0;
    }

    private static BoundingBox BoxOf(ReadOnlySpan<Entry> objects)
    {
        var box = BoundingBox.Empty;
        foreach (ref readonly var entry in objects)
        {
            box = BoundingBox.Union(box, entry.Box);
        }

        return box;
    }

    /// <summary>Sorts objects into two groups.</summary>
    /// <returns>Number of objects in the first group: neither none nor all.</returns>
    private static int Split(Span<Entry> objects, int depth)
    {
        var centres = BoundingBox.Empty;
        foreach (ref readonly var entry in objects)
        {
            centres = centres.Including(entry.Box.Centre);
        }

        var (x, y, z) = centres.Size;
        var axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
        var extent = Component(centres.Size, axis);
        if (!(extent > 0 && double.IsFinite(extent)))
        {
            return MiddleOf(objects.Length);
        }

        var binning = new Binning(axis, Component(centres.Minimum, axis), extent);
        return depth < MaxHeuristicDepth && objects.Length > MaxFilledCount && TrySplitByBins(objects, binning, out var count)
            ? count
            : SplitAtMedian(objects, axis);
    }

    private static int SplitAtMedian(Span<Entry> objects, int axis)
    {
        objects.Sort((entry1, entry2) => (Component(entry1.Box.Centre, axis), entry1.Leaf.Index).CompareTo(
            (Component(entry2.Box.Centre, axis), entry2.Leaf.Index)));
        return MiddleOf(objects.Length);
    }

    /// <summary>About half of a number, and a multiple of a node's width where that fills nodes.</summary>
    private static int MiddleOf(int count) => count is > ObjectBvhNode.Width and <= MaxFilledCount
        ? ((count / 2) + ObjectBvhNode.Width - 1) / ObjectBvhNode.Width * ObjectBvhNode.Width
        : count / 2;

    private static bool TrySplitByBins(Span<Entry> objects, Binning binning, out int count)
    {
        Span<int> counts = stackalloc int[BinCount];
        Span<BoundingBox> boxes = stackalloc BoundingBox[BinCount];
        counts.Clear();
        boxes.Fill(BoundingBox.Empty);
        foreach (ref readonly var entry in objects)
        {
            var bin = binning.BinOf(entry.Box);
            counts[bin]++;
            boxes[bin] = BoundingBox.Union(boxes[bin], entry.Box);
        }

        var firstBin = FindCheapestSplit(counts, boxes);
        count = 0;
        for (var i = 0; i < objects.Length; i++)
        {
            if (binning.BinOf(objects[i].Box) < firstBin)
            {
                (objects[i], objects[count]) = (objects[count], objects[i]);
                count++;
            }
        }

        return count > 0 && count < objects.Length;
    }

    /// <summary>Finds the bin at which the second group begins; 0 where no split has a finite cost.</summary>
    private static int FindCheapestSplit(ReadOnlySpan<int> counts, ReadOnlySpan<BoundingBox> boxes)
    {
        // Costs of all bins from the one on.
        Span<double> costs = stackalloc double[BinCount];
        var box = BoundingBox.Empty;
        var members = 0;
        for (var bin = BinCount - 1; bin > 0; bin--)
        {
            box = BoundingBox.Union(box, boxes[bin]);
            members += counts[bin];
            costs[bin] = ObjectBvh.SizeOf(box) * members;
        }

        var best = 0;
        var bestCost = double.PositiveInfinity;
        box = BoundingBox.Empty;
        members = 0;
        for (var bin = 1; bin < BinCount; bin++)
        {
            box = BoundingBox.Union(box, boxes[bin - 1]);
            members += counts[bin - 1];
            var cost = costs[bin] + (ObjectBvh.SizeOf(box) * members);
            if (cost < bestCost)
            {
                bestCost = cost;
                best = bin;
            }
        }

        return best;
    }

    /// <summary>Moves the objects whose boxes fulfil a condition to the front.</summary>
    /// <returns>Their number.</returns>
    private static int Partition(Span<Entry> objects, Func<BoundingBox, bool> isFirst)
    {
        var count = 0;
        for (var i = 0; i < objects.Length; i++)
        {
            if (isFirst(objects[i].Box))
            {
                (objects[i], objects[count]) = (objects[count], objects[i]);
                count++;
            }
        }

        return count;
    }

    private static double Component(Vector vector, int axis) => axis == 0 ? vector.X : axis == 1 ? vector.Y : vector.Z;

    private readonly record struct Entry(BoundingBox Box, ObjectBvhLeaf Leaf);

    private readonly record struct Group(int Start, int End, BoundingBox Box)
    {
        public int Count => End - Start;
    }

    /// <summary>Divides the extent of the centres along an axis into bins.</summary>
    private readonly record struct Binning(int Axis, double Minimum, double Extent)
    {
        public int BinOf(in BoundingBox box) =>
            Math.Clamp((int)((Component(box.Centre, Axis) - Minimum) / Extent * BinCount), 0, BinCount - 1);
    }
}
