using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>The nodes and leaves of a <see cref="TriangleBvh"/> in their order in memory, while the tree is built.</summary>
internal sealed class BvhLayout
{
    /// <summary>Number of children of a node, one for each lane of a Vector256&lt;float&gt;.</summary>
    public const int BranchingFactor = 8;

    /// <summary>Maximum number of triangles in a leaf, one for each lane of a <see cref="TriangleX4"/>.</summary>
    public const int MaxLeafTriangles = 4;

    /// <summary>Vectors of a node: minimum x, y and z of its eight children, then maximum x, y and z.</summary>
    public const int VectorsPerNode = 6;

    /// <summary>Bounds of the children of each node, [nodes × 6].</summary>
    public List<Vector256<float>> NodeBounds { get; } = [];

    /// <summary>References to the children of each node, [nodes × 8].</summary>
    public List<BvhChild> Children { get; } = [];

    /// <summary>The leaves in the order of their indices.</summary>
    public List<BvhLeaf> Leaves { get; } = [];

    /// <summary>Adds a node whose children are set later.</summary>
    /// <param name="children">Up to eight children, whose bounds the node keeps.</param>
    /// <returns>The index of the node.</returns>
    public int AddNode(ReadOnlySpan<TriangleRange> children)
    {
        Span<float> bounds = stackalloc float[VectorsPerNode * BranchingFactor];
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
    /// <param name="mesh">The mesh of the triangles.</param>
    /// <param name="triangles">One to four triangles.</param>
    public void AddLeaf(int slot, Mesh mesh, ReadOnlySpan<TriangleBounds> triangles)
    {
        Children[slot] = BvhChild.ForLeaf(Leaves.Count, triangles.Length);
        Span<int> indices = stackalloc int[4 * MaxLeafTriangles];
        for (var i = 0; i < MaxLeafTriangles; i++)
        {
            // The last triangle fills the lanes that are left over.
            var face = triangles[Math.Min(i, triangles.Length - 1)].FaceIndex;
            for (var corner = 0; corner < 3; corner++)
            {
                indices[(corner * MaxLeafTriangles) + i] = mesh.VertexIndices[(3 * face) + corner];
            }

            indices[(3 * MaxLeafTriangles) + i] = face;
        }

        Leaves.Add(MemoryMarshal.Read<BvhLeaf>(MemoryMarshal.AsBytes(indices)));
    }

    /// <summary>Appends a subtree and connects its root, which is its first node, to its parent.</summary>
    /// <param name="subtree">The subtree, which is left unchanged.</param>
    /// <param name="slot">As in <see cref="SetChild"/>.</param>
    public void AppendSubtree(BvhLayout subtree, int slot)
    {
        var firstNode = Children.Count / BranchingFactor;
        var firstLeaf = Leaves.Count;
        SetChild(slot, firstNode);
        NodeBounds.AddRange(CollectionsMarshal.AsSpan(subtree.NodeBounds));
        Leaves.AddRange(CollectionsMarshal.AsSpan(subtree.Leaves));
        foreach (var child in subtree.Children)
        {
            Children.Add(child.Rebase(firstNode, firstLeaf));
        }
    }
}
