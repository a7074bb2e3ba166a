using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Expands sets of maps to products of them, one by one and without any cleverness.</summary>
internal static class Words
{
    /// <summary>Lists all products of one map of each set; the first set is the outermost, which is applied last.</summary>
    public static List<AffineMap> Products(IEnumerable<IReadOnlyList<AffineMap>> sets)
    {
        List<AffineMap> products = [AffineMap.Identity];
        foreach (var set in sets)
        {
            products = [.. from product in products from map in set select product * map];
        }

        return products;
    }

    /// <summary>Lists all products of exactly so many maps of a set.</summary>
    public static List<AffineMap> Exactly(IReadOnlyList<AffineMap> set, int length) => Products(Enumerable.Repeat(set, length));

    /// <summary>Lists all products of at most so many maps of a set, the identity among them.</summary>
    public static List<AffineMap> UpTo(IReadOnlyList<AffineMap> set, int length)
    {
        List<AffineMap> all = [AffineMap.Identity];
        List<AffineMap> last = [AffineMap.Identity];
        for (var level = 0; level < length; level++)
        {
            last = [.. from product in last from map in set select product * map];
            all.AddRange(last);
        }

        return all;
    }

    /// <summary>Counts the products that <see cref="UpTo"/> lists.</summary>
    public static double CountUpTo(int maps, int length)
    {
        var count = 1.0;
        for (var level = 0; level < length; level++)
        {
            count = 1 + (maps * count);
        }

        return count;
    }
}
