using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>
/// A bounding volume hierarchy over the triangles of a mesh, with eight children a node and up to four triangles a leaf. Exact: the
/// distance it finds is, to the last bit, the smallest that <see cref="TriangleKernel"/> gives for any triangle.
/// </summary>
/// <remarks>
/// Boxes are floats relative to the mesh's centre and size, rounded outwards. A position becomes an interval of floats that contains it.
/// So a box's distance comes out too large by no more than the rounding of four sums and three products. The limit that it is compared
/// with is raised by more than that and by more than the rounding of the kernel (see <see cref="BoundCutoff"/>): no box is culled whose
/// triangles could be closer. Positions so far away that an interval of floats would contain all boxes are compared in double precision.
/// <para>Triangles are tested in double precision, four at once, from the mesh's own arrays. Small meshes precompute what they can.</para>
/// </remarks>
internal sealed partial class TriangleBvh
{
    // Up to so many triangles are kept precomputed, 136 bytes for each four.
    private const int MaxPrecomputedTriangles = 64;

    // Up to so many triangles are all tested, since boxes would save nothing.
    private const int MaxBruteForceTriangles = 8;

    // In units of the mesh's half size. Here the rounding of a position to single precision is 4e-6 of it, less than most triangles.
    private const double FarThreshold = 64;

    private readonly Mesh _mesh;
    private readonly Vector _origin;
    private readonly double _scale;
    private readonly double _magnitude;
    private readonly Vector256<float>[] _nodeBounds = [];
    private readonly BvhChild[] _children = [];
    private readonly BvhLeaf[] _leaves = [];
    private readonly TriangleX4[] _precomputedLeaves = [];
    private readonly int _stackSize;

    /// <summary>Builds the hierarchy of a mesh. Cost: O(n·log n) for n faces, on all cores where they are many.</summary>
    public TriangleBvh(Mesh mesh)
    {
        _mesh = mesh;
        if (mesh.FaceCount == 0)
        {
            return;
        }

        _origin = mesh.Bounds.Centre;
        _scale = PowerOfTwoScale(0.5 * mesh.Bounds.Size.MaxAbsComponent());
        var maxCoordinate = Vector.Max(mesh.Bounds.Minimum.Absolute(), mesh.Bounds.Maximum.Absolute()).MaxAbsComponent();
        _magnitude = (2 * maxCoordinate * _scale) + FarThreshold;
        var layout = TriangleBvhBuilder.Build(mesh, _origin, _scale);
        _nodeBounds = [.. layout.NodeBounds];
        _children = [.. layout.Children];
        _leaves = [.. layout.Leaves];
        _precomputedLeaves = mesh.FaceCount <= MaxPrecomputedTriangles ? [.. layout.Leaves.Select(GatherTriangles)] : [];
        // A node on the stack is replaced by up to eight.
        _stackSize = ((BvhLayout.BranchingFactor - 1) * SubtreeHeight(BvhChild.Root)) + 1;
    }

    /// <summary>Number of triangles in the mesh.</summary>
    public int FaceCount => _mesh.FaceCount;

    /// <summary>Number of bytes kept beside the mesh.</summary>
    public long StorageBytes =>
        (_nodeBounds.Length * 32L) + (_children.Length * 4L) + (_leaves.Length * 64L)
        + (_precomputedLeaves.Length * (long)Unsafe.SizeOf<TriangleX4>());

    /// <summary>Finds the closest triangle, if it is closer than the limit.</summary>
    /// <param name="position">In the mesh's frame, finite.</param>
    /// <param name="closest">The limit; receives the closest triangle and the cost.</param>
    /// <param name="boundFactor">Squared bounds are multiplied by this before they are compared: (1 + ε)², 1 for exact answers.</param>
    public void FindClosest(in Vector position, ref ClosestTriangle closest, double boundFactor)
    {
        if (_mesh.FaceCount <= MaxBruteForceTriangles)
        {
            TestAllTriangles(in position, ref closest);
            return;
        }

        var localPosition = (position - _origin) * _scale;
        // The products stay finite for any factor.
        var inverseBoundFactor = 1 / Math.Min(boundFactor, 1e30);
        if (localPosition.MaxAbsComponent() < FarThreshold)
        {
            TraverseNear(in position, in localPosition, ref closest, inverseBoundFactor);
        }
        else
        {
            TraverseFar(BvhChild.Root, in position, in localPosition, ref closest, inverseBoundFactor);
        }
    }

    /// <summary>Tests every triangle, whatever the bounds are.</summary>
    /// <param name="position">In the mesh's frame, finite.</param>
    /// <param name="closest">The limit; receives the closest triangle and the cost.</param>
    public void TestAllTriangles(in Vector position, ref ClosestTriangle closest)
    {
        for (var leaf = 0; leaf < _leaves.Length; leaf++)
        {
            TryUpdateClosest(DistancesSquared(leaf, in position, closest.DistanceSquared), leaf, ref closest);
        }

        closest.FaceTests += _mesh.FaceCount;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private ReadOnlySpan<Vector256<float>> NodeBounds(BvhChild node) =>
        _nodeBounds.AsSpan(node.NodeIndex * BvhLayout.VectorsPerNode, BvhLayout.VectorsPerNode);

    private ReadOnlySpan<BvhChild> Children(BvhChild node) =>
        _children.AsSpan(node.NodeIndex * BvhLayout.BranchingFactor, BvhLayout.BranchingFactor);

    private bool TestLeaf(BvhChild leaf, in Vector position, ref ClosestTriangle closest)
    {
        closest.FaceTests += leaf.TriangleCount;
        return TryUpdateClosest(DistancesSquared(leaf.LeafIndex, in position, closest.DistanceSquared), leaf.LeafIndex, ref closest);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private Vector256<double> DistancesSquared(int leaf, ref readonly Vector position, double closestDistanceSquared) =>
        _precomputedLeaves.Length > 0
        ? TriangleX4.DistancesSquared(in _precomputedLeaves[leaf], in position, closestDistanceSquared)
        : TriangleX4.DistancesSquared(in _leaves[leaf], _mesh.Positions.AsSpan(), in position);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private bool TryUpdateClosest(Vector256<double> distancesSquared, int leaf, ref ClosestTriangle closest)
    {
        if (!Vector256.LessThanAny(distancesSquared, Vector256.Create(closest.DistanceSquared)))
        {
            return false;
        }

        SelectClosest(distancesSquared, in _leaves[leaf], ref closest);
        return true;
    }

    private static void SelectClosest(Vector256<double> distancesSquared, ref readonly BvhLeaf leaf, ref ClosestTriangle closest)
    {
        for (var i = 0; i < BvhLayout.MaxLeafTriangles; i++)
        {
            if (distancesSquared[i] < closest.DistanceSquared)
            {
                closest.DistanceSquared = distancesSquared[i];
                closest.FaceIndex = leaf.FaceIndices[i];
            }
        }
    }

    private TriangleX4 GatherTriangles(BvhLeaf leaf)
    {
        var positions = _mesh.Positions.AsSpan();
        return new(
            VectorX4.Gather(positions, leaf.IndicesA),
            VectorX4.Gather(positions, leaf.IndicesB),
            VectorX4.Gather(positions, leaf.IndicesC));
    }

    private static double PowerOfTwoScale(double halfSize) =>
        halfSize > 0 && double.IsFinite(halfSize) ? Math.ScaleB(1, -Math.Clamp(Math.ILogB(halfSize), -400, 400)) : 1;

    private int SubtreeHeight(BvhChild node)
    {
        var maxChildHeight = 0;
        foreach (var child in Children(node))
        {
            maxChildHeight = child.IsNode ? Math.Max(maxChildHeight, SubtreeHeight(child)) : maxChildHeight;
        }

        return maxChildHeight + 1;
    }
}
