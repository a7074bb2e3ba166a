using System.Runtime.CompilerServices;

namespace FractalEngine.Core.Bvh;

/// <summary>Refers to a child of a BVH node, which is a node, a leaf or absent. Its size is 4 bytes.</summary>
internal readonly record struct BvhChild
{
    // The index of a node, or the complement of 8 · the place of a leaf's first triangle + its triangles − 1, which is negative.
    private readonly int _code;

    private BvhChild(int code) => _code = code;

    /// <summary>The reference to an absent child, whose bounds are infinitely far away.</summary>
    public static BvhChild None => new(int.MinValue);

    /// <summary>The reference to the root, which is the first node.</summary>
    public static BvhChild Root => new(0);

    /// <summary>True for a child that is a node.</summary>
    public bool IsNode => _code >= 0;

    /// <summary>Index of the node; meaningless for a leaf.</summary>
    public int NodeIndex => _code;

    /// <summary>Place of the leaf's first triangle among the triangles of all leaves; meaningless for a node.</summary>
    public int FirstTriangle
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (int)((uint)~_code / BvhLayout.MaxLeafTriangles);
    }

    /// <summary>Number of triangles in the leaf, from 1 to 8; meaningless for a node.</summary>
    public int TriangleCount
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (int)((uint)~_code % BvhLayout.MaxLeafTriangles) + 1;
    }

    /// <summary>Creates a reference to a node.</summary>
    public static BvhChild ForNode(int nodeIndex) => new(nodeIndex);

    /// <summary>Creates a reference to a leaf.</summary>
    /// <param name="firstTriangle">Place of its first triangle among those of all leaves.</param>
    /// <param name="triangleCount">Number of triangles in it, from 1 to 8.</param>
    public static BvhChild ForLeaf(int firstTriangle, int triangleCount) =>
        new(~((firstTriangle * BvhLayout.MaxLeafTriangles) + triangleCount - 1));

    /// <summary>Restores a reference from its 32 bits, as entries of a traversal stack hold them.</summary>
    public static BvhChild FromBits(uint bits) => new((int)bits);

    /// <summary>Adjusts a reference of a subtree whose nodes are appended to those of another tree.</summary>
    /// <param name="firstNode">Number of nodes before the subtree.</param>
    public BvhChild Rebase(int firstNode) => IsNode ? ForNode(NodeIndex + firstNode) : this;
}
