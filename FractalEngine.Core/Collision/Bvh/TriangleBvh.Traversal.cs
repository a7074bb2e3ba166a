using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Core.Collision.Bvh;

/// <content>The search near the mesh, in single precision.</content>
internal sealed partial class TriangleBvh
{
    [SkipLocalsInit]
    private void TraverseNear(
        in Vector position, in Vector localPosition, ref ClosestTriangle closest, double inverseBoundFactor, bool mayDefer)
    {
        var cutoff = FloatCutoff.Create(localPosition.MaxAbsComponent(), _longestEdge, _magnitude * BoundCutoff.KernelError);
        var bestSquared = RoundUp(closest.DistanceSquared * _scale * _scale);
        var cutoffSquared = cutoff.For(bestSquared);
        var boxFactor = (float)inverseBoundFactor;
        var boxCutoffSquared = boxFactor * cutoffSquared;
        var px = Vector256.Create((float)localPosition.X);
        var py = Vector256.Create((float)localPosition.Y);
        var pz = Vector256.Create((float)localPosition.Z);
        // The bits of the bound above those of the child: bounds are not negative, so the entries sort like the bounds.
        Span<ulong> stack = stackalloc ulong[_stackSize];
        Span<float> distances = stackalloc float[BvhLayout.MaxLeafTriangles];
        var candidates = new CandidateList(stackalloc ulong[CandidateList.Capacity]);
        ref var stackBase = ref MemoryMarshal.GetReference(stack);
        ref var nodes = ref Node(BvhChild.Root);
        ref var frames = ref MemoryMarshal.GetArrayDataReference(_frames);
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
            else if (_precomputed is not null)
            {
                testedFaces += current.TriangleCount;
                var distanceSquared = closest.DistanceSquared;
                _precomputed.Test(_precomputed.QuadOf(current), in position, ref closest);
                if (closest.DistanceSquared < distanceSquared)
                {
                    cutoffSquared = cutoff.For(RoundUp(closest.DistanceSquared * _scale * _scale));
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
                            Decide(in candidates, in position, ref closest);
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
            closest.FaceIndex = _faces[candidates[0]];
            closest.DistanceSquared = double.NaN;
        }
        else if (candidates.Count > 0)
        {
            Decide(in candidates, in position, ref closest);
        }
    }

    /// <summary>The nearest float that is not smaller; infinite where there is none.</summary>
    private static float RoundUp(double value) => MathF.BitIncrement((float)value);
}
