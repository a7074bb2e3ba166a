using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Bvh;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// Orders the children of a sub-fractal by their distances. Each child has a lower bound of its squared distance, and a key that is the
/// bound or orders children whose bound is 0. Bounds are first rough, and refined only for children whose turn it is.
/// </summary>
/// <param name="values">Memory of the queue, [3 × padded children]: bounds, keys, and 1 for refined bounds.</param>
internal readonly ref struct ChildQueue(Span<double> values)
{
    /// <summary>Number of values for each child.</summary>
    public const int ValuesPerChild = 3;

    // Children around the position have no distance, and are ordered by their centres.
    private const double CentreWeight = 1e-4;

    // For children apart from the position, centres only decide between equal bounds: far away, small children differ by so little.
    private const double SeparatedFactor = 1e-8;

    private readonly Span<double> _values = values;
    private readonly int _paddedCount = values.Length / ValuesPerChild;

    /// <summary>Sets the rough bounds of four children.</summary>
    /// <param name="bounds">Lower bounds of the squared distances.</param>
    /// <param name="centreDistances">Squared distances of the children's centres.</param>
    /// <param name="firstChild">Index of the first of the four.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void SetBounds(Vector256<double> bounds, Vector256<double> centreDistances, int firstChild)
    {
        ref var values = ref MemoryMarshal.GetReference(_values);
        bounds.StoreUnsafe(ref values, (nuint)firstChild);
        var weights = Vector256.ConditionalSelect(
            Vector256.GreaterThan(bounds, Vector256<double>.Zero),
            Vector256.Create(CentreWeight * SeparatedFactor),
            Vector256.Create(CentreWeight));
        (bounds + (weights * centreDistances)).StoreUnsafe(ref values, (nuint)(_paddedCount + firstChild));
        Vector256<double>.Zero.StoreUnsafe(ref values, (nuint)((2 * _paddedCount) + firstChild));
    }

    /// <summary>Raises the bounds of four children, where they are larger than before.</summary>
    /// <param name="newBounds">Lower bounds of the squared distances.</param>
    /// <param name="firstChild">Index of the first of the four.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void RaiseBounds(Vector256<double> newBounds, int firstChild)
    {
        ref var values = ref MemoryMarshal.GetReference(_values);
        var previousBounds = Vector256.LoadUnsafe(ref values, (nuint)firstChild);
        var bounds = Vector256.MaxNative(previousBounds, newBounds);
        bounds.StoreUnsafe(ref values, (nuint)firstChild);
        var keys = Vector256.LoadUnsafe(ref values, (nuint)(_paddedCount + firstChild));
        // A child that proves to be apart from the position gets the weight of separated ones. Padding gives NaN, which is never compared.
        var keepsWeight = Vector256.GreaterThan(previousBounds, Vector256<double>.Zero) | Vector256.Equals(bounds, previousBounds);
        keys *= Vector256.ConditionalSelect(keepsWeight, Vector256<double>.One, Vector256.Create(SeparatedFactor));
        (keys + (bounds - previousBounds)).StoreUnsafe(ref values, (nuint)(_paddedCount + firstChild));
    }

    /// <summary>Finds the child with the smallest key of those whose bound is below a limit.</summary>
    /// <param name="cutoffSquared">The limit, exclusive.</param>
    /// <param name="child">Index of the child; −1 for none.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool TryPeek(double cutoffSquared, out int child)
    {
        ref var values = ref MemoryMarshal.GetReference(_values);
        var cutoffs = Vector256.Create(cutoffSquared);
        var infinity = Vector256.Create(double.PositiveInfinity);
        var smallestKey = infinity;
        for (var i = 0; i < _paddedCount; i += VectorX4.Count)
        {
            var isBelow = Vector256.LessThan(Vector256.LoadUnsafe(ref values, (nuint)i), cutoffs);
            var key = Vector256.ConditionalSelect(isBelow, Vector256.LoadUnsafe(ref values, (nuint)(_paddedCount + i)), infinity);
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
            var isSmallest = Vector256.Equals(Vector256.LoadUnsafe(ref values, (nuint)(_paddedCount + i)), smallestKey)
                & Vector256.LessThan(Vector256.LoadUnsafe(ref values, (nuint)i), cutoffs);
            var bits = isSmallest.ExtractMostSignificantBits();
            if (bits != 0)
            {
                child = i + BitOperations.TrailingZeroCount(bits);
                return true;
            }
        }
    }

    /// <summary>The present lower bound of a child's squared distance.</summary>
    public double BoundOf(int child) => _values[child];

    /// <summary>The present key of a child.</summary>
    public double KeyOf(int child) => _values[_paddedCount + child];

    /// <summary>Tells whether a child has the best bound there is.</summary>
    public bool IsRefined(int child) => _values[(2 * _paddedCount) + child] != 0;

    /// <summary>Removes a child from the queue.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Remove(int child) => _values[_paddedCount + child] = double.PositiveInfinity;

    /// <summary>Gives a child the best bound there is.</summary>
    /// <param name="child">Index of the child.</param>
    /// <param name="bound">Lower bound of its squared distance; ignored if it is smaller than before.</param>
    /// <returns>False when the bound has not grown, so that the child is still the next one.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool Refine(int child, double bound)
    {
        ref var previousBound = ref _values[child];
        _values[(2 * _paddedCount) + child] = 1;
        if (!(bound > previousBound))
        {
            return false;
        }

        ref var key = ref _values[_paddedCount + child];
        key = (previousBound > 0 ? key : key * SeparatedFactor) + (bound - previousBound);
        // The centre of a huge box that is nearly empty says nothing.
        key = Math.Min(key, 2 * bound);
        previousBound = bound;
        return true;
    }
}
