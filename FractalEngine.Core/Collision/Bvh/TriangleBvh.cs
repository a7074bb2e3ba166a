using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>
/// The faces of a mesh, arranged for finding the nearest one: a tree of boxes, eight children a node, up to four faces a leaf. Exact;
/// the distance that it finds is to the last bit the smallest that <see cref="TriangleKernel"/> gives for any of the faces.
/// </summary>
/// <remarks>
/// Boxes are floats relative to the mesh's centre and size, rounded outwards, and a position becomes an interval of floats that holds
/// it, so that a box's distance comes out too large by no more than the rounding of four sums and three products. The limit that it is
/// compared with is raised by more than that and by more than the rounding of the kernel (see <see cref="CutoffCoefficients"/>): no box is
/// passed over whose faces could be nearer. Positions so far away that an interval of floats would hold all boxes are compared in double
/// precision.
/// <para>Faces are looked at in double precision, four at once, where the mesh has them; meshes of up to 64 faces keep what they can in
/// advance.</para>
/// </remarks>
internal sealed partial class TriangleBvh
{
    // Up to here faces are kept as quartets, 136 bytes each; up to the second number they are all looked at without asking for boxes.
    private const int MaxPrecomputedFaces = 64;
    private const int MaxBruteForceFaces = 8;

    // In units of the mesh's half size. Here the rounding of a position to single precision is 4e-6 of it, less than most faces.
    private const double FarThreshold = 64;

    private const double Rounding = 1.0 / (1L << 46);
    private const double NearSlack = 1.0 / (1L << 20);
    private const double FarSlack = 1.0 / (1L << 40);

    private readonly Mesh _mesh;
    private readonly Vector _origin;
    private readonly double _scale;
    private readonly double _magnitude;
    private readonly Vector256<float>[] _nodeBounds = [];
    private readonly int[] _children = [];
    private readonly BvhLeaf[] _leaves = [];
    private readonly TriangleX4[] _triangles = [];
    private readonly int _stackSize;

    /// <summary>Arranges the faces of a mesh. Cost: O(n·log n), on all cores where there are many faces.</summary>
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
        _triangles = mesh.FaceCount <= MaxPrecomputedFaces ? [.. layout.Leaves.Select(GatherTriangles)] : [];
        // A node on the stack gives way to up to eight.
        _stackSize = ((TriangleBvhBuilder.BranchingFactor - 1) * SubtreeHeight(0)) + 1;
    }

    /// <summary>Of the mesh.</summary>
    public int FaceCount => _mesh.FaceCount;

    /// <summary>Bytes kept beside the mesh.</summary>
    public long StorageBytes =>
        (_nodeBounds.Length * 32L) + (_children.Length * 4L) + (_leaves.Length * 64L)
        + (_triangles.Length * (long)Unsafe.SizeOf<TriangleX4>());

    /// <summary>Looks for a face nearer than the nearest so far.</summary>
    /// <param name="position">In the mesh's frame.</param>
    /// <param name="closestDistanceSquared">Squared distance of the nearest so far, exclusive; lowered when a nearer face is found.</param>
    /// <param name="closestFace">Set when a nearer face is found.</param>
    /// <param name="boundFactor">Bounds are multiplied by this before they are compared: (1 + ε)², 1 for exact answers.</param>
    /// <param name="faceTests">Increased by the faces looked at.</param>
    /// <param name="boundTests">Increased by the bounds looked at.</param>
    public void FindClosest(
        Vector position, ref double closestDistanceSquared, ref int closestFace, double boundFactor, ref long faceTests,
        ref long boundTests)
    {
        if (_mesh.FaceCount <= MaxBruteForceFaces)
        {
            TestAllTriangles(position, ref closestDistanceSquared, ref closestFace, ref faceTests);
            return;
        }

        var localPosition = (position - _origin) * _scale;
        var state = new TraversalState(position, localPosition, closestDistanceSquared, closestFace);
        // Written so that the products stay finite for any factor.
        var inverseBoundFactor = 1 / Math.Min(boundFactor, 1e30);
        if (localPosition.MaxAbsComponent() < FarThreshold)
        {
            TraverseNear(ref state, inverseBoundFactor);
        }
        else
        {
            TraverseFar(ref state, 0, inverseBoundFactor);
        }

        (closestDistanceSquared, closestFace) = (state.ClosestDistanceSquared, state.ClosestFace);
        faceTests += state.FaceTests;
        boundTests += state.BoundTests;
    }

    /// <summary>Looks at every face, whatever the bounds say.</summary>
    /// <param name="position">In the mesh's frame.</param>
    /// <param name="closestDistanceSquared">As in <see cref="FindClosest"/>.</param>
    /// <param name="closestFace">As in <see cref="FindClosest"/>.</param>
    /// <param name="faceTests">Increased by the faces of the mesh.</param>
    public void TestAllTriangles(Vector position, ref double closestDistanceSquared, ref int closestFace, ref long faceTests)
    {
        for (var leaf = 0; leaf < _leaves.Length; leaf++)
        {
            TryUpdateClosest(DistancesSquared(leaf, in position, closestDistanceSquared), leaf, ref closestDistanceSquared,
                ref closestFace);
        }

        faceTests += _mesh.FaceCount;
    }

    /// <summary>A search as it goes on.</summary>
    private ref struct TraversalState(Vector position, Vector localPosition, double closestDistanceSquared, int closestFace)
    {
        public readonly Vector Position = position;
        public readonly Vector LocalPosition = localPosition;
        public double ClosestDistanceSquared = closestDistanceSquared;
        public int ClosestFace = closestFace;
        public long FaceTests;
        public long BoundTests;
    }

    /// <summary>The factor and the summand that make of a squared distance the limit for bounds.</summary>
    /// <param name="inverseBoundFactor">1 / (1 + ε)².</param>
    /// <param name="slack">More than the relative error of a squared bound, twice.</param>
    /// <param name="magnitude">Of coordinates, in the boxes' units.</param>
    /// <remarks>
    /// With rounding, the kernel may find a face nearer than it is by δ = 2⁻⁴⁶·magnitude, some hundred last places of its coordinates; the
    /// face matters if its bound is below (d + δ)² ≤ (1 + s)·d² + (1 + 1/s)·δ², whatever the s.
    /// </remarks>
    private (double Factor, double Summand) CutoffCoefficients(double inverseBoundFactor, double slack, double magnitude) =>
        (magnitude * Rounding) switch
    {
        var rounding => ((1 + (4 * slack)) * _scale * _scale * inverseBoundFactor, (1 + (1 / slack)) * rounding * rounding),
    };

    private void TraverseNear(ref TraversalState state, double inverseBoundFactor)
    {
        var (factor, summand) = CutoffCoefficients(inverseBoundFactor, NearSlack, _magnitude);
        var cutoff = (float)((state.ClosestDistanceSquared * factor) + summand);
        var localPosition = ToSingle(Vector256.Create(state.LocalPosition.X, state.LocalPosition.Y, state.LocalPosition.Z, 0));
        var (lower, upper) = (localPosition - UlpBound(localPosition), localPosition + UlpBound(localPosition));
        var (lowerX, lowerY, lowerZ) = (Vector256.Create(lower[0]), Vector256.Create(lower[1]), Vector256.Create(lower[2]));
        var (upperX, upperY, upperZ) = (Vector256.Create(upper[0]), Vector256.Create(upper[1]), Vector256.Create(upper[2]));
        // The bound's bits above the child's number: bounds are not negative, so the entries sort like the bounds.
        Span<ulong> stack = stackalloc ulong[_stackSize];
        Span<uint> boundBits = stackalloc uint[TriangleBvhBuilder.BranchingFactor];
        var (stackCount, node, visitedNodes) = (0, 0, 0);
        while (true)
        {
            if (node >= 0)
            {
                visitedNodes++;
                var boxes = _nodeBounds.AsSpan(node * BvhLayout.VectorsPerNode, BvhLayout.VectorsPerNode);
                var zero = Vector256<float>.Zero;
                var x = Vector256.MaxNative(Vector256.MaxNative(boxes[0] - upperX, lowerX - boxes[3]), zero);
                var y = Vector256.MaxNative(Vector256.MaxNative(boxes[1] - upperY, lowerY - boxes[4]), zero);
                var z = Vector256.MaxNative(Vector256.MaxNative(boxes[2] - upperZ, lowerZ - boxes[5]), zero);
                var bounds = (x * x) + (y * y) + (z * z);
                var hitMask = Vector256.LessThan(bounds, Vector256.Create(cutoff)).ExtractMostSignificantBits();
                if (hitMask != 0)
                {
                    bounds.AsUInt32().CopyTo(boundBits);
                    ref var child = ref _children[node * TriangleBvhBuilder.BranchingFactor];
                    var stackBottom = stackCount;
                    do
                    {
                        var lane = System.Numerics.BitOperations.TrailingZeroCount(hitMask);
                        hitMask &= hitMask - 1;
                        var entry = ((ulong)boundBits[lane] << 32) | (uint)Unsafe.Add(ref child, lane);
                        var slot = stackCount++;
                        // Nearest on top.
                        for (; slot > stackBottom && stack[slot - 1] < entry; slot--)
                        {
                            stack[slot] = stack[slot - 1];
                        }

                        stack[slot] = entry;
                    }
                    while (hitMask != 0);
                }
            }
            else
            {
                if (TestLeaf(ref state, node))
                {
                    cutoff = (float)((state.ClosestDistanceSquared * factor) + summand);
                }
            }

            do
            {
                if (stackCount == 0 || state.ClosestDistanceSquared == 0)
                {
                    state.BoundTests += visitedNodes * TriangleBvhBuilder.BranchingFactor;
                    return;
                }
            }
            while (!(BitConverter.UInt32BitsToSingle((uint)(stack[--stackCount] >> 32)) < cutoff));
            node = (int)(uint)stack[stackCount];
        }
    }

    /// <summary>The same in double precision, slower, for positions far from the mesh.</summary>
    private void TraverseFar(ref TraversalState state, int node, double inverseBoundFactor)
    {
        var (factor, summand) = CutoffCoefficients(inverseBoundFactor, FarSlack, _magnitude + state.LocalPosition.MaxAbsComponent());
        Span<double> bounds = stackalloc double[TriangleBvhBuilder.BranchingFactor];
        var boxes = MemoryMarshal.Cast<Vector256<float>,
            float>(_nodeBounds.AsSpan(node * BvhLayout.VectorsPerNode, BvhLayout.VectorsPerNode));
        for (var child = 0; child < bounds.Length; child++)
        {
            Vector minimum = new(boxes[child], boxes[8 + child], boxes[16 + child]),
                maximum = new(boxes[24 + child], boxes[32 + child], boxes[40 + child]);
            bounds[child] = Vector.Max(Vector.Max(minimum - state.LocalPosition, state.LocalPosition - maximum), Vector.Zero)
                .LengthSquared();
        }

        state.BoundTests += TriangleBvhBuilder.BranchingFactor;
        while (true)
        {
            var closestChild = 0;
            for (var child = 1; child < bounds.Length; child++)
            {
                closestChild = bounds[child] < bounds[closestChild] ? child : closestChild;
            }

            if (!(bounds[closestChild] < (state.ClosestDistanceSquared * factor) + summand) || state.ClosestDistanceSquared == 0)
            {
                return;
            }

            bounds[closestChild] = double.PositiveInfinity;
            var next = _children[(node * TriangleBvhBuilder.BranchingFactor) + closestChild];
            if (next >= 0)
            {
                TraverseFar(ref state, next, inverseBoundFactor);
            }
            else
            {
                TestLeaf(ref state, next);
            }
        }
    }

    private bool TestLeaf(ref TraversalState state, int childReference)
    {
        var encodedLeaf = (uint)~childReference;
        var leaf = (int)(encodedLeaf / TriangleBvhBuilder.MaxLeafTriangles);
        state.FaceTests += (encodedLeaf % TriangleBvhBuilder.MaxLeafTriangles) + 1;
        return TryUpdateClosest(DistancesSquared(leaf, in state.Position, state.ClosestDistanceSquared), leaf,
            ref state.ClosestDistanceSquared, ref state.ClosestFace);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private Vector256<double> DistancesSquared(int leaf, ref readonly Vector position, double closestDistanceSquared) =>
        _triangles.Length > 0
        ? TriangleX4.DistancesSquared(in _triangles[leaf], in position, closestDistanceSquared)
        : TriangleX4.DistancesSquared(in _leaves[leaf], _mesh.Positions.AsSpan(), in position);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private bool TryUpdateClosest(Vector256<double> distancesSquared, int leaf, ref double closestDistanceSquared, ref int closestFace)
    {
        if (!Vector256.LessThanAny(distancesSquared, Vector256.Create(closestDistanceSquared)))
        {
            return false;
        }

        SelectClosest(distancesSquared, in _leaves[leaf], ref closestDistanceSquared, ref closestFace);
        return true;
    }

    private static void SelectClosest(Vector256<double> distancesSquared, ref readonly BvhLeaf leaf, ref double closestDistanceSquared,
        ref int closestFace)
    {
        for (var i = 0; i < TriangleBvhBuilder.MaxLeafTriangles; i++)
        {
            if (distancesSquared[i] < closestDistanceSquared)
            {
                (closestDistanceSquared, closestFace) = (distancesSquared[i], leaf.FaceIndices[i]);
            }
        }
    }

    private TriangleX4 GatherTriangles(BvhLeaf leaf) => _mesh.Positions.AsSpan() switch
    {
        var positions => new(
            VectorX4.Gather(positions, leaf.IndicesA), VectorX4.Gather(positions, leaf.IndicesB),
            VectorX4.Gather(positions, leaf.IndicesC)),
    };

    /// <summary>Rounded to single precision, to nearest.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector128<float> ToSingle(Vector256<double> v) => Vector128.Narrow(v.GetLower(), v.GetUpper());

    /// <summary>At least the distance to the next float, in either direction.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector128<float> UlpBound(Vector128<float> v) => (Vector128.Abs(v) * 1.1920929e-7f) + Vector128.Create(1.1754944e-38f);

    private static double PowerOfTwoScale(double halfSize) =>
        halfSize > 0 && double.IsFinite(halfSize) ? Math.ScaleB(1, -Math.Clamp(Math.ILogB(halfSize), -400, 400)) : 1;

    private int SubtreeHeight(int node)
    {
        var maxChildHeight = 0;
        for (var slot = node * TriangleBvhBuilder.BranchingFactor; slot < (node + 1) * TriangleBvhBuilder.BranchingFactor; slot++)
        {
            maxChildHeight = _children[slot] >= 0 ? Math.Max(maxChildHeight, SubtreeHeight(_children[slot])) : maxChildHeight;
        }

        return maxChildHeight + 1;
    }
}
