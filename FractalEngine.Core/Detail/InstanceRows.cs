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

    // Grows by one in so many: what is kept is mostly used.
    private const int Slack = 4;

    private readonly bool _hasPaths;
    private float[] _rows = new float[64 * Floats];
    private float[] _tints = [];
    private ulong[] _paths = [];

    /// <summary>An empty list.</summary>
    /// <param name="hasPaths">Whether it is kept what tells instances apart.</param>
    public InstanceRows(bool hasPaths) => _hasPaths = hasPaths;

    /// <summary>How many.</summary>
    public int Count { get; private set; }

    /// <summary>The rows, [<see cref="Count"/> × 12].</summary>
    public ReadOnlySpan<float> Span => _rows.AsSpan(0, Count * Floats);

    /// <summary>Numbers from 0 to 1 between two colours, [<see cref="Count"/>]; only those of objects that have them mean anything.</summary>
    public ReadOnlySpan<float> Tints => _tints.AsSpan(0, Math.Min(Count, _tints.Length));

    /// <summary>What tells the instances of one object apart.</summary>
    public ReadOnlySpan<ulong> Paths => _paths.AsSpan(0, Count);

    /// <summary>Bytes.</summary>
    public long StorageBytes => (_rows.Length * sizeof(float)) + (_tints.Length * sizeof(float)) + (_paths.Length * sizeof(ulong));

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
        if (_hasPaths)
        {
            _paths[Count] = path;
        }

        Count++;
    }

    /// <summary>Gives the last instance a number between two colours.</summary>
    public void SetTint(float tint)
    {
        if (_tints.Length < Count)
        {
            Array.Resize(ref _tints, _rows.Length / Floats);
        }

        _tints[Count - 1] = tint;
    }

    /// <summary>Appends an instance of another list that has paths.</summary>
    public void Add(InstanceRows other, int index)
    {
        Reserve();
        other._rows.AsSpan(index * Floats, Floats).CopyTo(_rows.AsSpan(Count * Floats));
        if (_hasPaths)
        {
            _paths[Count] = other._paths[index];
        }

        Count++;
        if (index < other._tints.Length)
        {
            SetTint(other._tints[index]);
        }
    }

    private void Reserve()
    {
        if (Count == _rows.Length / Floats)
        {
            Array.Resize(ref _rows, (Count + (Count / Slack) + 16) * Floats);
        }

        if (_hasPaths && _paths.Length < _rows.Length / Floats)
        {
            Array.Resize(ref _paths, _rows.Length / Floats);
        }
    }

    private static Vector128<float> Single(Vector256<double> v) => Vector128.Narrow(v.GetLower(), v.GetUpper());
}
