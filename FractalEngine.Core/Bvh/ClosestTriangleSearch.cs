using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Core.Bvh;

/// <summary>
/// Finds the triangle of a mesh that is closest to a position. Exact: the distance is, to the last bit, the smallest that
/// <see cref="TriangleKernel"/> gives for any triangle. Of equally close triangles the first in the mesh is found.
/// </summary>
/// <remarks>
/// The search is in single precision near the mesh. It keeps every triangle that rounding might hide as the closest
/// (<see cref="FloatCutoff"/>), and decides between them in double precision at the end. Positions far away, where floats can't tell
/// triangles apart, are searched in double precision, which is slower.
/// </remarks>
internal static class ClosestTriangleSearch
{
    // Beyond this, products of six coordinates come near the range of a double (TriangleKernel), where the error is not that of
    // BoundCutoff.
    private const double MaxSafePosition = 1e90;

    private const double FarSlack = 1.0 / (1L << 40);

    /// <summary>Finds the closest triangle, if it is closer than the limit. Of equally close ones, the first face wins.</summary>
    /// <param name="bvh">The triangles.</param>
    /// <param name="position">In the mesh's frame, finite.</param>
    /// <param name="closest">The limit; receives the closest triangle and the cost.</param>
    /// <param name="boundFactor">Squared bounds are multiplied by this before they are compared: (1 + ε)², 1 for exact answers.</param>
    /// <param name="mayDefer">
    /// True to accept a face whose distance is not computed: then the squared distance is NaN, and the face may be beyond the limit.
    /// </param>
    public static void Find(
        TriangleBvh bvh, in Vector position, ref ClosestTriangle closest, double boundFactor, bool mayDefer = false)
    {
        if (!bvh.HasNodes || !(position.MaxAbsComponent() < MaxSafePosition))
        {
            TestAll(bvh, in position, ref closest);
            return;
        }

        var localPosition = (position - bvh.Origin) * bvh.Scale;
        // The products stay finite for any factor.
        var inverseBoundFactor = 1 / Math.Min(boundFactor, 1e30);
        if (localPosition.MaxAbsComponent() < TriangleBvh.FarThreshold)
        {
            TraverseNear(bvh, in position, in localPosition, ref closest, inverseBoundFactor, mayDefer);
        }
        else
        {
            TraverseFar(bvh, BvhChild.Root, in position, in localPosition, ref closest, inverseBoundFactor);
        }
    }

    /// <summary>Tests every triangle, whatever the bounds are.</summary>
    /// <param name="bvh">The triangles.</param>
    /// <param name="position">In the mesh's frame, finite.</param>
    /// <param name="closest">The limit; receives the closest triangle and the cost.</param>
    public static void TestAll(TriangleBvh bvh, in Vector position, ref ClosestTriangle closest)
    {
        if (bvh.Precomputed is not null)
        {
            for (var quad = 0; quad < bvh.Precomputed.QuadCount; quad++)
            {
                bvh.Precomputed.Test(quad, in position, ref closest);
            }
        }
        else
        {
            TestFaces(bvh.Mesh, bvh.AllFaces, in position, ref closest);
        }

        closest.FaceTests += bvh.AllFaces.Length;
    }

    [SkipLocalsInit]
    private static void TraverseNear(
        TriangleBvh bvh, in Vector position, in Vector localPosition, ref ClosestTriangle closest, double inverseBoundFactor,
        bool mayDefer)
    {
        var cutoff = FloatCutoff.Create(localPosition.MaxAbsComponent(), bvh.LongestEdge, bvh.Magnitude * BoundCutoff.KernelError);
        var bestSquared = RoundUp(closest.DistanceSquared * bvh.Scale * bvh.Scale);
        var cutoffSquared = cutoff.For(bestSquared);
        var boxFactor = (float)inverseBoundFactor;
        var boxCutoffSquared = boxFactor * cutoffSquared;
        var px = Vector256.Create((float)localPosition.X);
        var py = Vector256.Create((float)localPosition.Y);
        var pz = Vector256.Create((float)localPosition.Z);
        // The bits of the bound above those of the child: bounds are not negative, so the entries sort like the bounds.
        Span<ulong> stack = stackalloc ulong[bvh.StackSize];
        Span<float> distances = stackalloc float[BvhLayout.MaxLeafTriangles];
        var candidates = new CandidateList(stackalloc ulong[CandidateList.Capacity]);
        ref var stackBase = ref MemoryMarshal.GetReference(stack);
        ref var nodes = ref bvh.Node(BvhChild.Root);
        ref var frames = ref MemoryMarshal.GetArrayDataReference(bvh.Frames);
        nint stackCount = 0;
        var visitedNodes = 0;
        var testedFaces = 0;
        var current = BvhChild.Root;
        while (true)
        {
            if (current.IsNode)
            {
                visitedNodes++;
                ref var node = ref Unsafe.Add(ref nodes, (nint)current.NodeIndex * BvhLayout.VectorsPerNode);
                var zero = Vector256<float>.Zero;
                var x = Vector256.MaxNative(Vector256.MaxNative(node - px, px - Unsafe.Add(ref node, 3)), zero);
                var y = Vector256.MaxNative(Vector256.MaxNative(Unsafe.Add(ref node, 1) - py, py - Unsafe.Add(ref node, 4)), zero);
                var z = Vector256.MaxNative(Vector256.MaxNative(Unsafe.Add(ref node, 2) - pz, pz - Unsafe.Add(ref node, 5)), zero);
                var bounds = (x * x) + (y * y) + (z * z);
                var hits = Vector256.LessThan(bounds, Vector256.Create(boxCutoffSquared));
                var hitMask = hits.ExtractMostSignificantBits();
                if (BitOperations.IsPow2(hitMask))
                {
                    current = BvhChild.FromBits(Unsafe.Add(
                        ref Unsafe.As<Vector256<float>, uint>(ref Unsafe.Add(ref node, 6)), BitOperations.TrailingZeroCount(hitMask)));
                    continue;
                }

                var hitCount = BitOperations.PopCount(hitMask);
                if (hitCount != 0)
                {
                    ChildStack.Push(bounds, hits, Unsafe.Add(ref node, 6).AsUInt32(), ref Unsafe.Add(ref stackBase, stackCount));
                    stackCount += hitCount - 1;
                    current = BvhChild.FromBits((uint)Unsafe.Add(ref stackBase, stackCount));
                    continue;
                }
            }
            else if (bvh.Precomputed is not null)
            {
                testedFaces += current.TriangleCount;
                var distanceSquared = closest.DistanceSquared;
                bvh.Precomputed.Test(bvh.Precomputed.QuadOf(current), in position, ref closest);
                if (closest.DistanceSquared < distanceSquared)
                {
                    cutoffSquared = cutoff.For(RoundUp(closest.DistanceSquared * bvh.Scale * bvh.Scale));
                    boxCutoffSquared = boxFactor * cutoffSquared;
                }
            }
            else
            {
                var count = current.TriangleCount;
                testedFaces += count;
                var distancesSquared = TriangleFrames.DistancesSquared(
                    ref Unsafe.Add(ref frames, (nint)TriangleFrames.Rows * current.FirstTriangle), count, px, py, pz);
                var hits = Vector256.LessThan(distancesSquared, Vector256.Create(cutoffSquared)).ExtractMostSignificantBits()
                    & ((1u << count) - 1);
                if (hits != 0)
                {
                    if (candidates.IsFull)
                    {
                        candidates.RemoveFrom(cutoffSquared);
                        if (candidates.IsFull)
                        {
                            Decide(bvh, in candidates, in position, ref closest);
                            candidates.Clear();
                        }
                    }

                    distancesSquared.CopyTo(distances);
                    do
                    {
                        var lane = BitOperations.TrailingZeroCount(hits);
                        hits &= hits - 1;
                        var distanceSquared = distances[lane];
                        if (!(distanceSquared < cutoffSquared))
                        {
                            continue;
                        }

                        if (distanceSquared < bestSquared)
                        {
                            cutoffSquared = cutoff.For(distanceSquared);
                            boxCutoffSquared = boxFactor * cutoffSquared;
                            if (bestSquared >= cutoffSquared)
                            {
                                candidates.Clear();
                            }

                            bestSquared = distanceSquared;
                        }

                        candidates.Add(distanceSquared, current.FirstTriangle + lane);
                    }
                    while (hits != 0);
                }
            }

            do
            {
                if (stackCount == 0)
                {
                    goto Done;
                }

                stackCount--;
            }
            while (!(BitConverter.UInt32BitsToSingle((uint)(Unsafe.Add(ref stackBase, stackCount) >> 32)) < boxCutoffSquared));
            current = BvhChild.FromBits((uint)Unsafe.Add(ref stackBase, stackCount));
        }

    Done:
        closest.BoundTests += (long)visitedNodes * BvhLayout.BranchingFactor;
        closest.FaceTests += testedFaces;
        candidates.RemoveFrom(cutoffSquared);
        if (mayDefer && candidates.Count == 1 && closest.FaceIndex < 0)
        {
            closest.FaceIndex = bvh.AllFaces[candidates[0]];
            closest.DistanceSquared = double.NaN;
        }
        else if (candidates.Count > 0)
        {
            Decide(bvh, in candidates, in position, ref closest);
        }
    }

    /// <summary>Searches in double precision, which is slower, for positions far from the mesh.</summary>
    private static void TraverseFar(
        TriangleBvh bvh, BvhChild node, in Vector position, in Vector localPosition, ref ClosestTriangle closest,
        double inverseBoundFactor)
    {
        var cutoff = BoundCutoff.Create(bvh.Scale, inverseBoundFactor, FarSlack, bvh.Magnitude + localPosition.MaxAbsComponent());
        Span<double> bounds = stackalloc double[BvhLayout.BranchingFactor];
        for (var child = 0; child < bounds.Length; child++)
        {
            bounds[child] = bvh.LocalBox(node, child).DistanceSquared(localPosition);
        }

        closest.BoundTests += BvhLayout.BranchingFactor;
        while (true)
        {
            var closestChild = 0;
            for (var child = 1; child < bounds.Length; child++)
            {
                closestChild = bounds[child] < bounds[closestChild] ? child : closestChild;
            }

            if (!(bounds[closestChild] < cutoff.For(closest.DistanceSquared)))
            {
                return;
            }

            bounds[closestChild] = double.PositiveInfinity;
            var next = bvh.Children(node)[closestChild];
            if (next.IsNode)
            {
                TraverseFar(bvh, next, in position, in localPosition, ref closest, inverseBoundFactor);
            }
            else
            {
                TestLeaf(bvh, next, in position, ref closest);
            }
        }
    }

    private static void TestLeaf(TriangleBvh bvh, BvhChild leaf, in Vector position, ref ClosestTriangle closest)
    {
        closest.FaceTests += leaf.TriangleCount;
        if (bvh.Precomputed is not null)
        {
            bvh.Precomputed.Test(bvh.Precomputed.QuadOf(leaf), in position, ref closest);
        }
        else
        {
            TestFaces(bvh.Mesh, bvh.Faces(leaf), in position, ref closest);
        }
    }

    /// <summary>Tests some triangles in double precision, four at a time.</summary>
    private static void TestFaces(Mesh mesh, ReadOnlySpan<int> faces, in Vector position, ref ClosestTriangle closest)
    {
        for (; faces.Length > 0; faces = faces[Math.Min(VectorX4.Count, faces.Length)..])
        {
            var quad = faces[..Math.Min(VectorX4.Count, faces.Length)];
            closest.Update(TriangleX4.DistancesSquared(mesh, quad, in position), quad);
        }
    }

    /// <summary>Finds the closest of some candidates in double precision.</summary>
    private static void Decide(TriangleBvh bvh, ref readonly CandidateList candidates, in Vector position, ref ClosestTriangle closest)
    {
        Span<int> faces = stackalloc int[CandidateList.Capacity];
        for (var i = 0; i < candidates.Count; i++)
        {
            faces[i] = bvh.AllFaces[candidates[i]];
        }

        TestFaces(bvh.Mesh, faces[..candidates.Count], in position, ref closest);
    }

    /// <summary>The nearest float that is not smaller; infinite where there is none.</summary>
    private static float RoundUp(double value) => MathF.BitIncrement((float)value);
}
