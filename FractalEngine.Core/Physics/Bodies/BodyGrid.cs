using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>
/// Finds bodies near a path: a hashed grid of cells wide enough for most bodies. Those wider than a cell are kept in a list and always
/// tested. Allocates only when bodies are added.
/// </summary>
/// <remarks>
/// The grid has a copy of each body's position and radius, since a search visits many bodies once, and would wait for the memory of each.
/// </remarks>
internal sealed class BodyGrid
{
    // A power of two of them, for a cheap remainder. Most cells are empty, and should not share a bucket with one that is not.
    private const int BucketsPerBody = 8;
    private const int MinBuckets = 16;

    // Relative to the radius of the body that is larger than nine tenths of all: what falls fast crosses few cells in a step.
    private const double CellSizeFactor = 4;

    // Beyond it, cell coordinates saturate: bodies so far away share a cell.
    private const double MaxCellCoordinate = 1e15;

    // Marks a large body, which is in no bucket, and the end of a bucket's chain.
    private const int None = -1;

    private int[] _heads = [];
    private Entry[] _entries = [];
    private double _cellSize = 1;
    private double _maxGridRadius;
    private List<Body> _bodies = [];

    /// <summary>Changes whenever a body enters another cell, or the grid is built: what was collected before may be out of date.</summary>
    public long Version { get; private set; }

    /// <summary>The bodies that are in no cell, since they are wider than one.</summary>
    public List<int> LargeBodies { get; } = [];

    /// <summary>Builds the grid anew for all bodies. Cost O(n·log n).</summary>
    public void Build(List<Body> bodies)
    {
        Version++;
        _bodies = bodies;
        LargeBodies.Clear();
        var bucketCount = MinBuckets;
        while (bucketCount < BucketsPerBody * bodies.Count)
        {
            bucketCount *= 2;
        }

        _heads = new int[bucketCount];
        _entries = new Entry[bodies.Count];
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
            _entries[i] = CreateEntry(bodies[i]);
            if (2 * bodies[i].Radius > _cellSize)
            {
                LargeBodies.Add(i);
            }
            else
            {
                _maxGridRadius = Math.Max(_maxGridRadius, bodies[i].Radius);
                Insert(i);
            }
        }
    }

    /// <summary>Updates position and radius of a body that is still in its cell. Many threads may do so at once.</summary>
    /// <returns>False for one that is in another cell now; nothing is changed then.</returns>
    public bool TryUpdateWithinCell(int index)
    {
        ref var entry = ref _entries[index];
        var position = _bodies[index].Position;
        if (entry.Bucket != None && CellAt(position) != entry.Cell)
        {
            return false;
        }

        entry.Position = position;
        entry.Radius = _bodies[index].Radius;
        return true;
    }

    /// <summary>Updates position, radius and cell of a body that has moved.</summary>
    public void Update(int index)
    {
        if (TryUpdateWithinCell(index))
        {
            return;
        }

        Version++;
        Remove(index);
        _entries[index] = CreateEntry(_bodies[index]);
        Insert(index);
    }

    /// <summary>Finds the cells of all bodies that a moving sphere may meet.</summary>
    /// <param name="pathBounds">Box that holds the path of its centre.</param>
    /// <param name="radius">Radius of the sphere, scene units.</param>
    public CellRange CellsAround(in BoundingBox pathBounds, double radius)
    {
        var margin = (radius + _maxGridRadius) * Vector.One;
        return new(CellAt(pathBounds.Minimum - margin), CellAt(pathBounds.Maximum + margin));
    }

    /// <summary>Collects all bodies of some cells.</summary>
    /// <param name="cells">The cells.</param>
    /// <param name="results">Receives the indices: cell by cell in the order of their coordinates, the last to enter a cell first.</param>
    /// <returns>False where that would take longer than to test all bodies: then nothing is collected.</returns>
    public bool TryCollect(in CellRange cells, List<int> results) =>
        TryCollect(in cells, Vector.Zero, double.PositiveInfinity, None, results);

    /// <summary>Collects all bodies of cells that a sphere overlaps.</summary>
    /// <param name="centre">Its centre, world space.</param>
    /// <param name="radius">Its radius, scene units.</param>
    /// <param name="excludedIndex">Index of a body that is left out.</param>
    /// <param name="results">Receives the indices, in no particular order, but always in the same.</param>
    /// <returns>False where that would take longer than to test all bodies: then nothing is collected.</returns>
    public bool TryCollectOverlaps(Vector centre, double radius, int excludedIndex, List<int> results) =>
        TryCollect(CellsAround(new(centre, centre), radius), centre, radius, excludedIndex, results);

    private bool TryCollect(in CellRange cells, Vector centre, double radius, int excludedIndex, List<int> results)
    {
        if (!(cells.Count <= _bodies.Count))
        {
            return false;
        }

        var entries = _entries;
        var (min, max) = cells;
        for (var x = min.X; x <= max.X; x++)
        {
            for (var y = min.Y; y <= max.Y; y++)
            {
                for (var z = min.Z; z <= max.Z; z++)
                {
                    for (var i = _heads[Hash(x, y, z)]; i >= 0; i = entries[i].Next)
                    {
                        ref readonly var entry = ref entries[i];
                        var maxDistance = radius + entry.Radius;
                        // Other cells may have the same hash.
                        if ((entry.Position - centre).LengthSquared() <= maxDistance * maxDistance
                            && entry.Cell.X == x && entry.Cell.Y == y && entry.Cell.Z == z && i != excludedIndex)
                        {
                            results.Add(i);
                        }
                    }
                }
            }
        }

        return true;
    }

    /// <summary>Collects all bodies of all cells, in the order of their indices.</summary>
    public void CollectAll(List<int> results)
    {
        for (var i = 0; i < _entries.Length; i++)
        {
            if (_entries[i].Bucket != None)
            {
                results.Add(i);
            }
        }
    }

    /// <summary>Tells whether a body is in one of some cells.</summary>
    /// <param name="index">Index of a body that is in a cell.</param>
    /// <param name="cells">The cells.</param>
    public bool IsWithin(int index, in CellRange cells) => cells.Contains(in _entries[index].Cell);

    /// <summary>Tells whether a moving sphere may meet a body.</summary>
    /// <param name="index">Index of the body.</param>
    /// <param name="pathBounds">Box that holds the path of the sphere's centre.</param>
    /// <param name="radius">Radius of the sphere, scene units.</param>
    public bool Overlaps(int index, in BoundingBox pathBounds, double radius)
    {
        ref readonly var entry = ref _entries[index];
        var maxDistance = radius + entry.Radius;
        return pathBounds.DistanceSquared(entry.Position) <= maxDistance * maxDistance;
    }

    private Cell CellAt(Vector position) => new(CellCoordinate(position.X), CellCoordinate(position.Y), CellCoordinate(position.Z));

    private long CellCoordinate(double coordinate) =>
        (long)Math.Clamp(Math.Floor(coordinate / _cellSize), -MaxCellCoordinate, MaxCellCoordinate);

    private Entry CreateEntry(Body body) =>
        new() { Position = body.Position, Radius = body.Radius, Cell = CellAt(body.Position), Bucket = None };

    // Three primes spread the coordinates; a multiplication by 2^64 divided by the golden ratio mixes the bits.
    private int Hash(long x, long y, long z) =>
        (int)(((ulong)((x * 73856093) ^ (y * 19349663) ^ (z * 83492791)) * 0x9E3779B97F4A7C15) >> 40) & (_heads.Length - 1);

    private void Insert(int index)
    {
        ref var entry = ref _entries[index];
        entry.Bucket = Hash(entry.Cell.X, entry.Cell.Y, entry.Cell.Z);
        entry.Next = _heads[entry.Bucket];
        _heads[entry.Bucket] = index;
    }

    private void Remove(int index)
    {
        // No longer than a search of the cell takes.
        ref var link = ref _heads[_entries[index].Bucket];
        while (link != index)
        {
            link = ref _entries[link].Next;
        }

        link = _entries[index].Next;
    }

    /// <summary>Integer coordinates of a cell.</summary>
    internal readonly record struct Cell(long X, long Y, long Z);

    /// <summary>All cells between two corners.</summary>
    /// <param name="Min">The cell with the smallest coordinates.</param>
    /// <param name="Max">The cell with the largest coordinates.</param>
    internal readonly record struct CellRange(Cell Min, Cell Max)
    {
        /// <summary>Number of cells; a double, since it may exceed a long.</summary>
        public double Count => (Max.X - Min.X + 1.0) * (Max.Y - Min.Y + 1.0) * (Max.Z - Min.Z + 1.0);

        /// <summary>Tells whether a cell is one of these.</summary>
        public bool Contains(in Cell cell) =>
            cell.X >= Min.X && cell.X <= Max.X && cell.Y >= Min.Y && cell.Y <= Max.Y && cell.Z >= Min.Z && cell.Z <= Max.Z;

        /// <summary>Tells whether all cells of another range are among these.</summary>
        public bool Contains(in CellRange other) => Contains(other.Min) && Contains(other.Max);
    }

    /// <summary>What a search needs of a body: 64 bytes, a line of the cache.</summary>
    private struct Entry
    {
        public Vector Position;
        public double Radius;
        public Cell Cell;
        public int Bucket;
        public int Next;
    }
}
