using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Bvh.Boxes;

/// <summary>The queue of children that are near the position, in single precision: eight bounds are compared at once.</summary>
/// <remarks>The last bits of a key are the child's index, so that one pass over the keys finds the child.</remarks>
/// <param name="values">Memory of the queue, [padded children]: bounds and keys, each a float.</param>
/// <param name="error">An upper bound of the rounding error of a distance.</param>
internal readonly ref struct FloatChildQueue(Span<double> values, float error) : IChildQueue
{
    /// <summary>Number of children in a vector.</summary>
    public const int LaneCount = 8;

    private const int IndexMask = 63;

    // As in ChildQueue, but no float tells bounds apart as finely.
    private const float CentreWeight = 1e-4f;
    private const float SeparatedWeight = 1e-7f;

    // The rounding of the limit itself.
    private const float LimitFactor = 1 + (8f / (1 << 24));

    private readonly ref float _values = ref Unsafe.As<double, float>(ref MemoryMarshal.GetReference(values));
    private readonly int _paddedCount = values.Length;
    private readonly float _error = error;

    /// <summary>Sets the bounds of eight children.</summary>
    /// <param name="bounds">Lower bounds of the squared distances, but for the rounding error.</param>
    /// <param name="centreDistances">Squared distances of the children's centres.</param>
    /// <param name="firstChild">Index of the first of the eight, a multiple of eight.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void SetBounds(Vector256<float> bounds, Vector256<float> centreDistances, int firstChild)
    {
        bounds.StoreUnsafe(ref _values, (nuint)firstChild);
        var weights = Vector256.ConditionalSelect(
            Vector256.GreaterThan(bounds, Vector256<float>.Zero),
            Vector256.Create(SeparatedWeight),
            Vector256.Create(CentreWeight));
        var keys = bounds + (weights * centreDistances);
        var indices = Vector256.Create(0, 1, 2, 3, 4, 5, 6, 7) + Vector256.Create(firstChild);
        keys = ((keys.AsInt32() & Vector256.Create(~IndexMask)) | indices).AsSingle();
        keys.StoreUnsafe(ref _values, (nuint)(_paddedCount + firstChild));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool TryPeek(double cutoffSquared, double cutoff, out int child)
    {
        var cutoffs = Vector256.Create(SquaredLimit(cutoff));
        var infinity = Vector256.Create(float.PositiveInfinity);
        var smallestKey = infinity;
        for (var i = 0; i < _paddedCount; i += LaneCount)
        {
            var isBelow = Vector256.LessThan(Vector256.LoadUnsafe(ref _values, (nuint)i), cutoffs);
            var key = Vector256.ConditionalSelect(isBelow, Vector256.LoadUnsafe(ref _values, (nuint)(_paddedCount + i)), infinity);
            smallestKey = Vector256.MinNative(smallestKey, key);
        }

        var half = Vector128.MinNative(smallestKey.GetLower(), smallestKey.GetUpper());
        half = Vector128.MinNative(half, Vector128.Shuffle(half, Vector128.Create(2, 3, 0, 1)));
        half = Vector128.MinNative(half, Vector128.Shuffle(half, Vector128.Create(1, 0, 3, 2)));
        var bits = half.AsInt32()[0];
        child = bits & IndexMask;
        return bits != BitConverter.SingleToInt32Bits(float.PositiveInfinity);
    }

    /// <inheritdoc/>
    public double BoundOf(int child)
    {
        var distance = MathF.Max(0, MathF.Sqrt(Unsafe.Add(ref _values, child)) - _error);
        return distance * distance;
    }

    /// <inheritdoc/>
    public bool MayContain(int child) => Unsafe.Add(ref _values, child) <= _error * _error;

    /// <inheritdoc/>
    public void Remove(int child) => Unsafe.Add(ref _values, child) = float.PositiveInfinity;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool Refine(int child, double bound)
    {
        ref var previousBound = ref Unsafe.Add(ref _values, child);
        var newBound = (float)bound;
        if (!(newBound > previousBound))
        {
            return false;
        }

        Unsafe.Add(ref _values, _paddedCount + child) =
            BitConverter.Int32BitsToSingle((BitConverter.SingleToInt32Bits(newBound) & ~IndexMask) | child);
        previousBound = newBound;
        return true;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private float SquaredLimit(double cutoff)
    {
        var limit = ((float)cutoff + _error) * LimitFactor;
        return limit * limit;
    }
}
