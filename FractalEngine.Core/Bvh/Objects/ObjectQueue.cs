namespace FractalEngine.Core.Bvh.Objects;

/// <summary>
/// The objects of a scene, and nodes above them, that a query has yet to visit, by lower bounds on their distances. Of equal bounds, nodes
/// and objects whose own box was not tested come first, then the object with the smallest index.
/// </summary>
/// <remarks>A binary heap whose memory is kept for the next query.</remarks>
internal sealed class ObjectQueue
{
    /// <summary>What has no index: a node, or an object whose own box was not tested.</summary>
    public const int Untested = -1;

    private Entry[] _entries = new Entry[64];
    private int _count;
    private int _highestCount;

    /// <summary>Lower bound on the distance of all that is queued; infinite where nothing is.</summary>
    public double Bound => _count > 0 ? _entries[0].Bound : double.PositiveInfinity;

    /// <summary>Adds a node or an object.</summary>
    /// <param name="bound">Lower bound on its distance.</param>
    /// <param name="leafIndex">Index of an object whose own box has this distance; else <see cref="Untested"/>.</param>
    /// <param name="target">The node or the leaf.</param>
    public void Add(double bound, int leafIndex, object target)
    {
        if (_count == _entries.Length)
        {
            Array.Resize(ref _entries, 2 * _count);
        }

        var entries = _entries;
        var added = new Entry(bound, leafIndex, target);
        var hole = _count++;
        _highestCount = Math.Max(_highestCount, _count);
        while (hole > 0 && added.IsBefore(in entries[(hole - 1) / 2]))
        {
            entries[hole] = entries[(hole - 1) / 2];
            hole = (hole - 1) / 2;
        }

        entries[hole] = added;
    }

    /// <summary>Removes what comes first.</summary>
    /// <param name="bound">Lower bound on its distance.</param>
    /// <param name="leafIndex">Index of an object whose own box has this distance; else <see cref="Untested"/>.</param>
    /// <param name="target">A node or a leaf.</param>
    /// <returns>False when the queue is empty.</returns>
    public bool TryTake(out double bound, out int leafIndex, out object? target)
    {
        if (_count == 0)
        {
            bound = double.PositiveInfinity;
            leafIndex = Untested;
            target = null;
            return false;
        }

        var entries = _entries;
        (bound, leafIndex, target) = entries[0];
        var last = entries[--_count];
        var hole = 0;
        for (var child = 1; child < _count; child = (2 * hole) + 1)
        {
            child += child + 1 < _count && entries[child + 1].IsBefore(in entries[child]) ? 1 : 0;
            if (!entries[child].IsBefore(in last))
            {
                break;
            }

            entries[hole] = entries[child];
            hole = child;
        }

        entries[hole] = last;
        return true;
    }

    /// <summary>Empties the queue, which then keeps no scene alive.</summary>
    public void Clear()
    {
        Array.Clear(_entries, 0, _highestCount);
        _count = 0;
        _highestCount = 0;
    }

    private readonly record struct Entry(double Bound, int LeafIndex, object? Target)
    {
        public bool IsBefore(in Entry other) => Bound < other.Bound || (Bound == other.Bound && LeafIndex < other.LeafIndex);
    }
}
