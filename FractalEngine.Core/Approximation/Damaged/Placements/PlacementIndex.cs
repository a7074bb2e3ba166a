using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged.Placements;

/// <summary>Finds which placed element is nearest to a placement, among those of a class, of about the same size and place.</summary>
/// <remarks>Grids of all sizes, hashed: a look-up reads at most 8 cells of two grids. Placements are equal up to symmetries.</remarks>
internal sealed class PlacementIndex(IReadOnlyList<ElementTemplate> templates, double relativeTolerance, double tolerance)
{
    // Cells are as large as elements; a look-up must not reach beyond the next one.
    private const double MaxReach = 0.45;

    // Normals of flat elements are those of similarities: they only tell from which side an element is seen.
    private const double NormalWeight = 1e-8;

    // So many cells away, their numbers are no integers.
    private const double MaxCell = 1e15;

    private readonly Dictionary<(int Class, int Level, long X, long Y, long Z), List<int>> _cells = [];
    private readonly List<(int Class, AffineMap Placement)> _placements = [];
    private readonly List<int> _symmetryCounts = [];

    /// <summary>Number of placements in the index.</summary>
    public int Count => _placements.Count;

    /// <summary>A placement, by its index.</summary>
    public (int Class, AffineMap Placement) this[int index] => _placements[index];

    /// <summary>Adds a placement, and returns its index.</summary>
    public int Add(int elementClass, AffineMap placement)
    {
        var level = Math.ILogB(PlacedElement.SizeOf(placement));
        var p = Math.ScaleB(1, -level) * placement.Translation;
        var key = (elementClass, level, (long)Math.Floor(p.X), (long)Math.Floor(p.Y), (long)Math.Floor(p.Z));
        (CollectionsMarshal.GetValueRefOrAddDefault(_cells, key, out _) ??= []).Add(_placements.Count);
        _placements.Add((elementClass, placement));
        _symmetryCounts.Add(templates[elementClass].CountSymmetries(PlacedElement.SizeOf(placement)));
        return _placements.Count - 1;
    }

    /// <summary>Returns the index of the nearest placement within the tolerance, or −1.</summary>
    public int Find(int elementClass, AffineMap placement) => Find(elementClass, placement, out _, out _);

    /// <summary>Returns the index of the nearest placement within the tolerance, or −1.</summary>
    /// <param name="elementClass">The class.</param>
    /// <param name="placement">The placement.</param>
    /// <param name="symmetry">The template's symmetry that comes before the placement found.</param>
    /// <param name="error">The distance in units of the tolerance, from 0 to 1.</param>
    public int Find(int elementClass, AffineMap placement, out int symmetry, out double error)
    {
        (symmetry, error) = (-1, 1);
        var size = PlacedElement.SizeOf(placement);
        // Places without number have no cell.
        if (!double.IsNormal(size) || !(placement.Translation.MaxAbsComponent() < MaxCell * size))
        {
            return -1;
        }

        var reach = Math.Min((relativeTolerance * size) + tolerance, MaxReach * size);
        var (best, bestSquare) = (-1, reach * reach);
        for (var level = Math.ILogB(size - reach); level <= Math.ILogB(size + reach); level++)
        {
            var scale = Math.ScaleB(1, -level);
            var low = scale * (placement.Translation - new Vector(reach, reach, reach));
            var high = scale * (placement.Translation + new Vector(reach, reach, reach));
            for (var x = (long)Math.Floor(low.X); x <= (long)Math.Floor(high.X); x++)
            {
                for (var y = (long)Math.Floor(low.Y); y <= (long)Math.Floor(high.Y); y++)
                {
                    for (var z = (long)Math.Floor(low.Z); z <= (long)Math.Floor(high.Z); z++)
                    {
                        if (_cells.TryGetValue((elementClass, level, x, y, z), out var list))
                        {
                            Search(list, elementClass, placement, ref best, ref bestSquare, ref symmetry);
                        }
                    }
                }
            }
        }

        error = Math.Sqrt(bestSquare) / reach;
        return best;
    }

    private void Search(List<int> list, int elementClass, AffineMap placement, ref int best, ref double bestSquare, ref int symmetry)
    {
        foreach (var index in list)
        {
            var found = _placements[index].Placement;
            var square = (found.Translation - placement.Translation).LengthSquared();
            if (square > bestSquare)
            {
                continue;
            }

            var (symmetries, normal) = (templates[elementClass].Symmetries, templates[elementClass].IsFlat ? NormalWeight : 1);
            for (var number = 0; number < _symmetryCounts[index]; number++)
            {
                var difference = (found.Linear * symmetries[number].Map) - placement.Linear;
                var total = square + difference.V1.LengthSquared() + difference.V2.LengthSquared()
                    + (normal * difference.V3.LengthSquared());
                if (total < bestSquare)
                {
                    (best, bestSquare, symmetry) = (index, total, number);
                }
            }
        }
    }
}
