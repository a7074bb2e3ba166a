using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>The nodes and leaves of a <see cref="TriangleBvh"/> as they lie in memory, while they are being added.</summary>
internal sealed class BvhLayout
{
    /// <summary>What stands for a child that is not there; its box is infinitely far.</summary>
    public const int NoChild = int.MinValue;

    /// <summary>Vectors of a node: the smallest x, y and z of its eight children, then the largest.</summary>
    public const int VectorsPerNode = 6;

    /// <summary>[nodes × 6].</summary>
    public List<Vector256<float>> NodeBounds { get; } = [];

    /// <summary>[nodes × 8]: a node's number, or ~(4 · the leaf's number + its faces − 1).</summary>
    public List<int> Children { get; } = [];

    /// <summary>One for each leaf.</summary>
    public List<BvhLeaf> Leaves { get; } = [];

    /// <summary>Adds a node.</summary>
    /// <param name="children">Whose boxes it keeps; the children themselves come later.</param>
    /// <returns>Its number.</returns>
    public int AddNode(ReadOnlySpan<TriangleRange> children)
    {
        Span<float> bounds = stackalloc float[VectorsPerNode * TriangleBvhBuilder.BranchingFactor];
        bounds[..(bounds.Length / 2)].Fill(float.PositiveInfinity);
        bounds[(bounds.Length / 2)..].Fill(float.NegativeInfinity);
        for (var child = 0; child < children.Length; child++)
        {
            for (var axis = 0; axis < 3; axis++)
            {
                bounds[(axis * TriangleBvhBuilder.BranchingFactor) + child] = children[child].Bounds.Minimum[axis];
                bounds[((3 + axis) * TriangleBvhBuilder.BranchingFactor) + child] = children[child].Bounds.Maximum[axis];
            }
        }

        NodeBounds.AddRange(MemoryMarshal.Cast<float, Vector256<float>>(bounds));
        for (var child = 0; child < TriangleBvhBuilder.BranchingFactor; child++)
        {
            Children.Add(NoChild);
        }

        return (Children.Count / TriangleBvhBuilder.BranchingFactor) - 1;
    }

    /// <summary>Says which node a child is.</summary>
    /// <param name="slot">8 · the parent's number + the child's; −1 for the root.</param>
    /// <param name="child">The node's number.</param>
    public void SetChild(int slot, int child)
    {
        if (slot >= 0)
        {
            Children[slot] = child;
        }
    }

    /// <summary>Adds a leaf of one to four faces.</summary>
    public void AddLeaf(int slot, Mesh mesh, ReadOnlySpan<TriangleBounds> triangles)
    {
        Children[slot] = ~((Leaves.Count * TriangleBvhBuilder.MaxLeafTriangles) + triangles.Length - 1);
        Span<int> indices = stackalloc int[4 * TriangleBvhBuilder.MaxLeafTriangles];
        for (var i = 0; i < TriangleBvhBuilder.MaxLeafTriangles; i++)
        {
            // The last face fills the lanes that are left over.
            var face = triangles[Math.Min(i, triangles.Length - 1)].FaceIndex;
            for (var corner = 0; corner < 3; corner++)
            {
                indices[(corner * TriangleBvhBuilder.MaxLeafTriangles) + i] = mesh.VertexIndices[(3 * face) + corner];
            }

            indices[(3 * TriangleBvhBuilder.MaxLeafTriangles) + i] = face;
        }

        Leaves.Add(MemoryMarshal.Read<BvhLeaf>(MemoryMarshal.AsBytes(indices)));
    }

    /// <summary>Appends a subtree.</summary>
    /// <param name="subtree">Its root is its first node.</param>
    /// <param name="slot">As in <see cref="SetChild"/>.</param>
    public void AppendSubtree(BvhLayout subtree, int slot)
    {
        var (firstNode, firstLeaf) = (Children.Count / TriangleBvhBuilder.BranchingFactor, Leaves.Count);
        SetChild(slot, firstNode);
        NodeBounds.AddRange(CollectionsMarshal.AsSpan(subtree.NodeBounds));
        Leaves.AddRange(CollectionsMarshal.AsSpan(subtree.Leaves));
        foreach (var child in subtree.Children)
        {
            Children.Add(child switch
            {
                NoChild => NoChild,
                >= 0 => child + firstNode,
                _ => child - (firstLeaf * TriangleBvhBuilder.MaxLeafTriangles),
            });
        }
    }
}
