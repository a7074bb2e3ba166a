using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars;

/// <summary>Writes sets of maps as rows: powers of one map, times a smaller set.</summary>
public static class MapRows
{
    // Powers of a map that was found from elements differ from others found so by that much at most.
    private const double RowTolerance = 1e-8;

    /// <summary>Splits off a row of at least three powers, the longest one.</summary>
    /// <param name="maps">The set.</param>
    /// <param name="tolerance">Largest difference of equal maps: of entries, and of translations in units of the length.</param>
    /// <param name="length">Size of what is mapped, scene units.</param>
    /// <returns>The map, the number of its powers from 0, and the maps that they stand before; or null.</returns>
    public static (AffineMap Map, int Count, List<AffineMap> Others)? Find(IReadOnlyList<AffineMap> maps, double tolerance, double length)
    {
        ArgumentNullException.ThrowIfNull(maps);
        // Most rows are in order already.
        if (maps.Count > 2 && AreNear(maps[0], AffineMap.Identity, tolerance, length)
            && Enumerable.Range(1, maps.Count - 1).All(next => AreNear(maps[next], maps[1] * maps[next - 1], tolerance, length)))
        {
            return (maps[1], maps.Count, [maps[0]]);
        }

        (AffineMap, int, List<AffineMap>)? best = null;
        var bestCount = 2;
        // Each map of the set has a neighbour in its row, so that one of them tells all steps. The identity is at an end.
        var start = Math.Max(0, IndexOf(maps, AffineMap.Identity, tolerance, length));
        var back = maps[start].Inverse();
        for (var next = 0; next < maps.Count; next++)
        {
            var map = maps[next] * back;
            if (start != next && Split(maps, map, bestCount, tolerance, length) is { } split)
            {
                bestCount = split.Count;
                best = (map, split.Count, split.Others);
            }
        }

        return best;
    }

    /// <summary>Whether two maps do the same to things of a size.</summary>
    public static bool AreNear(AffineMap map1, AffineMap map2, double tolerance, double length) =>
        (map1.Linear - map2.Linear).MaxAbsEntry() <= tolerance
        && (map1.Translation - map2.Translation).MaxAbsComponent() <= tolerance * length;

    /// <summary>Counts the maps that a file needs for a set: one for the powers of a map, and none for the identity.</summary>
    internal static int CountMaps(IReadOnlyList<AffineMap> maps)
    {
        var length = 1 + maps.Max(map => map.Translation.MaxAbsComponent());
        return maps.Count > 2 && Find(maps, RowTolerance, length) is { } row
            ? 1 + CountMaps(row.Others)
            : maps.Count(map => !AreNear(map, AffineMap.Identity, RowTolerance, length));
    }

    /// <summary>Makes one set of successive sets that together are a row of powers.</summary>
    internal static List<MapFactor> Merge(List<MapFactor> factors, double length)
    {
        var merged = new List<MapFactor>();
        foreach (var factor in factors)
        {
            if (merged.Count > 0 && IsRow(merged[^1].Maps, length) && IsRow(factor.Maps, length)
                && Multiply(merged[^1].Maps, factor, length) is { } product)
            {
                merged[^1] = factor with { Maps = product };
            }
            else
            {
                merged.Add(factor);
            }
        }

        return merged;
    }

    /// <summary>The product of a row and a factor, with such symmetries that it is one row; null where there are none.</summary>
    private static List<AffineMap>? Multiply(List<AffineMap> row, MapFactor factor, double length)
    {
        IEnumerable<IEnumerable<AffineMap>> products = factor.Maps.Count > 2
            ? [row.SelectMany(outer => factor.Maps.Select(inner => outer * inner))]
            : factor.Symmetries.Select(symmetry => factor.Maps[1] * symmetry)
                .Select(inner => row.SelectMany(outer => new[] { outer, outer * inner }));
        return products.Select(static product => product.ToList()).FirstOrDefault(product => IsRow(product, length));
    }

    private static bool IsRow(List<AffineMap> maps, double length) =>
        maps.Count == 2 || Find(maps, RowTolerance, length) is { Others.Count: 1 };

    private static (int Count, List<AffineMap> Others)? Split(
        IReadOnlyList<AffineMap> maps, AffineMap map, int minCount, double tolerance, double length)
    {
        var taken = new bool[maps.Count];
        var rest = new List<AffineMap>();
        var back = map.Inverse();
        var count = 0;
        for (var start = 0; start < maps.Count; start++)
        {
            if (IndexOf(maps, back * maps[start], tolerance, length) >= 0)
            {
                continue;
            }

            rest.Add(maps[start]);
            var run = 0;
            var next = start;
            for (var power = maps[start]; next >= 0 && !taken[next]; next = IndexOf(maps, power, tolerance, length))
            {
                taken[next] = true;
                run++;
                power = map * power;
            }

            if (run <= minCount || (count > 0 && run != count))
            {
                return null;
            }

            count = run;
        }

        return count > 0 && Array.TrueForAll(taken, isTaken => isTaken) ? (count, rest) : null;
    }

    private static int IndexOf(IReadOnlyList<AffineMap> maps, AffineMap map, double tolerance, double length)
    {
        for (var index = 0; index < maps.Count; index++)
        {
            if (AreNear(maps[index], map, tolerance, length))
            {
                return index;
            }
        }

        return -1;
    }
}
