using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>
/// Finds bodies near a path: a hashed grid of cells wide enough for most bodies. Those wider than a cell are kept in a list and always
/// tested. Allocates only when bodies are added.
/// </summary>
internal sealed class BodyGrid
{
    // Of the number of bodies: at least twice as many buckets, and a power of two of them, for a cheap remainder.
    private const int BucketsPerBody = 2;
    private const int MinBuckets = 16;

    // Of the radius of the body that is larger than nine tenths of all: it fits into a cell with half its size to spare.
    private const double CellSizeFactor = 3;

    // Beyond it, cell coordinates saturate: bodies so far away share a cell.
    private const double MaxCellCoordinate = 1e15;

    // Marks a large body, which is in no bucket, and the end of a bucket's chain.
    private const int None = -1;

    private readonly List<int> _largeBodies = [];
    private int[] _heads = [];
    private int[] _next = [];
    private int[] _previous = [];
    private int[] _buckets = [];
    private double _cellSize = 1;
    private double _maxGridRadius;
    private List<Body> _bodies = [];

    /// <summary>Builds the grid anew for all bodies. Cost O(n·log n).</summary>
    public void Build(List<Body> bodies)
    {
        _bodies = bodies;
        _largeBodies.Clear();
        var bucketCount = MinBuckets;
        while (bucketCount < BucketsPerBody * bodies.Count)
        {
            bucketCount *= 2;
        }

        _heads = new int[bucketCount];
        _next = new int[bodies.Count];
        _previous = new int[bodies.Count];
        _buckets = new int[bodies.Count];
        Array.Fill(_heads, None);
        if (bodies.Count == 0)
        {
            return;
        }

        var radii = bodies.Select(body => body.Radius).Order().ToArray();
        _cellSize = CellSizeFactor * radii[9 * (radii.Length - 1) / 10];
        _maxGridRadius = 0;
        for (var i = 0; i < bodies.Count; i++)
        {
            if (2 * bodies[i].Radius > _cellSize)
            {
                _largeBodies.Add(i);
                _buckets[i] = None;
            }
            else
            {
                _maxGridRadius = Math.Max(_maxGridRadius, bodies[i].Radius);
                Insert(i, BucketOf(bodies[i].Position));
            }
        }
    }

    /// <summary>Updates the cell of a body that has moved.</summary>
    public void Update(int index)
    {
        if (_buckets[index] == None)
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

    /// <summary>Collects the bodies that a moving sphere may meet.</summary>
    /// <param name="pathBounds">Box that holds the path of its centre.</param>
    /// <param name="radius">Radius of the sphere, scene units.</param>
    /// <param name="excludedIndex">Index of the sphere itself, or <see cref="Contact.NoBody"/>.</param>
    /// <param name="results">Receives the indices, in no particular order, but always in the same.</param>
    public void CollectOverlaps(in BoundingBox pathBounds, double radius, int excludedIndex, List<int> results)
    {
        foreach (var index in _largeBodies)
        {
            AddIfOverlapping(index, in pathBounds, radius, excludedIndex, results);
        }

        var margin = (radius + _maxGridRadius) * Vector.One;
        var minCell = CellAt(pathBounds.Minimum - margin);
        var maxCell = CellAt(pathBounds.Maximum + margin);
        var cellCount = (maxCell.X - minCell.X + 1.0) * (maxCell.Y - minCell.Y + 1.0) * (maxCell.Z - minCell.Z + 1.0);
        if (!(cellCount <= _bodies.Count))
        {
            CollectFromAllBodies(in pathBounds, radius, excludedIndex, results);
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

    private void CollectFromAllBodies(in BoundingBox pathBounds, double radius, int excludedIndex, List<int> results)
    {
        for (var i = 0; i < _bodies.Count; i++)
        {
            if (_buckets[i] != None)
            {
                AddIfOverlapping(i, in pathBounds, radius, excludedIndex, results);
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

    private (long X, long Y, long Z) CellAt(Vector position) =>
        (CellCoordinate(position.X), CellCoordinate(position.Y), CellCoordinate(position.Z));

    private long CellCoordinate(double coordinate) =>
        (long)Math.Clamp(Math.Floor(coordinate / _cellSize), -MaxCellCoordinate, MaxCellCoordinate);

    private int BucketOf(Vector position)
    {
        var (x, y, z) = CellAt(position);
        return Hash(x, y, z);
    }

    // Three primes spread the coordinates; a multiplication by 2^64 divided by the golden ratio mixes the bits.
    private int Hash(long x, long y, long z) =>
        (int)(((ulong)((x * 73856093) ^ (y * 19349663) ^ (z * 83492791)) * 0x9E3779B97F4A7C15) >> 40) & (_heads.Length - 1);

    private void Insert(int index, int bucket)
    {
        var head = _heads[bucket];
        _buckets[index] = bucket;
        _next[index] = head;
        _previous[index] = None;
        _heads[bucket] = index;
        if (head >= 0)
        {
            _previous[head] = index;
        }
    }

    private void Remove(int index)
    {
        var next = _next[index];
        var previous = _previous[index];
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
