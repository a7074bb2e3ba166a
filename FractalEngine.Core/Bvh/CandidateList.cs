using System.Runtime.CompilerServices;

namespace FractalEngine.Core.Bvh;

/// <summary>
/// Triangles that a search in single precision can't tell from the closest one. They are decided in double precision at its end.
/// </summary>
/// <param name="entries">Memory for the list, at least <see cref="Capacity"/> values.</param>
internal ref struct CandidateList(Span<ulong> entries)
{
    /// <summary>Maximum number of triangles in the list.</summary>
    public const int Capacity = 40;

    // The bits of the squared distance above the place of the triangle among those of all leaves.
    private readonly Span<ulong> _entries = entries;

    /// <summary>Number of triangles that are in the list now.</summary>
    public int Count { get; private set; }

    /// <summary>True when another leaf may not fit.</summary>
    public readonly bool IsFull => Count > Capacity - BvhLayout.MaxLeafTriangles;

    /// <summary>The place of a listed triangle among the triangles of all leaves.</summary>
    public readonly int this[int i] => (int)_entries[i];

    /// <summary>Adds a triangle at the end of the list.</summary>
    /// <param name="distanceSquared">Its squared distance in single precision.</param>
    /// <param name="triangle">Its place among the triangles of all leaves.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Add(float distanceSquared, int triangle) =>
        _entries[Count++] = ((ulong)BitConverter.SingleToUInt32Bits(distanceSquared) << 32) | (uint)triangle;

    /// <summary>Removes all triangles from the list.</summary>
    public void Clear() => Count = 0;

    /// <summary>Removes the triangles that are not below a limit.</summary>
    /// <param name="cutoffSquared">Exclusive limit of squared distances in single precision.</param>
    public void RemoveFrom(float cutoffSquared)
    {
        var kept = 0;
        for (var i = 0; i < Count; i++)
        {
            var entry = _entries[i];
            _entries[kept] = entry;
            kept += BitConverter.UInt32BitsToSingle((uint)(entry >> 32)) < cutoffSquared ? 1 : 0;
        }

        Count = kept;
    }
}
