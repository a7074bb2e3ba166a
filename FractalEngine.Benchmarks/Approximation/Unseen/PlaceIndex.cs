using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Finds what was put within a small distance of a place, by a hash of cells that are some times as wide.</summary>
internal sealed class PlaceIndex(double tolerance)
{
    private readonly double _cell = 16 * tolerance;
    private readonly Dictionary<(long X, long Y, long Z), int> _first = [];
    private readonly List<(int Value, Vector Position, int Next)> _entries = [];

    /// <summary>Puts a value at a place.</summary>
    public void Add(Vector position, int value)
    {
        var (x, y, z) = position;
        ref var first = ref CollectionsMarshal.GetValueRefOrAddDefault(_first, (Cell(x), Cell(y), Cell(z)), out var exists);
        _entries.Add((value, position, exists ? first : -1));
        first = _entries.Count - 1;
    }

    /// <summary>Lists the values at places within the tolerance, in an order that depends on what was put only.</summary>
    public List<int> Near(Vector position)
    {
        var values = new List<int>();
        for (var x = Cell(position.X - tolerance); x <= Cell(position.X + tolerance); x++)
        {
            for (var y = Cell(position.Y - tolerance); y <= Cell(position.Y + tolerance); y++)
            {
                for (var z = Cell(position.Z - tolerance); z <= Cell(position.Z + tolerance); z++)
                {
                    AddNear(values, (x, y, z), position);
                }
            }
        }

        return values;
    }

    private void AddNear(List<int> values, (long X, long Y, long Z) cell, Vector position)
    {
        if (!_first.TryGetValue(cell, out var entry))
        {
            return;
        }

        while (entry >= 0)
        {
            var (value, other, next) = _entries[entry];
            if ((other - position).LengthSquared() <= tolerance * tolerance)
            {
                values.Add(value);
            }

            entry = next;
        }
    }

    private long Cell(double coordinate) => _cell > 0 ? (long)Math.Floor(coordinate / _cell) : 0;
}
