using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// Finds the bodies near a sphere at one moment: they are sorted by cells, so that a search reads them in the order of memory, four at
/// once. It finds what a <see cref="BodyGrid"/> finds, which follows each body from cell to cell instead.
/// </summary>
internal sealed class NeighbourGrid
{
    // Relative to the largest radius: cells are short along x, since those of one line are read as one range.
    private const double CellLength = 1;
    private const double CellWidth = 3;

    // Bodies farther apart than so many cells a body share too few of them: then each is searched for in the hashed grid.
    private const int MaxCellsPerBody = 16;
    private const int MinCells = 4096;

    private int[] _starts = [];
    private int[] _indices = [];
    private int[] _cells = [];
    private double[] _x = [];
    private double[] _y = [];
    private double[] _z = [];
    private double[] _radii = [];
    private Vector _origin;
    private double _maxRadius;
    private (int X, int Y, int Z) _size;

    /// <summary>True where the last bodies were few cells apart, so that they can be searched.</summary>
    public bool IsBuilt { get; private set; }

    /// <summary>Makes room for the bodies of a world.</summary>
    public void Reserve(int bodyCount)
    {
        // Four are read at once, beyond the last one.
        var capacity = bodyCount + Vector256<double>.Count;
        _starts = new int[Math.Max(MinCells, MaxCellsPerBody * bodyCount) + 1];
        _indices = new int[capacity];
        _cells = new int[capacity];
        _x = new double[capacity];
        _y = new double[capacity];
        _z = new double[capacity];
        _radii = new double[capacity];
    }

    /// <summary>Sorts bodies by cells. Room must have been made for them.</summary>
    /// <param name="bodies">The bodies; none where they cannot be searched in cells.</param>
    /// <param name="bounds">Box of their centres, and their largest radius.</param>
    public void Build(ReadOnlySpan<GraphBody> bodies, in GridBounds bounds)
    {
        IsBuilt = TryLayOut(bodies.Length, in bounds);
        if (!IsBuilt)
        {
            return;
        }

        var starts = _starts.AsSpan(0, (_size.X * _size.Y * _size.Z) + 1);
        starts.Clear();
        for (var i = 0; i < bodies.Length; i++)
        {
            var offset = bodies[i].Position - _origin;
            _cells[i] = CellAt(LengthCell(offset.X), WidthCell(offset.Y, _size.Y), WidthCell(offset.Z, _size.Z));
            starts[_cells[i]]++;
        }

        var end = 0;
        foreach (ref var start in starts)
        {
            end += start;
            start = end;
        }

        for (var i = bodies.Length - 1; i >= 0; i--)
        {
            var place = --starts[_cells[i]];
            _indices[place] = i;
            _x[place] = bodies[i].Position.X;
            _y[place] = bodies[i].Position.Y;
            _z[place] = bodies[i].Position.Z;
            _radii[place] = bodies[i].Radius;
        }
    }

    /// <summary>Collects all bodies that a sphere overlaps. Only where <see cref="IsBuilt"/>; many threads may do so at once.</summary>
    /// <param name="centre">Its centre, world space.</param>
    /// <param name="radius">Its radius, scene units.</param>
    /// <param name="excludedIndex">Index of a body that is left out.</param>
    /// <param name="results">Receives the indices, in no particular order, but always in the same.</param>
    public void CollectOverlaps(Vector centre, double radius, int excludedIndex, List<int> results)
    {
        var offset = centre - _origin;
        var reach = radius + _maxRadius;
        var (minX, maxX) = (LengthCell(offset.X - reach), LengthCell(offset.X + reach));
        var (minY, maxY) = (WidthCell(offset.Y - reach, _size.Y), WidthCell(offset.Y + reach, _size.Y));
        var (minZ, maxZ) = (WidthCell(offset.Z - reach, _size.Z), WidthCell(offset.Z + reach, _size.Z));
        for (var z = minZ; z <= maxZ; z++)
        {
            for (var y = minY; y <= maxY; y++)
            {
                CollectOverlaps(_starts[CellAt(minX, y, z)], _starts[CellAt(maxX, y, z) + 1], centre, radius, excludedIndex, results);
            }
        }
    }

    private void CollectOverlaps(int start, int end, Vector centre, double radius, int excludedIndex, List<int> results)
    {
        var (x, y, z) = (Vector256.Create(centre.X), Vector256.Create(centre.Y), Vector256.Create(centre.Z));
        var radii = Vector256.Create(radius);
        for (var i = start; i < end; i += Vector256<double>.Count)
        {
            var differenceX = Vector256.LoadUnsafe(ref _x[i]) - x;
            var differenceY = Vector256.LoadUnsafe(ref _y[i]) - y;
            var differenceZ = Vector256.LoadUnsafe(ref _z[i]) - z;
            var distances = radii + Vector256.LoadUnsafe(ref _radii[i]);
            var squared = (differenceX * differenceX) + (differenceY * differenceY) + (differenceZ * differenceZ);
            var overlapping = Vector256.LessThanOrEqual(squared, distances * distances).ExtractMostSignificantBits();
            for (; overlapping != 0; overlapping &= overlapping - 1)
            {
                var place = i + System.Numerics.BitOperations.TrailingZeroCount(overlapping);
                if (place < end && _indices[place] != excludedIndex)
                {
                    results.Add(_indices[place]);
                }
            }
        }
    }

    /// <summary>Finds how many cells hold all bodies.</summary>
    private bool TryLayOut(int bodyCount, in GridBounds bounds)
    {
        if (bodyCount == 0)
        {
            return false;
        }

        _maxRadius = bounds.MaxRadius;
        _origin = bounds.Min;
        var extent = (1 / _maxRadius) * (bounds.Max - bounds.Min);
        var (x, y, z) = (Math.Floor(extent.X / CellLength) + 1, Math.Floor(extent.Y / CellWidth) + 1, Math.Floor(extent.Z / CellWidth) + 1);
        if (!(x * y * z < Math.Max(MinCells, MaxCellsPerBody * bodyCount)))
        {
            return false;
        }

        _size = ((int)x, (int)y, (int)z);
        return true;
    }

    private int LengthCell(double offset) => (int)Math.Clamp(offset / (CellLength * _maxRadius), 0, _size.X - 1);

    private int WidthCell(double offset, int count) => (int)Math.Clamp(offset / (CellWidth * _maxRadius), 0, count - 1);

    private int CellAt(int x, int y, int z) => (((z * _size.Y) + y) * _size.X) + x;
}
