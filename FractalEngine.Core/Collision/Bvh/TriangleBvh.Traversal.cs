using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Core.Collision.Bvh;

/// <content>The searches in the mesh's own frame: in single precision near the mesh, in double precision far from it.</content>
internal sealed partial class TriangleBvh
{
    private const double NearSlack = 1.0 / (1L << 20);
    private const double FarSlack = 1.0 / (1L << 40);

    private void TraverseNear(in Vector position, in Vector localPosition, ref ClosestTriangle closest, double inverseBoundFactor)
    {
        var cutoff = BoundCutoff.Create(_scale, inverseBoundFactor, NearSlack, _magnitude);
        var cutoffSquared = (float)cutoff.For(closest.DistanceSquared);
        var simdPosition = Vector256.Create(localPosition.X, localPosition.Y, localPosition.Z, 0);
        var lower = FloatRounding.Down(simdPosition);
        var upper = FloatRounding.Up(simdPosition);
        var (lowerX, lowerY, lowerZ) = (Vector256.Create(lower[0]), Vector256.Create(lower[1]), Vector256.Create(lower[2]));
        var (upperX, upperY, upperZ) = (Vector256.Create(upper[0]), Vector256.Create(upper[1]), Vector256.Create(upper[2]));
        // The bits of the bound above those of the child: bounds are not negative, so the entries sort like the bounds.
        Span<ulong> stack = stackalloc ulong[_stackSize];
        Span<uint> boundBits = stackalloc uint[BvhLayout.BranchingFactor];
        var stackCount = 0;
        var visitedNodes = 0;
        var current = BvhChild.Root;
        while (true)
        {
            if (current.IsNode)
            {
                visitedNodes++;
                var boxes = NodeBounds(current);
                var zero = Vector256<float>.Zero;
                var x = Vector256.MaxNative(Vector256.MaxNative(boxes[0] - upperX, lowerX - boxes[3]), zero);
                var y = Vector256.MaxNative(Vector256.MaxNative(boxes[1] - upperY, lowerY - boxes[4]), zero);
                var z = Vector256.MaxNative(Vector256.MaxNative(boxes[2] - upperZ, lowerZ - boxes[5]), zero);
                var bounds = (x * x) + (y * y) + (z * z);
                var hitMask = Vector256.LessThan(bounds, Vector256.Create(cutoffSquared)).ExtractMostSignificantBits();
                if (hitMask != 0)
                {
                    bounds.AsUInt32().CopyTo(boundBits);
                    ref var children = ref _children[current.NodeIndex * BvhLayout.BranchingFactor];
                    var stackBottom = stackCount;
                    do
                    {
                        var lane = BitOperations.TrailingZeroCount(hitMask);
                        hitMask &= hitMask - 1;
                        var entry = ((ulong)boundBits[lane] << 32) | Unsafe.Add(ref children, lane).Bits;
                        var slot = stackCount++;
                        // The closest child comes to lie on top.
                        for (; slot > stackBottom && stack[slot - 1] < entry; slot--)
                        {
                            stack[slot] = stack[slot - 1];
                        }

                        stack[slot] = entry;
                    }
                    while (hitMask != 0);
                }
            }
            else if (TestLeaf(current, in position, ref closest))
            {
                cutoffSquared = (float)cutoff.For(closest.DistanceSquared);
            }

            do
            {
                if (stackCount == 0 || closest.DistanceSquared == 0)
                {
                    closest.BoundTests += visitedNodes * BvhLayout.BranchingFactor;
                    return;
                }
            }
            while (!(BitConverter.UInt32BitsToSingle((uint)(stack[--stackCount] >> 32)) < cutoffSquared));
            current = BvhChild.FromBits((uint)stack[stackCount]);
        }
    }

    /// <summary>Searches in double precision, which is slower, for positions far from the mesh.</summary>
    private void TraverseFar(
        BvhChild node, in Vector position, in Vector localPosition, ref ClosestTriangle closest, double inverseBoundFactor)
    {
        var cutoff = BoundCutoff.Create(_scale, inverseBoundFactor, FarSlack, _magnitude + localPosition.MaxAbsComponent());
        Span<double> bounds = stackalloc double[BvhLayout.BranchingFactor];
        var boxes = MemoryMarshal.Cast<Vector256<float>, float>(NodeBounds(node));
        for (var child = 0; child < bounds.Length; child++)
        {
            var minimum = new Vector(boxes[child], boxes[8 + child], boxes[16 + child]);
            var maximum = new Vector(boxes[24 + child], boxes[32 + child], boxes[40 + child]);
            bounds[child] = new BoundingBox(minimum, maximum).DistanceSquared(localPosition);
        }

        closest.BoundTests += BvhLayout.BranchingFactor;
        while (true)
        {
            var closestChild = 0;
            for (var child = 1; child < bounds.Length; child++)
            {
                closestChild = bounds[child] < bounds[closestChild] ? child : closestChild;
            }

            if (!(bounds[closestChild] < cutoff.For(closest.DistanceSquared)) || closest.DistanceSquared == 0)
            {
                return;
            }

            bounds[closestChild] = double.PositiveInfinity;
            var next = Children(node)[closestChild];
            if (next.IsNode)
            {
                TraverseFar(next, in position, in localPosition, ref closest, inverseBoundFactor);
            }
            else
            {
                TestLeaf(next, in position, ref closest);
            }
        }
    }
}
