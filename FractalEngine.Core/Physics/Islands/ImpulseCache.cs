using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>Keeps the impulses of a step, from which the solve of the next one begins: what rests is then solved at once.</summary>
internal sealed class ImpulseCache
{
    private const int InitialCapacity = 256;

    // Cosine between normals from which on two contacts with one surface count as the same.
    private const double MinCosine = 0.99;

    private long[] _keys = new long[InitialCapacity];
    private Entry[] _entries = new Entry[InitialCapacity];
    private int _count;

    /// <summary>Gives contacts the impulses that they had in the step before; 0 to new ones.</summary>
    public void Recall(Span<ContactRow> rows)
    {
        foreach (ref var row in rows)
        {
            row.NormalImpulse = 0;
            row.FrictionImpulse = Vector.Zero;
            row.TurnImpulse = Vector.Zero;
            var index = Array.BinarySearch(_keys, 0, _count, row.Key);
            if (index < 0)
            {
                continue;
            }

            while (index > 0 && _keys[index - 1] == row.Key)
            {
                index--;
            }

            for (; index < _count && _keys[index] == row.Key; index++)
            {
                if (Vector.Dot(_entries[index].Normal, row.Normal) >= MinCosine)
                {
                    row.NormalImpulse = _entries[index].NormalImpulse;
                    row.FrictionImpulse = _entries[index].FrictionImpulse;
                    row.TurnImpulse = _entries[index].TurnImpulse;
                    break;
                }
            }
        }
    }

    /// <summary>Stores the impulses of all contacts.</summary>
    public void Store(ContactGraph graph)
    {
        _count = graph.RowCount;
        if (_keys.Length < _count)
        {
            _keys = new long[2 * _count];
            _entries = new Entry[2 * _count];
        }

        for (var i = 0; i < _count; i++)
        {
            ref var row = ref graph.Row(i);
            _keys[i] = row.Key;
            _entries[i] = new()
            {
                Normal = row.Normal, NormalImpulse = row.NormalImpulse,
                FrictionImpulse = row.FrictionImpulse, TurnImpulse = row.TurnImpulse,
            };
        }

        Array.Sort(_keys, _entries, 0, _count);
    }

    /// <summary>Discards the impulses of all contacts.</summary>
    public void Clear() => _count = 0;

    private struct Entry
    {
        public Vector Normal;
        public double NormalImpulse;
        public Vector FrictionImpulse;
        public Vector TurnImpulse;
    }
}
