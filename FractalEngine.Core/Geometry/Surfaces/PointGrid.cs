using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Surfaces;

/// <summary>Finds the points within a fixed tolerance of a position, by hashing of grid cells.</summary>
/// <remarks>
/// Cells are much larger than the tolerance, and a point near the side of a cell is stored in all cells that it may be asked from. So a
/// look-up reads one cell. Memory is about 20 bytes a point; building is O(points).
/// </remarks>
internal sealed class PointGrid
{
    private const double CellsPerTolerance = 1.0 / 16;

    private readonly List<(int Point, int Next, long Cell)> _entries;
    private readonly int[] _heads;
    private readonly IReadOnlyList<Vector> _points;
    private readonly Vector _origin;
    // The reciprocal of a tiny one is infinite.
    private readonly double _cellSize;
    private readonly double _tolerance;

    /// <summary>Stores points by their index.</summary>
    /// <param name="points">Scene units; must not change afterwards.</param>
    /// <param name="tolerance">Largest distance at which a point is found, above 0.</param>
    /// <param name="isEmpty">Whether only those points are found that are added afterwards.</param>
    public PointGrid(IReadOnlyList<Vector> points, double tolerance, bool isEmpty = false)
    {
        _points = points;
        _tolerance = tolerance;
        _cellSize = tolerance / CellsPerTolerance;
        // So that the numbers of cells fit also far from the origin.
        _origin = points.Count == 0 ? Vector.Zero : points[0] / _cellSize;
        _entries = new(points.Count);
        _heads = new int[(int)System.Numerics.BitOperations.RoundUpToPowerOf2((uint)Math.Max(16, points.Count))];
        Array.Fill(_heads, -1);
        for (var point = 0; point < points.Count && !isEmpty; point++)
        {
            Add(point);
        }
    }

    /// <summary>Begins a look-up: the first entry near a position, or −1.</summary>
    public int First(Vector position)
    {
        var cell = CellOf(position);
        return Advance(_heads[Bucket(cell)], cell, position);
    }

    /// <summary>Continues a look-up: the entry after another near the same position, or −1.</summary>
    public int Next(int entry, Vector position) => Advance(_entries[entry].Next, CellOf(position), position);

    /// <summary>The index of an entry's point.</summary>
    public int PointOf(int entry) => _entries[entry].Point;

    /// <summary>The number of a cell; cells with the same number only cost a comparison more.</summary>
    private static long Hash(double x, double y, double z) => unchecked(
        ((long)Math.Floor(x) * 73856093L * 0x9E3779B97F4A7L)
        ^ ((long)Math.Floor(y) * 19349663L * 0x517CC1B7L)
        ^ ((long)Math.Floor(z) * 83492791L));

    /// <summary>Stores one of the points, so that it is found.</summary>
    /// <param name="point">Its index.</param>
    public void Add(int point)
    {
        var p = (_points[point] / _cellSize) - _origin;
        const double Reach = 1.001 * CellsPerTolerance;
        var cells = (Span<long>)stackalloc long[8];
        var count = 0;
        for (var corner = 0; corner < 8; corner++)
        {
            var cell = Hash(
                p.X + ((corner & 1) == 0 ? -Reach : Reach),
                p.Y + ((corner & 2) == 0 ? -Reach : Reach),
                p.Z + ((corner & 4) == 0 ? -Reach : Reach));
            if (!cells[..count].Contains(cell))
            {
                cells[count++] = cell;
                ref var head = ref _heads[Bucket(cell)];
                _entries.Add((point, head, cell));
                head = _entries.Count - 1;
            }
        }
    }

    private int Advance(int entry, long cell, Vector position)
    {
        for (; entry >= 0; entry = _entries[entry].Next)
        {
            var (point, _, stored) = _entries[entry];
            if (stored == cell && (_points[point] - position).LengthSquared() <= _tolerance * _tolerance)
            {
                return entry;
            }
        }

        return -1;
    }

    private long CellOf(Vector position)
    {
        var (x, y, z) = (position / _cellSize) - _origin;
        return Hash(x, y, z);
    }

    private int Bucket(long cell) => (int)((ulong)(cell * unchecked((long)0x9E3779B97F4A7C15UL)) >> 33) & (_heads.Length - 1);
}
