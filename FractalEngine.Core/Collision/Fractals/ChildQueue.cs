using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// The copies of a sub-fractal in the order in which they are looked at: for each a lower bound of its squared distance, and a key, which
/// is the bound, or orders copies whose bound is 0. Bounds are first rough, and refined only for copies whose turn it is.
/// </summary>
/// <param name="values">[3 × padded]: bounds, keys, and 1 for what is refined.</param>
internal readonly ref struct ChildQueue(Span<double> values)
{
    /// <summary>Numbers for each copy.</summary>
    public const int ValuesPerChild = 3;

    // Copies around the position have no distance; they are looked at in the order of their centres. For copies apart from it that only
    // decides between equal bounds: far away, small copies differ by so little.
    private const double CentreWeight = 1e-4;
    private const double SeparatedFactor = 1e-8;

    private readonly Span<double> _values = values;
    private readonly int _paddedCount = values.Length / ValuesPerChild;

    /// <summary>Sets the rough bounds of four copies.</summary>
    /// <param name="bounds">Squared distances.</param>
    /// <param name="centreDistances">Squared distances of their centres.</param>
    /// <param name="firstChild">The number of the first.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void SetBounds(Vector256<double> bounds, Vector256<double> centreDistances, int firstChild)
    {
        ref var values = ref MemoryMarshal.GetReference(_values);
        bounds.StoreUnsafe(ref values, (nuint)firstChild);
        var weights = Vector256.ConditionalSelect(
            Vector256.GreaterThan(bounds, Vector256<double>.Zero), Vector256.Create(CentreWeight * SeparatedFactor),
            Vector256.Create(CentreWeight));
        (bounds + (weights * centreDistances)).StoreUnsafe(ref values, (nuint)(_paddedCount + firstChild));
        Vector256<double>.Zero.StoreUnsafe(ref values, (nuint)((2 * _paddedCount) + firstChild));
    }

    /// <summary>Raises the bounds of four copies.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void RaiseBounds(Vector256<double> newBounds, int firstChild)
    {
        ref var values = ref MemoryMarshal.GetReference(_values);
        var previousBounds = Vector256.LoadUnsafe(ref values, (nuint)firstChild);
        var bounds = Vector256.MaxNative(previousBounds, newBounds);
        bounds.StoreUnsafe(ref values, (nuint)firstChild);
        var keys = Vector256.LoadUnsafe(ref values, (nuint)(_paddedCount + firstChild));
        // What was around the position and is no longer has the weight of what is apart. NaN where there is no copy; that is never
        // compared.
        var wasSeparated = Vector256.GreaterThan(previousBounds, Vector256<double>.Zero) | Vector256.Equals(bounds, previousBounds);
        keys *= Vector256.ConditionalSelect(wasSeparated, Vector256<double>.One, Vector256.Create(SeparatedFactor));
        (keys + (bounds - previousBounds)).StoreUnsafe(ref values, (nuint)(_paddedCount + firstChild));
    }

    /// <summary>The copy with the smallest key of those whose bound is below a limit.</summary>
    /// <param name="cutoffSquared">Exclusive.</param>
    /// <param name="child">Its number.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool TryPeek(double cutoffSquared, out int child)
    {
        ref var values = ref MemoryMarshal.GetReference(_values);
        var (cutoffs, infinity) = (Vector256.Create(cutoffSquared), Vector256.Create(double.PositiveInfinity));
        var smallestKey = infinity;
        for (var i = 0; i < _paddedCount; i += SubFractal.Lanes)
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
        for (var i = 0; ; i += SubFractal.Lanes)
        {
            var isSmallest = Vector256.Equals(Vector256.LoadUnsafe(ref values, (nuint)(_paddedCount + i)), smallestKey)
                & Vector256.LessThan(Vector256.LoadUnsafe(ref values, (nuint)i), cutoffs);
            var bits = isSmallest.ExtractMostSignificantBits();
            if (bits != 0)
            {
                child = i + System.Numerics.BitOperations.TrailingZeroCount(bits);
                return true;
            }
        }
    }

    /// <summary>The bound of a copy so far.</summary>
    public double BoundOf(int child) => _values[child];

    /// <summary>The key of a copy so far.</summary>
    public double KeyOf(int child) => _values[_paddedCount + child];

    /// <summary>Whether the copy has the best bound there is.</summary>
    public bool IsRefined(int child) => _values[(2 * _paddedCount) + child] != 0;

    /// <summary>Takes a copy out.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Remove(int child) => _values[_paddedCount + child] = double.PositiveInfinity;

    /// <summary>Gives a copy the best bound there is.</summary>
    /// <returns>False when its bound has not grown, so that it is still the next one.</returns>
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
        previousBound = bound;
        return true;
    }
}
