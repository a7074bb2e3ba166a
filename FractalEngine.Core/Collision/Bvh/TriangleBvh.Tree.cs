using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Collision.Bvh;

/// <content>The nodes as a tree of boxes in the mesh's frame, for walks that don't look for a closest point.</content>
internal sealed partial class TriangleBvh
{
    /// <summary>The mesh whose triangles the hierarchy holds.</summary>
    public Mesh Mesh => _mesh;

    /// <summary>False where all triangles are tested without boxes: then <see cref="AllFaces"/> is the only leaf.</summary>
    public bool HasNodes => _nodes.Length > 0;

    /// <summary>True where leaves are searched in single precision, as in all but small meshes.</summary>
    public bool HasFloatLeaves => _frames.Length > 0;

    /// <summary>The face indices of all triangles, in the order of the leaves.</summary>
    public ReadOnlySpan<int> AllFaces => _faces;

    /// <summary>Finds one of the up to eight children of a node by its place.</summary>
    /// <param name="node">A node.</param>
    /// <param name="index">Index of the child, from 0 to 7.</param>
    /// <param name="child">The child: a node or a leaf.</param>
    /// <param name="box">A box around its triangles in the mesh's frame, to the rounding of its coordinates.</param>
    /// <returns>False for an absent child.</returns>
    public bool TryGetChild(BvhChild node, int index, out BvhChild child, out BoundingBox box)
    {
        child = Children(node)[index];
        if (child == BvhChild.None)
        {
            box = BoundingBox.Empty;
            return false;
        }

        var localBox = LocalBox(node, index);
        box = new(_origin + (localBox.Minimum / _scale), _origin + (localBox.Maximum / _scale));
        return true;
    }

    /// <summary>The box of a node's child in the units of the hierarchy.</summary>
    private BoundingBox LocalBox(BvhChild node, int child)
    {
        // A row for each of minimum x, y, z and maximum x, y, z, with a lane for each child.
        var rows = MemoryMarshal.Cast<Vector256<float>, float>(NodeBounds(node));
        double Row(ReadOnlySpan<float> values, int row) => values[(row * BvhLayout.BranchingFactor) + child];
        return new(new(Row(rows, 0), Row(rows, 1), Row(rows, 2)), new(Row(rows, 3), Row(rows, 4), Row(rows, 5)));
    }

    /// <summary>The face indices of a leaf's triangles.</summary>
    public ReadOnlySpan<int> Faces(BvhChild leaf) => _faces.AsSpan(leaf.FirstTriangle, leaf.TriangleCount);
}
