using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh.Splitting;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Bvh;

/// <summary>The nodes and leaves of a <see cref="TriangleBvh"/> in their order in memory, while the tree is built.</summary>
/// <param name="faces">Face indices of the triangles in the order of the leaves; leaves are written as they are added.</param>
/// <param name="frames">The rows of all leaves, see <see cref="TriangleFrames"/>; a leaf begins at 12 · its first triangle.</param>
internal sealed class BvhLayout(int[] faces, float[] frames)
{
    /// <summary>Number of children of a node, one for each lane of a Vector256&lt;float&gt;.</summary>
    public const int BranchingFactor = 8;

    /// <summary>Maximum number of triangles in a leaf, one for each lane of a Vector256&lt;float&gt;.</summary>
    public const int MaxLeafTriangles = 8;

    /// <summary>
    /// Vectors of a node: minimum x, y and z of its eight children, maximum x, y and z, references to the children, and one unused.
    /// </summary>
    public const int VectorsPerNode = 8;

    private const int BoundsPerNode = 6;
    private const int NodeAlignment = 256;

    /// <summary>Bounds of the children of each node, [nodes × 6].</summary>
    public List<Vector256<float>> NodeBounds { get; } = [];

    /// <summary>References to the children of each node, [nodes × 8].</summary>
    public List<BvhChild> Children { get; } = [];

    /// <summary>Length of the longest edge in the boxes' units.</summary>
    public double LongestEdge { get; private set; }

    /// <summary>Face indices of the triangles in the order of the leaves.</summary>
    public int[] Faces { get; } = faces;

    /// <summary>The rows of all leaves, and room to read eight lanes from the last one.</summary>
    public float[] Frames { get; } = frames;

    /// <summary>Adds a node whose children are set later.</summary>
    /// <param name="children">Up to eight children, whose bounds the node keeps.</param>
    /// <returns>The index of the node.</returns>
    public int AddNode(ReadOnlySpan<TriangleRange> children)
    {
        Span<float> bounds = stackalloc float[BoundsPerNode * BranchingFactor];
        bounds[..(bounds.Length / 2)].Fill(float.PositiveInfinity);
        bounds[(bounds.Length / 2)..].Fill(float.NegativeInfinity);
        for (var child = 0; child < children.Length; child++)
        {
            for (var axis = 0; axis < 3; axis++)
            {
                bounds[(axis * BranchingFactor) + child] = children[child].Bounds.Minimum[axis];
                bounds[((3 + axis) * BranchingFactor) + child] = children[child].Bounds.Maximum[axis];
            }
        }

        NodeBounds.AddRange(MemoryMarshal.Cast<float, Vector256<float>>(bounds));
        for (var child = 0; child < BranchingFactor; child++)
        {
            Children.Add(BvhChild.None);
        }

        return (Children.Count / BranchingFactor) - 1;
    }

    /// <summary>Copies the nodes to an array that stays where it is.</summary>
    /// <returns>The array, and the number of bytes before the first node, which begins at a multiple of 256 bytes.</returns>
    public (Vector256<float>[] Nodes, nint Offset) CreateNodes()
    {
        var nodeCount = Children.Count / BranchingFactor;
        var nodes = GC.AllocateArray<Vector256<float>>((nodeCount + 1) * VectorsPerNode, pinned: true);
        var address = Marshal.UnsafeAddrOfPinnedArrayElement(nodes, 0);
        var offset = (NodeAlignment - (address % NodeAlignment)) % NodeAlignment;
        var children = MemoryMarshal.Cast<BvhChild, Vector256<float>>(CollectionsMarshal.AsSpan(Children));
        ref var target = ref Unsafe.AddByteOffset(ref MemoryMarshal.GetArrayDataReference(nodes), offset);
        for (var node = 0; node < nodeCount; node++)
        {
            for (var i = 0; i < BoundsPerNode; i++)
            {
                Unsafe.Add(ref target, (node * VectorsPerNode) + i) = NodeBounds[(node * BoundsPerNode) + i];
            }

            Unsafe.Add(ref target, (node * VectorsPerNode) + BoundsPerNode) = children[node];
        }

        return (nodes, offset);
    }

    /// <summary>Lists the number of triangles in each leaf, in the order of the leaves.</summary>
    public int[] LeafCounts() =>
        [.. Children.Where(child => child != BvhChild.None && !child.IsNode).OrderBy(leaf => leaf.FirstTriangle)
            .Select(leaf => leaf.TriangleCount)];

    /// <summary>Connects a node to its parent.</summary>
    /// <param name="slot">8 · the parent's index + the place among its children; −1 for the root, which has no parent.</param>
    /// <param name="nodeIndex">Index of the node.</param>
    public void SetChild(int slot, int nodeIndex)
    {
        if (slot >= 0)
        {
            Children[slot] = BvhChild.ForNode(nodeIndex);
        }
    }

    /// <summary>Adds a leaf and connects it to its parent.</summary>
    /// <param name="slot">8 · the parent's index + the place among its children.</param>
    /// <param name="firstTriangle">Place of its first triangle among those of all leaves.</param>
    /// <param name="triangles">One to eight triangles.</param>
    /// <param name="mesh">The mesh of the triangles.</param>
    /// <param name="origin">Origin of the frames' coordinates.</param>
    /// <param name="scale">Factor by which coordinates relative to the origin are multiplied.</param>
    public void AddLeaf(
        int slot, int firstTriangle, ReadOnlySpan<TriangleBounds> triangles, Mesh mesh, Vector origin, double scale)
    {
        Children[slot] = BvhChild.ForLeaf(firstTriangle, triangles.Length);
        var leafFaces = Faces.AsSpan(firstTriangle, triangles.Length);
        for (var i = 0; i < triangles.Length; i++)
        {
            leafFaces[i] = triangles[i].FaceIndex;
        }

        leafFaces.Sort();
        var longestEdge = TriangleFrames.Write(mesh, origin, scale, leafFaces, Frames.AsSpan(TriangleFrames.Rows * firstTriangle));
        LongestEdge = Math.Max(LongestEdge, longestEdge);
    }

    /// <summary>Appends the nodes of a subtree and connects its root, which is its first node, to its parent.</summary>
    /// <param name="subtree">The subtree, which is left unchanged.</param>
    /// <param name="slot">As in <see cref="SetChild"/>.</param>
    public void AppendSubtree(BvhLayout subtree, int slot)
    {
        var firstNode = Children.Count / BranchingFactor;
        SetChild(slot, firstNode);
        LongestEdge = Math.Max(LongestEdge, subtree.LongestEdge);
        NodeBounds.AddRange(CollectionsMarshal.AsSpan(subtree.NodeBounds));
        foreach (var child in subtree.Children)
        {
            Children.Add(child.Rebase(firstNode));
        }
    }
}
