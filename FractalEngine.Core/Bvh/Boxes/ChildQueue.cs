using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Bvh.Boxes;

/// <summary>The queue of children anywhere, in double precision.</summary>
/// <remarks>
/// Keys keep all their digits. Small children of a distant sub-fractal differ in the last ones only, and a search that visits them in
/// another order creeps towards the closest.
/// </remarks>
/// <param name="values">Memory of the queue, [2 × padded children]: bounds and keys.</param>
internal readonly ref struct ChildQueue(Span<double> values) : IChildQueue
{
    /// <summary>Number of values for each child.</summary>
    public const int ValuesPerChild = 2;

    // Children around the position have no distance, and are ordered by their centres.
    private const double CentreWeight = 1e-4;

    // For children apart from the position, centres only decide between equal bounds: far away, small children differ by so little.
    private const double SeparatedFactor = 1e-8;

    private readonly ref double _values = ref MemoryMarshal.GetReference(values);
    private readonly int _paddedCount = values.Length / ValuesPerChild;

    /// <summary>Sets the bounds of four children.</summary>
    /// <param name="bounds">Lower bounds of the squared distances.</param>
    /// <param name="centreDistances">Squared distances of the children's centres.</param>
    /// <param name="firstChild">Index of the first of the four.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void SetBounds(Vector256<double> bounds, Vector256<double> centreDistances, int firstChild)
    {
        bounds.StoreUnsafe(ref _values, (nuint)firstChild);
        var weights = Vector256.ConditionalSelect(
            Vector256.GreaterThan(bounds, Vector256<double>.Zero),
            Vector256.Create(CentreWeight * SeparatedFactor),
            Vector256.Create(CentreWeight));
        (bounds + (weights * centreDistances)).StoreUnsafe(ref _values, (nuint)(_paddedCount + firstChild));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool TryPeek(double cutoffSquared, double cutoff, out int child)
    {
        var cutoffs = Vector256.Create(cutoffSquared);
        var infinity = Vector256.Create(double.PositiveInfinity);
        var smallestKey = infinity;
        for (var i = 0; i < _paddedCount; i += VectorX4.Count)
        {
            var isBelow = Vector256.LessThan(Vector256.LoadUnsafe(ref _values, (nuint)i), cutoffs);
            var key = Vector256.ConditionalSelect(isBelow, Vector256.LoadUnsafe(ref _values, (nuint)(_paddedCount + i)), infinity);
            smallestKey = Vector256.MinNative(smallestKey, key);
        }

        var pair = Vector128.MinNative(smallestKey.GetLower(), smallestKey.GetUpper());
        pair = Vector128.MinNative(pair, Vector128.Shuffle(pair.AsInt64(), Vector128.Create(1L, 0)).AsDouble());
        child = -1;
        if (!(pair[0] < double.PositiveInfinity))
        {
            return false;
        }

        smallestKey = Vector256.Create(pair[0]);
        for (var i = 0; ; i += VectorX4.Count)
        {
            var isSmallest = Vector256.Equals(Vector256.LoadUnsafe(ref _values, (nuint)(_paddedCount + i)), smallestKey)
                & Vector256.LessThan(Vector256.LoadUnsafe(ref _values, (nuint)i), cutoffs);
            var bits = isSmallest.ExtractMostSignificantBits();
            if (bits != 0)
            {
                child = i + BitOperations.TrailingZeroCount(bits);
                return true;
            }
        }
    }

    /// <inheritdoc/>
    public double BoundOf(int child) => Unsafe.Add(ref _values, child);

    /// <inheritdoc/>
    public bool MayContain(int child) => Unsafe.Add(ref _values, child) <= 0;

    /// <summary>The present key of a child.</summary>
    public double KeyOf(int child) => Unsafe.Add(ref _values, _paddedCount + child);

    /// <inheritdoc/>
    public void Remove(int child) => Unsafe.Add(ref _values, child) = double.PositiveInfinity;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool Refine(int child, double bound)
    {
        ref var previousBound = ref Unsafe.Add(ref _values, child);
        if (!(bound > previousBound))
        {
            return false;
        }

        ref var key = ref Unsafe.Add(ref _values, _paddedCount + child);
        key = (previousBound > 0 ? key : key * SeparatedFactor) + (bound - previousBound);
        // The centre of a huge box that is nearly empty says nothing.
        key = Math.Min(key, 2 * bound);
        previousBound = bound;
        return true;
    }
}
