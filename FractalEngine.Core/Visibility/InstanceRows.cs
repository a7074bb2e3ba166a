using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Fractals;

namespace FractalEngine.Core.Visibility;

/// <summary>A growing list of instances as the GPU takes them: rows of 3×4 maps in single precision.</summary>
internal sealed class InstanceRows
{
    /// <summary>Of one instance.</summary>
    public const int FloatsPerInstance = 12;

    // Grows by one in so many: what is kept is mostly used.
    private const int GrowthDivisor = 4;

    private readonly bool _hasPathHashes;
    private float[] _rows = new float[64 * FloatsPerInstance];
    private float[] _gradientFactors = [];
    private ulong[] _pathHashes = [];

    /// <summary>An empty list.</summary>
    /// <param name="hasPathHashes">Whether it is kept what tells instances apart.</param>
    public InstanceRows(bool hasPathHashes) => _hasPathHashes = hasPathHashes;

    /// <summary>How many.</summary>
    public int Count { get; private set; }

    /// <summary>The rows, [<see cref="Count"/> × 12].</summary>
    public ReadOnlySpan<float> Span => _rows.AsSpan(0, Count * FloatsPerInstance);

    /// <summary>
    /// Numbers from 0 to 1 between two colours, [<see cref="Count"/>]; only those of objects that have them mean anything.
    /// </summary>
    public ReadOnlySpan<float> GradientFactors => _gradientFactors.AsSpan(0, Math.Min(Count, _gradientFactors.Length));

    /// <summary>What tells the instances of one object apart.</summary>
    public ReadOnlySpan<ulong> PathHashes => _pathHashes.AsSpan(0, Count);

    /// <summary>Bytes.</summary>
    public long StorageBytes =>
        (_rows.Length * sizeof(float)) + (_gradientFactors.Length * sizeof(float)) + (_pathHashes.Length * sizeof(ulong));

    /// <summary>Makes room without giving back memory.</summary>
    public void Clear() => Count = 0;

    /// <summary>Appends an instance.</summary>
    /// <param name="map">From the frame of the base mesh.</param>
    /// <param name="vertexOrigin">The point of that frame that drawn vertices are relative to.</param>
    /// <param name="pathHash">What tells it apart.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Add(in SimdAffineMap map, Vector256<double> vertexOrigin, ulong pathHash)
    {
        EnsureCapacity();
        var (v1, v2, v3, t) = (ToSingle(map.V1), ToSingle(map.V2), ToSingle(map.V3), ToSingle(map.Apply(vertexOrigin)));
        ref var target = ref Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_rows), Count * FloatsPerInstance);
        Vector128.Create(v1[0], v2[0], v3[0], t[0]).StoreUnsafe(ref target);
        Vector128.Create(v1[1], v2[1], v3[1], t[1]).StoreUnsafe(ref target, 4);
        Vector128.Create(v1[2], v2[2], v3[2], t[2]).StoreUnsafe(ref target, 8);
        if (_hasPathHashes)
        {
            _pathHashes[Count] = pathHash;
        }

        Count++;
    }

    /// <summary>Gives the last instance a number between two colours.</summary>
    public void SetGradientFactor(float gradientFactor)
    {
        if (_gradientFactors.Length < Count)
        {
            Array.Resize(ref _gradientFactors, _rows.Length / FloatsPerInstance);
        }

        _gradientFactors[Count - 1] = gradientFactor;
    }

    /// <summary>Appends an instance of another list that has paths.</summary>
    public void Add(InstanceRows other, int index)
    {
        EnsureCapacity();
        other._rows.AsSpan(index * FloatsPerInstance, FloatsPerInstance).CopyTo(_rows.AsSpan(Count * FloatsPerInstance));
        if (_hasPathHashes)
        {
            _pathHashes[Count] = other._pathHashes[index];
        }

        Count++;
        if (index < other._gradientFactors.Length)
        {
            SetGradientFactor(other._gradientFactors[index]);
        }
    }

    private void EnsureCapacity()
    {
        if (Count == _rows.Length / FloatsPerInstance)
        {
            Array.Resize(ref _rows, (Count + (Count / GrowthDivisor) + 16) * FloatsPerInstance);
        }

        if (_hasPathHashes && _pathHashes.Length < _rows.Length / FloatsPerInstance)
        {
            Array.Resize(ref _pathHashes, _rows.Length / FloatsPerInstance);
        }
    }

    private static Vector128<float> ToSingle(Vector256<double> v) => Vector128.Narrow(v.GetLower(), v.GetUpper());
}
