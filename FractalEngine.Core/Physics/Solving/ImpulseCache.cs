using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Solving;

/// <summary>Keeps the impulses of a step, from which the solve of the next one begins: what rests is then solved at once.</summary>
internal sealed class ImpulseCache
{
    // Cosine between normals from which on two contacts with one surface count as the same.
    private const double MinCosine = 0.99;

    // Marks a slot of the hash table without an entry.
    private const int None = -1;

    private const int RowsPerJob = 1024;
    private const int SlotBits = 3;

    private IslandSet? _islands;
    private Entry[] _entries = [];
    private int[] _slots = [];
    private int _mask;

    /// <summary>Gives a contact the impulses that it had in the step before; 0 to a new one.</summary>
    public void Recall(ref ContactRow row)
    {
        row.NormalImpulse = 0;
        row.FrictionImpulse = Vector.Zero;
        row.TurnImpulse = Vector.Zero;
        // When two count as the same, the first one of the step before is taken, whichever place it has found.
        var found = int.MaxValue;
        for (var slot = SlotOf(row.Key); _slots[slot] != None; slot = (slot + 1) & _mask)
        {
            ref readonly var entry = ref _entries[_slots[slot]];
            if (entry.Key == row.Key && _slots[slot] < found && Vector.Dot(entry.Normal, row.Normal) >= MinCosine)
            {
                found = _slots[slot];
                row.NormalImpulse = entry.NormalImpulse;
                row.FrictionImpulse = entry.FrictionImpulse;
                row.TurnImpulse = entry.TurnImpulse;
            }
        }
    }

    /// <summary>Stores the impulses of all contacts that push, on all threads.</summary>
    public void Store(IslandSet islands, int maxThreads)
    {
        Reserve(islands.RowCapacity);
        Array.Fill(_slots, None);
        _islands = islands;
        var jobs = (islands.RowCount + RowsPerJob - 1) / RowsPerJob;
        WorkerSet.Shared.Run(jobs, maxThreads, this, static (cache, job) => cache.StoreRows(job));
    }

    private void StoreRows(int job)
    {
        var end = Math.Min(_islands!.RowCount, (job + 1) * RowsPerJob);
        for (var i = job * RowsPerJob; i < end; i++)
        {
            ref readonly var row = ref _islands.Row(i);
            if (row.NormalImpulse > 0)
            {
                _entries[i] = new()
                {
                    Key = row.Key, Normal = row.Normal, NormalImpulse = row.NormalImpulse, FrictionImpulse = row.FrictionImpulse,
                    TurnImpulse = row.TurnImpulse,
                };
                var slot = SlotOf(row.Key);
                while (Interlocked.CompareExchange(ref _slots[slot], i, None) != None)
                {
                    slot = (slot + 1) & _mask;
                }
            }
        }
    }

    /// <summary>Discards the impulses of all contacts.</summary>
    public void Clear() => Array.Fill(_slots, None);

    /// <summary>Makes room for so many contacts. Discards what is stored where it has to grow.</summary>
    public void Reserve(int count)
    {
        if (_entries.Length < count)
        {
            _entries = new Entry[count];
            _slots = new int[4 << int.Log2(count)];
            _mask = _slots.Length - 1;
            Clear();
        }
    }

    // Contacts of one body have places side by side, and those of the next one follow: rows are in that order, and so the memory is.
    // A multiplication by 2^32 divided by the golden ratio mixes the bits of the other body.
    private int SlotOf(long key) => ((int)(key >> 32 << SlotBits) + (int)((uint)key * 0x9E3779B9 >> (32 - SlotBits))) & _mask;

    private struct Entry
    {
        public long Key;
        public Vector Normal;
        public double NormalImpulse;
        public Vector FrictionImpulse;
        public Vector TurnImpulse;
    }
}
