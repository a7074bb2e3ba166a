using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>
/// Which bodies are near: a hashed grid of cells as wide as most bodies. Those that are wider than a cell are kept apart, and always near. Follows bodies as they move;
/// allocates only when bodies are added.
/// </summary>
internal sealed class BodyGrid
{
    private readonly List<int> _large = [];
    private int[] _heads = [];
    private int[] _next = [];
    private int[] _previous = [];
    private int[] _cells = [];
    private double _cellSize = 1;
    private double _largestRadius;
    private List<Body> _bodies = [];

    /// <summary>Begins with other bodies, or with more. O(n·log n).</summary>
    public void Build(List<Body> bodies)
    {
        _bodies = bodies;
        _large.Clear();
        var length = 16;
        while (length < 2 * bodies.Count)
        {
            length *= 2;
        }

        (_heads, _next, _previous, _cells) = (new int[length], new int[bodies.Count], new int[bodies.Count], new int[bodies.Count]);
        Array.Fill(_heads, -1);
        if (bodies.Count == 0)
        {
            return;
        }

        var radii = bodies.Select(body => body.Radius).Order().ToArray();
        // Nine of ten bodies fit.
        _cellSize = 3 * radii[9 * (radii.Length - 1) / 10];
        _largestRadius = 0;
        for (var i = 0; i < bodies.Count; i++)
        {
            if (2 * bodies[i].Radius > _cellSize)
            {
                _large.Add(i);
                _cells[i] = -1;
            }
            else
            {
                _largestRadius = Math.Max(_largestRadius, bodies[i].Radius);
                Insert(i, CellOf(bodies[i].Position));
            }
        }
    }

    /// <summary>Follows a body that has moved.</summary>
    public void Update(int index)
    {
        if (_cells[index] < 0)
        {
            return;
        }

        var cell = CellOf(_bodies[index].Position);
        if (cell != _cells[index])
        {
            Remove(index);
            Insert(index, cell);
        }
    }

    /// <summary>Collects the bodies that a ball can meet on its way.</summary>
    /// <param name="way">A box that holds the way of its centre.</param>
    /// <param name="radius">Of the ball.</param>
    /// <param name="except">The ball itself, −1 for none.</param>
    /// <param name="found">Receives their numbers, in no particular but always the same order.</param>
    public void Collect(in BoundingBox way, double radius, int except, List<int> found)
    {
        foreach (var index in _large)
        {
            Add(index, in way, radius, except, found);
        }

        var wide = (radius + _largestRadius) * Vector.One;
        var (minimum, maximum) = (Cell(way.Minimum - wide), Cell(way.Maximum + wide));
        var count = (maximum.X - minimum.X + 1.0) * (maximum.Y - minimum.Y + 1.0) * (maximum.Z - minimum.Z + 1.0);
        if (!(count <= _bodies.Count))
        {
            // More cells than bodies.
            for (var i = 0; i < _bodies.Count; i++)
            {
                if (_cells[i] >= 0)
                {
                    Add(i, in way, radius, except, found);
                }
            }

            return;
        }

        for (var x = minimum.X; x <= maximum.X; x++)
        {
            for (var y = minimum.Y; y <= maximum.Y; y++)
            {
                for (var z = minimum.Z; z <= maximum.Z; z++)
                {
                    for (var i = _heads[Hash(x, y, z)]; i >= 0; i = _next[i])
                    {
                        // Other cells may have the same hash.
                        if (Cell(_bodies[i].Position) == (x, y, z))
                        {
                            Add(i, in way, radius, except, found);
                        }
                    }
                }
            }
        }
    }

    private void Add(int index, in BoundingBox way, double radius, int except, List<int> found)
    {
        var distance = radius + _bodies[index].Radius;
        if (index != except && way.DistanceSquared(_bodies[index].Position) <= distance * distance)
        {
            found.Add(index);
        }
    }

    private (long X, long Y, long Z) Cell(Vector position) => (Cell(position.X), Cell(position.Y), Cell(position.Z));

    // Saturates: bodies far away share a cell.
    private long Cell(double coordinate) => (long)Math.Clamp(Math.Floor(coordinate / _cellSize), -1e15, 1e15);

    private int CellOf(Vector position) => Cell(position) switch { var (x, y, z) => Hash(x, y, z) };

    private int Hash(long x, long y, long z) =>
        (int)(((ulong)((x * 73856093) ^ (y * 19349663) ^ (z * 83492791)) * 0x9E3779B97F4A7C15) >> 40) & (_heads.Length - 1);

    private void Insert(int index, int cell)
    {
        var first = _heads[cell];
        (_cells[index], _next[index], _previous[index], _heads[cell]) = (cell, first, -1, index);
        if (first >= 0)
        {
            _previous[first] = index;
        }
    }

    private void Remove(int index)
    {
        var (next, previous) = (_next[index], _previous[index]);
        if (previous >= 0)
        {
            _next[previous] = next;
        }
        else
        {
            _heads[_cells[index]] = next;
        }

        if (next >= 0)
        {
            _previous[next] = previous;
        }
    }
}
