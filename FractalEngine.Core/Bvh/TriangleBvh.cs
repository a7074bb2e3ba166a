using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Bvh;

/// <summary>
/// A bounding volume hierarchy over the triangles of a mesh, with eight children a node and up to eight triangles a leaf.
/// </summary>
/// <remarks>
/// Boxes and triangles are floats relative to the mesh's centre and size. Small meshes have leaves of up to four triangles, which are
/// precomputed and tested in double precision. The smallest have no boxes. Nor have meshes whose size or place is beyond the range in which
/// the kernel's rounding is known: every face is tested there.
/// </remarks>
internal sealed class TriangleBvh
{
    // Up to so many triangles are kept precomputed, 136 bytes for each.
    private const int MaxPrecomputedTriangles = 64;

    // Up to so many triangles are all tested, since boxes would save nothing.
    private const int MaxBruteForceTriangles = 16;

    // Beyond these, products of six coordinates come near the range of a double (TriangleKernel), where the error is not that of
    // BoundCutoff.
    private const double MaxSafeLength = 1e45;
    private const double MinSafeSize = 1e-45;

    /// <summary>Coordinates of positions from here on are far from the mesh, in the units of the hierarchy.</summary>
    /// <remarks>
    /// Here the rounding of a distance to single precision is up to 1e-3 of it: farther away, too many triangles would have to be decided
    /// between.
    /// </remarks>
    public const double FarThreshold = 256;

    // One hierarchy for all colliders and rays of a mesh, as long as the mesh is in use.
    private static readonly ConditionalWeakTable<Mesh, TriangleBvh> Shared = [];

    private readonly Vector256<float>[] _nodes = [];
    private readonly nint _nodeOffset;
    private readonly int[] _faces = [];
    private TriangleBvhRays? _rays;

    /// <summary>The hierarchy of a mesh, made by the first who asks.</summary>
    public static TriangleBvh For(Mesh mesh) => Shared.GetValue(mesh, static key => new(key));

    /// <summary>Builds the hierarchy of a mesh. Cost: O(n·log n) for n faces, on all cores where they are many.</summary>
    public TriangleBvh(Mesh mesh)
    {
        Mesh = mesh;
        if (mesh.FaceCount == 0)
        {
            return;
        }

        var box = mesh.UsedBounds;
        Origin = box.Centre;
        Scale = PowerOfTwoScale(0.5 * box.Size.MaxAbsComponent());
        var maxCoordinate = QueryScale.Magnitude(mesh);
        Magnitude = (2 * maxCoordinate * Scale) + FarThreshold;
        var isInSafeRange = maxCoordinate < MaxSafeLength && IsSafeSize(box.Size.MaxAbsComponent());
        if (mesh.FaceCount <= MaxBruteForceTriangles || !isInSafeRange)
        {
            _faces = [.. Enumerable.Range(0, mesh.FaceCount)];
            Precomputed = mesh.FaceCount <= MaxPrecomputedTriangles ? new(mesh, _faces, QuadCounts(mesh.FaceCount)) : null;
            return;
        }

        var isSmall = mesh.FaceCount <= MaxPrecomputedTriangles;
        var layout = TriangleBvhBuilder.Build(mesh, Origin, Scale, isSmall ? VectorX4.Count : BvhLayout.MaxLeafTriangles);
        (_nodes, _nodeOffset) = layout.CreateNodes();
        Frames = isSmall ? [] : layout.Frames;
        _faces = layout.Faces;
        LongestEdge = layout.LongestEdge;
        Precomputed = isSmall ? new(mesh, _faces, layout.LeafCounts()) : null;
        // A node on the stack is replaced by up to eight.
        StackSize = ((BvhLayout.BranchingFactor - 1) * SubtreeHeight(BvhChild.Root)) + 1 + ChildStack.Slack;
    }

    /// <summary>The mesh whose triangles the hierarchy holds.</summary>
    public Mesh Mesh { get; }

    /// <summary>The origin of the hierarchy's coordinates, in the frame of the mesh.</summary>
    public Vector Origin { get; }

    /// <summary>Coordinates of the hierarchy divided by those of the mesh: a power of two.</summary>
    public double Scale { get; }

    /// <summary>
    /// Upper bound of the largest coordinates of the mesh and of a position near it together: from the origin of the mesh's frame, in the
    /// units of the hierarchy.
    /// </summary>
    public double Magnitude { get; }

    /// <summary>Length of the longest edge in the units of the hierarchy.</summary>
    public double LongestEdge { get; }

    /// <summary>Number of entries of a stack that any traversal fits in.</summary>
    public int StackSize { get; }

    /// <summary>The rows of the leaves' triangles, see <see cref="TriangleFrames"/>; none where they are precomputed.</summary>
    public float[] Frames { get; } = [];

    /// <summary>The triangles of a small mesh; null for others.</summary>
    public PrecomputedTriangles? Precomputed { get; }

    /// <summary>The search along rays, made by the first who asks.</summary>
    public TriangleBvhRays Rays => _rays ??= new(this);

    /// <summary>False where all triangles are tested without boxes: then <see cref="AllFaces"/> is the only leaf.</summary>
    public bool HasNodes => _nodes.Length > 0;

    /// <summary>True where leaves are searched in single precision, as in all but small meshes.</summary>
    public bool HasFloatLeaves => Frames.Length > 0;

    /// <summary>The face indices of all triangles, in the order of the leaves.</summary>
    public ReadOnlySpan<int> AllFaces => _faces;

    /// <summary>Number of bytes kept beside the mesh.</summary>
    public long StorageBytes =>
        (_nodes.Length * 32L) + (Frames.Length * 4L) + (_faces.Length * 4L) + (Precomputed?.StorageBytes ?? 0);

    /// <summary>The first of the vectors of a node, see <see cref="BvhLayout.VectorsPerNode"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public ref Vector256<float> Node(BvhChild node) => ref Unsafe.Add(
        ref Unsafe.AddByteOffset(ref MemoryMarshal.GetArrayDataReference(_nodes), _nodeOffset),
        (nint)node.NodeIndex * BvhLayout.VectorsPerNode);

    /// <summary>A row for each of minimum x, y, z and maximum x, y, z of a node's children, with a lane for each of them.</summary>
    public ReadOnlySpan<Vector256<float>> NodeBounds(BvhChild node) => MemoryMarshal.CreateReadOnlySpan(ref Node(node), 6);

    /// <summary>The children of a node, absent ones among them.</summary>
    public ReadOnlySpan<BvhChild> Children(BvhChild node) => MemoryMarshal.CreateReadOnlySpan(
        ref Unsafe.As<Vector256<float>, BvhChild>(ref Unsafe.Add(ref Node(node), 6)), BvhLayout.BranchingFactor);

    /// <summary>The face indices of a leaf's triangles.</summary>
    public ReadOnlySpan<int> Faces(BvhChild leaf) => _faces.AsSpan(leaf.FirstTriangle, leaf.TriangleCount);

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
        box = new(Origin + (localBox.Minimum / Scale), Origin + (localBox.Maximum / Scale));
        return true;
    }

    /// <summary>The box of a node's child in the units of the hierarchy.</summary>
    public BoundingBox LocalBox(BvhChild node, int child)
    {
        var rows = MemoryMarshal.Cast<Vector256<float>, float>(NodeBounds(node));
        double Row(ReadOnlySpan<float> values, int row) => values[(row * BvhLayout.BranchingFactor) + child];
        return new(new(Row(rows, 0), Row(rows, 1), Row(rows, 2)), new(Row(rows, 3), Row(rows, 4), Row(rows, 5)));
    }

    private static int[] QuadCounts(int faces) =>
        [.. Enumerable.Range(0, VectorX4.PaddedCount(faces) / VectorX4.Count).Select(quad => Math.Min(VectorX4.Count, faces - (4 * quad)))];

    private static double PowerOfTwoScale(double halfSize) =>
        halfSize > 0 && double.IsFinite(halfSize) ? Math.ScaleB(1, -Math.Clamp(Math.ILogB(halfSize), -400, 400)) : 1;

    private static bool IsSafeSize(double size) => size is 0 or > MinSafeSize;

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
