using FractalEngine.Core.Bvh.Splitting;

namespace FractalEngine.Core.Bvh.Objects;

/// <summary>
/// A bounding volume hierarchy over the boxes of objects, four children a node. Immutable: any number of threads may traverse it.
/// </summary>
/// <remarks>
/// An object that moves is refitted: the nodes above it are replaced, O(log n), and the shape of the tree stays. Objects that move far make
/// boxes overlap. Then <see cref="IsDegraded"/> asks the owner for a new hierarchy, O(n log n).
/// </remarks>
/// <param name="root">The node that holds all objects.</param>
/// <param name="paths">Paths to the leaves by index of the object; refitted hierarchies share them, since the shape stays.</param>
/// <param name="builtSize">Size of all boxes when the hierarchy was built.</param>
/// <param name="currentSize">Size of all boxes.</param>
internal sealed class ObjectBvh(ObjectBvhNode root, ulong[] paths, double builtSize, double currentSize)
{
    // Boxes twice as large in all are visited about twice as often, which a new hierarchy costs less than.
    private const double MaxGrowth = 2;

    // The path to a leaf, from the root: the slot at each node.
    private const int BitsPerLevel = 2;

    /// <summary>The node that holds all objects.</summary>
    public ObjectBvhNode Root { get; } = root;

    /// <summary>Number of objects in the hierarchy.</summary>
    public int Count => paths.Length;

    /// <summary>Whether objects have moved so far that a hierarchy built anew is worth its cost.</summary>
    public bool IsDegraded => currentSize > MaxGrowth * builtSize;

    /// <summary>Builds the hierarchy, O(n log n).</summary>
    /// <param name="leaves">At least one; the leaf with the index i at i.</param>
    public static ObjectBvh Build(ReadOnlySpan<ObjectBvhLeaf> leaves)
    {
        var root = ObjectBvhBuilder.Build(leaves);
        var paths = new ulong[leaves.Length];
        var size = 0.0;
        Survey(root, 0, 0, paths, ref size);
        return new(root, paths, size, size);
    }

    /// <summary>Creates the same hierarchy with another leaf for one object.</summary>
    /// <param name="leaf">Has the index of the leaf that it replaces.</param>
    public ObjectBvh With(ObjectBvhLeaf leaf)
    {
        var size = currentSize;
        var root = Replace(Root, paths[leaf.Index], leaf, ref size);
        return new(root, paths, builtSize, size);
    }

    /// <summary>Finds the leaf of an object, O(log n).</summary>
    public ObjectBvhLeaf LeafOf(int index)
    {
        var node = Root;
        for (var path = paths[index]; ; path >>= BitsPerLevel)
        {
            var target = node[(int)(path & (ObjectBvhNode.Width - 1))];
            if (target is not ObjectBvhNode child)
            {
                return (ObjectBvhLeaf)target;
            }

            node = child;
        }
    }

    /// <summary>Writes the leaves to an array, each at its index.</summary>
    public void CopyTo<TLeaf>(Span<TLeaf> leaves)
        where TLeaf : ObjectBvhLeaf
        => CopyTo(Root, leaves);

    private static void CopyTo<TLeaf>(ObjectBvhNode node, Span<TLeaf> leaves)
        where TLeaf : ObjectBvhLeaf
    {
        for (var slot = 0; slot < node.ChildCount; slot++)
        {
            if (node[slot] is ObjectBvhNode child)
            {
                CopyTo(child, leaves);
            }
            else
            {
                var leaf = (TLeaf)node[slot];
                leaves[leaf.Index] = leaf;
            }
        }
    }

    /// <summary>Finds the path to each leaf, and adds up the sizes of the nodes below the root that are finite.</summary>
    private static void Survey(ObjectBvhNode node, int depth, ulong path, ulong[] paths, ref double size)
    {
        for (var slot = 0; slot < node.ChildCount; slot++)
        {
            var childPath = path | ((ulong)slot << (BitsPerLevel * depth));
            if (node[slot] is ObjectBvhNode child)
            {
                var childSize = BoxPartition.SizeOf(node.BoxOf(slot));
                size += double.IsFinite(childSize) ? childSize : 0;
                Survey(child, depth + 1, childPath, paths, ref size);
            }
            else
            {
                paths[((ObjectBvhLeaf)node[slot]).Index] = childPath;
            }
        }
    }

    private static ObjectBvhNode Replace(ObjectBvhNode node, ulong path, ObjectBvhLeaf leaf, ref double size)
    {
        var slot = (int)(path & (ObjectBvhNode.Width - 1));
        if (node[slot] is not ObjectBvhNode child)
        {
            return node.With(slot, leaf);
        }

        var replaced = Replace(child, path >> BitsPerLevel, leaf, ref size);
        var box = replaced.Box;
        var oldSize = BoxPartition.SizeOf(node.BoxOf(slot));
        if (double.IsFinite(oldSize))
        {
            // An object that has left all bounds needs a new hierarchy, which keeps it apart.
            var newSize = BoxPartition.SizeOf(box);
            size += double.IsFinite(newSize) ? newSize - oldSize : double.PositiveInfinity;
        }

        return node.With(slot, replaced);
    }
}
