using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Collision;

/// <summary>
/// The copies of a sub-fractal in the order in which they are looked at: for each a lower bound of its squared distance, and a key, which
/// is the bound, or orders copies whose bound is 0. Bounds are first rough, and refined only for copies whose turn it is.
/// </summary>
/// <param name="numbers">[3 × padded]: bounds, keys, and 1 for what is refined.</param>
internal readonly ref struct CopyQueue(Span<double> numbers)
{
    /// <summary>Numbers for each copy.</summary>
    public const int Rows = 3;

    // Copies around the position have no distance; they are looked at in the order of their centres. For copies apart from it that only decides
    // between equal bounds: far away, small copies differ by so little.
    private const double CentreWeight = 1e-4;
    private const double Apart = 1e-8;

    private readonly Span<double> _numbers = numbers;
    private readonly int _count = numbers.Length / Rows;

    /// <summary>Sets the rough bounds of four copies.</summary>
    /// <param name="bounds">Squared distances.</param>
    /// <param name="centres">Squared distances of their centres.</param>
    /// <param name="first">The number of the first.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Set(Vector256<double> bounds, Vector256<double> centres, int first)
    {
        ref var number = ref MemoryMarshal.GetReference(_numbers);
        bounds.StoreUnsafe(ref number, (nuint)first);
        var weights = Vector256.ConditionalSelect(
            Vector256.GreaterThan(bounds, Vector256<double>.Zero), Vector256.Create(CentreWeight * Apart), Vector256.Create(CentreWeight));
        (bounds + (weights * centres)).StoreUnsafe(ref number, (nuint)(_count + first));
        Vector256<double>.Zero.StoreUnsafe(ref number, (nuint)((2 * _count) + first));
    }

    /// <summary>Raises the bounds of four copies.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Raise(Vector256<double> larger, int first)
    {
        ref var number = ref MemoryMarshal.GetReference(_numbers);
        var before = Vector256.LoadUnsafe(ref number, (nuint)first);
        var bounds = Vector256.MaxNative(before, larger);
        bounds.StoreUnsafe(ref number, (nuint)first);
        var keys = Vector256.LoadUnsafe(ref number, (nuint)(_count + first));
        // What was around the position and is no longer has the weight of what is apart. NaN where there is no copy; that is never compared.
        var wasApart = Vector256.GreaterThan(before, Vector256<double>.Zero) | Vector256.Equals(bounds, before);
        keys *= Vector256.ConditionalSelect(wasApart, Vector256<double>.One, Vector256.Create(Apart));
        (keys + (bounds - before)).StoreUnsafe(ref number, (nuint)(_count + first));
    }

    /// <summary>The copy with the smallest key of those whose bound is below a limit.</summary>
    /// <param name="limit">Exclusive.</param>
    /// <param name="copy">Its number.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool TryPeek(double limit, out int copy)
    {
        ref var number = ref MemoryMarshal.GetReference(_numbers);
        var (limits, none) = (Vector256.Create(limit), Vector256.Create(double.PositiveInfinity));
        var smallest = none;
        for (var i = 0; i < _count; i += SubFractal.Lanes)
        {
            var isBelow = Vector256.LessThan(Vector256.LoadUnsafe(ref number, (nuint)i), limits);
            var key = Vector256.ConditionalSelect(isBelow, Vector256.LoadUnsafe(ref number, (nuint)(_count + i)), none);
            smallest = Vector256.MinNative(smallest, key);
        }

        var pair = Vector128.MinNative(smallest.GetLower(), smallest.GetUpper());
        pair = Vector128.MinNative(pair, Vector128.Shuffle(pair.AsInt64(), Vector128.Create(1L, 0)).AsDouble());
        copy = -1;
        if (!(pair[0] < double.PositiveInfinity))
        {
            return false;
        }

        smallest = Vector256.Create(pair[0]);
        for (var i = 0; ; i += SubFractal.Lanes)
        {
            var equal = Vector256.Equals(Vector256.LoadUnsafe(ref number, (nuint)(_count + i)), smallest)
                & Vector256.LessThan(Vector256.LoadUnsafe(ref number, (nuint)i), limits);
            var bits = equal.ExtractMostSignificantBits();
            if (bits != 0)
            {
                copy = i + System.Numerics.BitOperations.TrailingZeroCount(bits);
                return true;
            }
        }
    }

    /// <summary>The bound of a copy so far.</summary>
    public double BoundOf(int copy) => _numbers[copy];

    /// <summary>The key of a copy so far.</summary>
    public double KeyOf(int copy) => _numbers[_count + copy];

    /// <summary>Whether the copy has the best bound there is.</summary>
    public bool IsRefined(int copy) => _numbers[(2 * _count) + copy] != 0;

    /// <summary>Takes a copy out.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Remove(int copy) => _numbers[_count + copy] = double.PositiveInfinity;

    /// <summary>Gives a copy the best bound there is.</summary>
    /// <returns>False when its bound has not grown, so that it is still the next one.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool Refine(int copy, double bound)
    {
        ref var before = ref _numbers[copy];
        _numbers[(2 * _count) + copy] = 1;
        if (!(bound > before))
        {
            return false;
        }

        ref var key = ref _numbers[_count + copy];
        key = (before > 0 ? key : key * Apart) + (bound - before);
        before = bound;
        return true;
    }
}
