using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>
/// A bounding volume hierarchy over the triangles of a mesh, with eight children a node and up to eight triangles a leaf. Exact: the
/// distance it finds is, to the last bit, the smallest that <see cref="TriangleKernel"/> gives for any triangle. Of equally close triangles
/// the first in the mesh is found.
/// </summary>
/// <remarks>
/// Boxes and triangles are floats relative to the mesh's centre and size. The search is in single precision near the mesh. It keeps every
/// triangle that rounding might hide as the closest (<see cref="FloatCutoff"/>), and decides between them in double precision at the end.
/// Positions far away, where floats can't tell triangles apart, are searched in double precision.
/// <para>
/// Small meshes have leaves of up to four triangles, which are precomputed and tested in double precision. The smallest have no boxes. Nor
/// have meshes whose size or place is beyond the range in which the kernel's rounding is known: every face is tested there.
/// </para>
/// </remarks>
internal sealed partial class TriangleBvh
{
    // Up to so many triangles are kept precomputed, 136 bytes for each.
    private const int MaxPrecomputedTriangles = 64;

    // Up to so many triangles are all tested, since boxes would save nothing.
    private const int MaxBruteForceTriangles = 16;

    // Beyond these, products of six coordinates come near the range of a double (TriangleKernel), where the error is not that of
    // BoundCutoff.
    private const double MaxSafeLength = 1e45;
    private const double MinSafeSize = 1e-45;
    private const double MaxSafePosition = 1e90;

    // In units of the mesh's half size. Here the rounding of a distance to single precision is up to 1e-3 of it: farther away, too many
    // triangles would have to be decided between.
    private const double FarThreshold = 256;

    // One hierarchy for all colliders and rays of a mesh, as long as the mesh is in use.
    private static readonly ConditionalWeakTable<Mesh, TriangleBvh> Shared = [];

    private readonly Mesh _mesh;
    private readonly Vector _origin;
    private readonly double _scale;
    private readonly double _magnitude;
    private readonly Vector256<float>[] _nodes = [];
    private readonly nint _nodeOffset;
    private readonly float[] _frames = [];
    private readonly int[] _faces = [];
    private readonly double _longestEdge;
    private readonly PrecomputedTriangles? _precomputed;
    private readonly bool _isInSafeRange;
    private readonly int _stackSize;

    /// <summary>The hierarchy of a mesh, made by the first who asks.</summary>
    public static TriangleBvh For(Mesh mesh) => Shared.GetValue(mesh, static key => new(key));

    /// <summary>Builds the hierarchy of a mesh. Cost: O(n·log n) for n faces, on all cores where they are many.</summary>
    public TriangleBvh(Mesh mesh)
    {
        _mesh = mesh;
        if (mesh.FaceCount == 0)
        {
            return;
        }

        var box = mesh.UsedBounds;
        _origin = box.Centre;
        _scale = PowerOfTwoScale(0.5 * box.Size.MaxAbsComponent());
        var maxCoordinate = QueryScale.Magnitude(mesh);
        _magnitude = (2 * maxCoordinate * _scale) + FarThreshold;
        _isInSafeRange = maxCoordinate < MaxSafeLength && IsSafeSize(box.Size.MaxAbsComponent());
        if (mesh.FaceCount <= MaxBruteForceTriangles || !_isInSafeRange)
        {
            _faces = [.. Enumerable.Range(0, mesh.FaceCount)];
            _precomputed = mesh.FaceCount <= MaxPrecomputedTriangles ? new(mesh, _faces, QuadCounts(mesh.FaceCount)) : null;
            return;
        }

        var isSmall = mesh.FaceCount <= MaxPrecomputedTriangles;
        var layout = TriangleBvhBuilder.Build(mesh, _origin, _scale, isSmall ? VectorX4.Count : BvhLayout.MaxLeafTriangles);
        (_nodes, _nodeOffset) = layout.CreateNodes();
        _frames = isSmall ? [] : layout.Frames;
        _faces = layout.Faces;
        _longestEdge = layout.LongestEdge;
        _precomputed = isSmall ? new(mesh, _faces, layout.LeafCounts()) : null;
        // A node on the stack is replaced by up to eight.
        _stackSize = ((BvhLayout.BranchingFactor - 1) * SubtreeHeight(BvhChild.Root)) + 1 + ChildStack.Slack;
    }

    /// <summary>Number of triangles in the mesh.</summary>
    public int FaceCount => _mesh.FaceCount;

    /// <summary>Number of bytes kept beside the mesh.</summary>
    public long StorageBytes =>
        (_nodes.Length * 32L) + (_frames.Length * 4L) + (_faces.Length * 4L) + (_precomputed?.StorageBytes ?? 0);

    /// <summary>Finds the closest triangle, if it is closer than the limit. Of equally close ones, the first face wins.</summary>
    /// <param name="position">In the mesh's frame, finite.</param>
    /// <param name="closest">The limit; receives the closest triangle and the cost.</param>
    /// <param name="boundFactor">Squared bounds are multiplied by this before they are compared: (1 + ε)², 1 for exact answers.</param>
    /// <param name="mayDefer">
    /// True to accept a face whose distance is not computed: then the squared distance is NaN, and the face may be beyond the limit.
    /// </param>
    public void FindClosest(in Vector position, ref ClosestTriangle closest, double boundFactor, bool mayDefer = false)
    {
        if (_mesh.FaceCount <= MaxBruteForceTriangles || !_isInSafeRange || !(position.MaxAbsComponent() < MaxSafePosition))
        {
            TestAllTriangles(in position, ref closest);
            return;
        }

        var localPosition = (position - _origin) * _scale;
        // The products stay finite for any factor.
        var inverseBoundFactor = 1 / Math.Min(boundFactor, 1e30);
        if (localPosition.MaxAbsComponent() < FarThreshold)
        {
            TraverseNear(in position, in localPosition, ref closest, inverseBoundFactor, mayDefer);
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
        if (_precomputed is not null)
        {
            for (var quad = 0; quad < _precomputed.QuadCount; quad++)
            {
                _precomputed.Test(quad, in position, ref closest);
            }
        }
        else
        {
            TestFaces(_faces, in position, ref closest);
        }

        closest.FaceTests += _mesh.FaceCount;
    }

    private static int[] QuadCounts(int faces) =>
        [.. Enumerable.Range(0, VectorX4.PaddedCount(faces) / VectorX4.Count).Select(quad => Math.Min(VectorX4.Count, faces - (4 * quad)))];

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private ref Vector256<float> Node(BvhChild node) => ref Unsafe.Add(
        ref Unsafe.AddByteOffset(ref MemoryMarshal.GetArrayDataReference(_nodes), _nodeOffset),
        (nint)node.NodeIndex * BvhLayout.VectorsPerNode);

    private ReadOnlySpan<Vector256<float>> NodeBounds(BvhChild node) => MemoryMarshal.CreateReadOnlySpan(ref Node(node), 6);

    private ReadOnlySpan<BvhChild> Children(BvhChild node) => MemoryMarshal.CreateReadOnlySpan(
        ref Unsafe.As<Vector256<float>, BvhChild>(ref Unsafe.Add(ref Node(node), 6)), BvhLayout.BranchingFactor);

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
