using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision;

namespace FractalEngine.Core.Detail;

/// <summary>A growing list of instances as the GPU takes them: rows of 3×4 maps in single precision.</summary>
internal sealed class InstanceRows
{
    /// <summary>Of one instance.</summary>
    public const int Floats = 12;

    private float[] _rows = new float[64 * Floats];
    private ulong[] _paths = new ulong[64];

    /// <summary>How many.</summary>
    public int Count { get; private set; }

    /// <summary>The rows, [<see cref="Count"/> × 12].</summary>
    public ReadOnlySpan<float> Span => _rows.AsSpan(0, Count * Floats);

    /// <summary>What tells the instances of one object apart.</summary>
    public ReadOnlySpan<ulong> Paths => _paths.AsSpan(0, Count);

    /// <summary>Bytes.</summary>
    public long StorageBytes => (_rows.Length * sizeof(float)) + (_paths.Length * sizeof(ulong));

    /// <summary>Makes room without giving back memory.</summary>
    public void Clear() => Count = 0;

    /// <summary>Appends an instance.</summary>
    /// <param name="map">From the frame of the base mesh.</param>
    /// <param name="origin">The point of that frame that drawn vertices are relative to.</param>
    /// <param name="path">What tells it apart.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Add(in AffineLanes map, Vector256<double> origin, ulong path)
    {
        Reserve();
        var (v1, v2, v3, t) = (Single(map.V1), Single(map.V2), Single(map.V3), Single(map.Apply(origin)));
        ref var target = ref Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_rows), Count * Floats);
        Vector128.Create(v1[0], v2[0], v3[0], t[0]).StoreUnsafe(ref target);
        Vector128.Create(v1[1], v2[1], v3[1], t[1]).StoreUnsafe(ref target, 4);
        Vector128.Create(v1[2], v2[2], v3[2], t[2]).StoreUnsafe(ref target, 8);
        _paths[Count++] = path;
    }

    /// <summary>Appends an instance of another list.</summary>
    public void Add(InstanceRows other, int index)
    {
        Reserve();
        other._rows.AsSpan(index * Floats, Floats).CopyTo(_rows.AsSpan(Count * Floats));
        _paths[Count++] = other._paths[index];
    }

    private void Reserve()
    {
        if (Count == _paths.Length)
        {
            Array.Resize(ref _rows, 2 * _rows.Length);
            Array.Resize(ref _paths, 2 * _paths.Length);
        }
    }

    private static Vector128<float> Single(Vector256<double> v) => Vector128.Narrow(v.GetLower(), v.GetUpper());
}
