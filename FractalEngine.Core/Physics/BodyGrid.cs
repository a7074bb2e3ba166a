using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>
/// Which bodies are near: a hashed grid of cells as wide as most bodies. Those that are wider than a cell are kept apart, and always near.
/// Follows bodies as they move; allocates only when bodies are added.
/// </summary>
internal sealed class BodyGrid
{
    private readonly List<int> _largeBodies = [];
    private int[] _heads = [];
    private int[] _next = [];
    private int[] _previous = [];
    private int[] _buckets = [];
    private double _cellSize = 1;
    private double _maxGridRadius;
    private List<Body> _bodies = [];

    /// <summary>Begins with other bodies, or with more. O(n·log n).</summary>
    public void Build(List<Body> bodies)
    {
        _bodies = bodies;
        _largeBodies.Clear();
        var bucketCount = 16;
        while (bucketCount < 2 * bodies.Count)
        {
            bucketCount *= 2;
        }

        (_heads, _next, _previous, _buckets) = (new int[bucketCount], new int[bodies.Count], new int[bodies.Count], new int[bodies.Count]);
        Array.Fill(_heads, -1);
        if (bodies.Count == 0)
        {
            return;
        }

        var radii = bodies.Select(body => body.Radius).Order().ToArray();
        // Nine of ten bodies fit.
        _cellSize = 3 * radii[9 * (radii.Length - 1) / 10];
        _maxGridRadius = 0;
        for (var i = 0; i < bodies.Count; i++)
        {
            if (2 * bodies[i].Radius > _cellSize)
            {
                _largeBodies.Add(i);
                _buckets[i] = -1;
            }
            else
            {
                _maxGridRadius = Math.Max(_maxGridRadius, bodies[i].Radius);
                Insert(i, BucketOf(bodies[i].Position));
            }
        }
    }

    /// <summary>Follows a body that has moved.</summary>
    public void Update(int index)
    {
        if (_buckets[index] < 0)
        {
            return;
        }

        var bucket = BucketOf(_bodies[index].Position);
        if (bucket != _buckets[index])
        {
            Remove(index);
            Insert(index, bucket);
        }
    }

    /// <summary>Collects the bodies that a ball can meet on its way.</summary>
    /// <param name="pathBounds">A box that holds the way of its centre.</param>
    /// <param name="radius">Of the ball.</param>
    /// <param name="excludedIndex">The ball itself, −1 for none.</param>
    /// <param name="results">Receives their numbers, in no particular but always the same order.</param>
    public void CollectOverlaps(in BoundingBox pathBounds, double radius, int excludedIndex, List<int> results)
    {
        foreach (var index in _largeBodies)
        {
            AddIfOverlapping(index, in pathBounds, radius, excludedIndex, results);
        }

        var margin = (radius + _maxGridRadius) * Vector.One;
        var (minCell, maxCell) = (CellAt(pathBounds.Minimum - margin), CellAt(pathBounds.Maximum + margin));
        var cellCount = (maxCell.X - minCell.X + 1.0) * (maxCell.Y - minCell.Y + 1.0) * (maxCell.Z - minCell.Z + 1.0);
        if (!(cellCount <= _bodies.Count))
        {
            // More cells than bodies.
            for (var i = 0; i < _bodies.Count; i++)
            {
                if (_buckets[i] >= 0)
                {
                    AddIfOverlapping(i, in pathBounds, radius, excludedIndex, results);
                }
            }

            return;
        }

        for (var x = minCell.X; x <= maxCell.X; x++)
        {
            for (var y = minCell.Y; y <= maxCell.Y; y++)
            {
                for (var z = minCell.Z; z <= maxCell.Z; z++)
                {
                    for (var i = _heads[Hash(x, y, z)]; i >= 0; i = _next[i])
                    {
                        // Other cells may have the same hash.
                        if (CellAt(_bodies[i].Position) == (x, y, z))
                        {
                            AddIfOverlapping(i, in pathBounds, radius, excludedIndex, results);
                        }
                    }
                }
            }
        }
    }

    private void AddIfOverlapping(int index, in BoundingBox pathBounds, double radius, int excludedIndex, List<int> results)
    {
        var maxDistance = radius + _bodies[index].Radius;
        if (index != excludedIndex && pathBounds.DistanceSquared(_bodies[index].Position) <= maxDistance * maxDistance)
        {
            results.Add(index);
        }
    }

    private (long X, long Y, long Z) CellAt(Vector position) => (CellAt(position.X), CellAt(position.Y), CellAt(position.Z));

    // Saturates: bodies far away share a cell.
    private long CellAt(double coordinate) => (long)Math.Clamp(Math.Floor(coordinate / _cellSize), -1e15, 1e15);

    private int BucketOf(Vector position) => CellAt(position) switch { var (x, y, z) => Hash(x, y, z) };

    private int Hash(long x, long y, long z) =>
        (int)(((ulong)((x * 73856093) ^ (y * 19349663) ^ (z * 83492791)) * 0x9E3779B97F4A7C15) >> 40) & (_heads.Length - 1);

    private void Insert(int index, int bucket)
    {
        var head = _heads[bucket];
        (_buckets[index], _next[index], _previous[index], _heads[bucket]) = (bucket, head, -1, index);
        if (head >= 0)
        {
            _previous[head] = index;
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
            _heads[_buckets[index]] = next;
        }

        if (next >= 0)
        {
            _previous[next] = previous;
        }
    }
}
