using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh.Boxes;

namespace FractalEngine.Core.Bvh;

/// <summary>Sorts the children of a node for the stack of a search.</summary>
/// <remarks>
/// An entry has the bits of a squared bound above those of a <see cref="BvhChild"/>. Bounds are not negative, so entries sort like them.
/// The lane of the child replaces the last three bits of the bound: no two entries are equal, and no bound becomes larger by more than the
/// margin of <see cref="FloatCutoff"/> allows.
/// </remarks>
internal static class ChildStack
{
    /// <summary>Entries that may be overwritten above those that are pushed.</summary>
    public const int Slack = BvhLayout.BranchingFactor;

    /// <summary>Writes the children that are hit to the stack, the closest on top.</summary>
    /// <param name="bounds">Squared bounds of a node's children.</param>
    /// <param name="hits">All bits set in the lanes of children that are hit.</param>
    /// <param name="children">References to the children.</param>
    /// <param name="top">The first free entry of the stack, with room for eight.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Push(Vector256<float> bounds, Vector256<float> hits, Vector256<uint> children, ref ulong top)
    {
        var laneIndices = Vector256.Create(0, 1, 2, 3, 4, 5, 6, 7);
        var keys = (bounds.AsInt32() & Vector256.Create(~7)) | laneIndices;
        if (Vector256.IsHardwareAccelerated)
        {
            PushByRank(keys, hits.AsInt32(), children, ref top);
        }
        else
        {
            PushByInsertion(keys, hits, children, ref top);
        }
    }

    /// <summary>Pushes without branches: the place of a child is the number of children that are hit and farther.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static void PushByRank(Vector256<int> keys, Vector256<int> hits, Vector256<uint> children, ref ulong top)
    {
        // A child that is not hit is closer than all others, so that it comes to lie above the new top.
        keys |= ~hits;
        var places1 = FartherMask(keys, Vector256.Create(1, 2, 3, 4, 5, 6, 7, 0));
        var places2 = FartherMask(keys, Vector256.Create(2, 3, 4, 5, 6, 7, 0, 1));
        var places3 = FartherMask(keys, Vector256.Create(3, 4, 5, 6, 7, 0, 1, 2));
        places1 += FartherMask(keys, Vector256.Create(4, 5, 6, 7, 0, 1, 2, 3));
        places2 += FartherMask(keys, Vector256.Create(5, 6, 7, 0, 1, 2, 3, 4));
        places3 += FartherMask(keys, Vector256.Create(6, 7, 0, 1, 2, 3, 4, 5));
        var places = -(places1 + places2 + places3 + FartherMask(keys, Vector256.Create(7, 0, 1, 2, 3, 4, 5, 6)));
        // Read back lane by lane, which costs less than to extract them.
        Unsafe.SkipInit(out PushedLanes lanes);
        ref var lane = ref lanes[0];
        places.AsUInt32().StoreUnsafe(ref lane);
        keys.AsUInt32().StoreUnsafe(ref lane, BvhLayout.BranchingFactor);
        children.StoreUnsafe(ref lane, 2 * BvhLayout.BranchingFactor);
        for (var i = 0; i < BvhLayout.BranchingFactor; i++)
        {
            Unsafe.Add(ref top, (nint)Unsafe.Add(ref lane, i)) =
                Entry(Unsafe.Add(ref lane, BvhLayout.BranchingFactor + i), Unsafe.Add(ref lane, (2 * BvhLayout.BranchingFactor) + i));
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<int> FartherMask(Vector256<int> keys, Vector256<int> order) =>
        Vector256.GreaterThan(Vector256.Shuffle(keys, order), keys);

    /// <summary>Pushes in the same order for processors that shuffle eight lanes slowly.</summary>
    private static void PushByInsertion(Vector256<int> keys, Vector256<float> hits, Vector256<uint> children, ref ulong top)
    {
        var count = 0;
        for (var mask = hits.ExtractMostSignificantBits(); mask != 0; mask &= mask - 1)
        {
            var lane = BitOperations.TrailingZeroCount(mask);
            var entry = Entry((uint)keys[lane], children[lane]);
            var place = count++;
            for (; place > 0 && Unsafe.Add(ref top, place - 1) < entry; place--)
            {
                Unsafe.Add(ref top, place) = Unsafe.Add(ref top, place - 1);
            }

            Unsafe.Add(ref top, place) = entry;
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static ulong Entry(uint key, uint child) => ((ulong)key << 32) | child;

    /// <summary>Places, keys and children of eight lanes.</summary>
    [InlineArray(3 * BvhLayout.BranchingFactor)]
    private struct PushedLanes
    {
        private uint _first;
    }
}
