using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Collision;

/// <summary>The nodes and leaves of a <see cref="FaceHierarchy"/> as they lie in memory, while they are being added.</summary>
internal sealed class HierarchyLayout
{
    /// <summary>What stands for a child that is not there; its box is infinitely far.</summary>
    public const int NoChild = int.MinValue;

    /// <summary>Vectors of a node: the smallest x, y and z of its eight children, then the largest.</summary>
    public const int NodeVectors = 6;

    /// <summary>[nodes × 6].</summary>
    public List<Vector256<float>> Boxes { get; } = [];

    /// <summary>[nodes × 8]: a node's number, or ~(4 · the leaf's number + its faces − 1).</summary>
    public List<int> Children { get; } = [];

    /// <summary>One for each leaf.</summary>
    public List<HierarchyLeaf> Leaves { get; } = [];

    /// <summary>Adds a node.</summary>
    /// <param name="children">Whose boxes it keeps; the children themselves come later.</param>
    /// <returns>Its number.</returns>
    public int AddNode(ReadOnlySpan<FaceRange> children)
    {
        Span<float> lanes = stackalloc float[NodeVectors * FaceHierarchyBuilder.Width];
        lanes[..(lanes.Length / 2)].Fill(float.PositiveInfinity);
        lanes[(lanes.Length / 2)..].Fill(float.NegativeInfinity);
        for (var child = 0; child < children.Length; child++)
        {
            for (var axis = 0; axis < 3; axis++)
            {
                lanes[(axis * FaceHierarchyBuilder.Width) + child] = children[child].Box.Minimum[axis];
                lanes[((3 + axis) * FaceHierarchyBuilder.Width) + child] = children[child].Box.Maximum[axis];
            }
        }

        Boxes.AddRange(MemoryMarshal.Cast<float, Vector256<float>>(lanes));
        for (var child = 0; child < FaceHierarchyBuilder.Width; child++)
        {
            Children.Add(NoChild);
        }

        return (Children.Count / FaceHierarchyBuilder.Width) - 1;
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
    public void AddLeaf(int slot, Mesh mesh, ReadOnlySpan<FaceBounds> faces)
    {
        Children[slot] = ~((Leaves.Count * FaceHierarchyBuilder.LeafFaces) + faces.Length - 1);
        Span<int> numbers = stackalloc int[4 * FaceHierarchyBuilder.LeafFaces];
        for (var i = 0; i < FaceHierarchyBuilder.LeafFaces; i++)
        {
            // The last face fills the lanes that are left over.
            var face = faces[Math.Min(i, faces.Length - 1)].Face;
            for (var corner = 0; corner < 3; corner++)
            {
                numbers[(corner * FaceHierarchyBuilder.LeafFaces) + i] = mesh.Faces[(3 * face) + corner];
            }

            numbers[(3 * FaceHierarchyBuilder.LeafFaces) + i] = face;
        }

        Leaves.Add(MemoryMarshal.Read<HierarchyLeaf>(MemoryMarshal.AsBytes(numbers)));
    }

    /// <summary>Appends a subtree.</summary>
    /// <param name="subtree">Its root is its first node.</param>
    /// <param name="slot">As in <see cref="SetChild"/>.</param>
    public void Append(HierarchyLayout subtree, int slot)
    {
        var (nodes, leaves) = (Children.Count / FaceHierarchyBuilder.Width, Leaves.Count);
        SetChild(slot, nodes);
        Boxes.AddRange(CollectionsMarshal.AsSpan(subtree.Boxes));
        Leaves.AddRange(CollectionsMarshal.AsSpan(subtree.Leaves));
        foreach (var child in subtree.Children)
        {
            Children.Add(child switch
            {
                NoChild => NoChild,
                >= 0 => child + nodes,
                _ => child - (leaves * FaceHierarchyBuilder.LeafFaces),
            });
        }
    }
}
