using FractalEngine.Core.Bvh.Splitting;

namespace FractalEngine.Core.Bvh.Objects;

/// <summary>
/// Builds an <see cref="ObjectBvh"/> from the root down with the surface area heuristic of a <see cref="BoxPartition"/>.
/// </summary>
/// <remarks>Unbounded and empty objects get subtrees of their own, so that they enlarge no box of the others.</remarks>
internal sealed class ObjectBvhBuilder(ObjectBvhLeaf[] leaves)
{
    // Below this depth nodes are halved, which ends within 16 levels: a path has room for 32.
    private const int MaxHeuristicDepth = 14;

    // A node of nodes with leaves only: here full nodes are worth more than the best split.
    private const int MaxFilledCount = ObjectBvhNode.Width * ObjectBvhNode.Width;

    private readonly ObjectBvhLeaf[] _leaves = leaves;
    private readonly BoxPartition _partition = new(Array.ConvertAll(leaves, static leaf => leaf.Bounds));

    /// <summary>Builds the tree over some objects.</summary>
    /// <param name="leaves">At least one.</param>
    public static ObjectBvhNode Build(ReadOnlySpan<ObjectBvhLeaf> leaves)
    {
        var all = leaves.ToArray();
        if (Array.TrueForAll(all, static leaf => ExtentOf(leaf) == Extent.Bounded) && all.Length > 1)
        {
            return (ObjectBvhNode)new ObjectBvhBuilder(all).BuildSubtree(Extent.Bounded);
        }

        var groups = all.ToLookup(ExtentOf);
        // One level below the root.
        object[] children = [.. new[] { Extent.Bounded, Extent.Unbounded, Extent.Empty }.Where(groups.Contains)
            .Select(extent => new ObjectBvhBuilder([.. groups[extent]]).BuildSubtree(extent))];
        return children is [ObjectBvhNode onlyNode] ? onlyNode : new(children);
    }

    private static Extent ExtentOf(ObjectBvhLeaf leaf) => leaf.Bounds.IsEmpty ? Extent.Empty
        : double.IsFinite(BoxPartition.SizeOf(leaf.Bounds)) ? Extent.Bounded
        : Extent.Unbounded;

    private object BuildSubtree(Extent extent) => BuildSubtree(new(0, _leaves.Length), extent == Extent.Bounded ? 1 : MaxHeuristicDepth);

    private object BuildSubtree(Range range, int depth)
    {
        if (BoxPartition.CountOf(range) == 1)
        {
            return _leaves[_partition.Order[range.Start.Value]];
        }

        // The group with the largest box is split until there are as many groups as children.
        var groups = _partition.Split(range, ObjectBvhNode.Width, enough: 1, group => Split(group, depth));
        return new ObjectBvhNode([.. groups.Select(group => BuildSubtree(group, depth + 1))]);
    }

    /// <summary>Finds the group to split next; −1 where all are single objects.</summary>

    private (Range Left, Range Right) Split(Range range, int depth)
    {
        var count = BoxPartition.CountOf(range);
        return depth < MaxHeuristicDepth && count > MaxFilledCount
            ? _partition.SplitInTwo(range)
            : _partition.SplitInOrder(range, MiddleOf(count));
    }

    /// <summary>About half of a number, and a multiple of a node's width where that fills nodes.</summary>
    private static int MiddleOf(int count) => count is > ObjectBvhNode.Width and <= MaxFilledCount
        ? ((count / 2) + ObjectBvhNode.Width - 1) / ObjectBvhNode.Width * ObjectBvhNode.Width
        : count / 2;

    private enum Extent
    {
        Bounded,
        Unbounded,
        Empty,
    }
}
