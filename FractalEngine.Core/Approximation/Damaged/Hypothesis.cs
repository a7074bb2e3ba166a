using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Approximation.Grammars.Trees;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>Sets of maps, and a tree within the last one, whose products are applied to some base elements.</summary>
/// <param name="Sets">The sets, outermost first, each with the identity first; possibly none.</param>
/// <param name="Tree">The maps of the tree, without the identity; possibly none.</param>
/// <param name="Depth">The largest number of the tree's maps in a product.</param>
/// <param name="Bases">Class and placement of the base elements; possibly none yet.</param>
internal sealed record Hypothesis(
    List<List<AffineMap>> Sets, List<AffineMap> Tree, int Depth, List<(int Class, AffineMap Placement)> Bases)
{
    // Powers of a map that was found from noisy elements differ by about so much from the maps that they stand for.
    private const double RowTolerance = 1e-2;

    /// <summary>Which map of the tree may follow which, as in <see cref="TreeGrammar.Follows"/>; null where each may follow each.</summary>
    public bool[,]? Follows { get; init; }

    /// <summary>How many of the last bases stand only at products of full length, where the others then don't.</summary>
    public int LeafCount { get; init; }

    /// <summary>All maps but identities: those of sets, and then those of the tree.</summary>
    public List<AffineMap> Maps => [.. Sets.SelectMany(set => set.Skip(1)), .. Tree];

    /// <summary>Number of products, some of which may be equal.</summary>
    public double WordCount => Sets.Aggregate(
        Enumerable.Range(0, Depth + 1).Sum(length => Math.Pow(Tree.Count, length)), (count, set) => count * set.Count);

    /// <summary>Whether a base stands at a product of some maps.</summary>
    public bool Stands(int part, int[] letters) => LeafCount == 0
        || (part >= Bases.Count - LeafCount) == (letters.Count(letter => letter >= Maps.Count - Tree.Count) == Depth);

    /// <summary>Returns what makes all elements of a damaged set.</summary>
    /// <param name="grammar">What makes them.</param>
    /// <param name="length">Size of the whole, scene units.</param>
    public static Hypothesis Of(ElementGrammar grammar, double length)
    {
        var (set, factors, rest, tree) = grammar;
        var leaves = tree?.Leaves ?? [];
        return new(
            [.. factors.SelectMany(factor => Split(factor.Maps, length))], tree?.Maps ?? [], tree?.Depth ?? 0,
            [.. (tree?.Base ?? [.. rest]).Select(member => (set.Elements[member].Class, set.Elements[member].Placement)), .. leaves])
        {
            Follows = tree is null or { IsFull: true } ? null : tree.Follows,
            LeafCount = leaves.Count,
        };
    }

    /// <summary>Splits a set of rows into the powers of their map, and the set of their first maps.</summary>
    private static IEnumerable<List<AffineMap>> Split(List<AffineMap> maps, double length)
    {
        if (MapRows.Find(maps, RowTolerance, length) is not { Others.Count: > 1 } row)
        {
            return [maps];
        }

        // The identity is any of the powers of its row.
        var before = Enumerable.Range(0, row.Count).FirstOrDefault(
            power => row.Others.Exists(map => IsIdentity(row.Map.Power(power) * map)));
        var others = row.Others.ConvertAll(map => row.Map.Power(before) * map);
        var powers = Enumerable.Range(-before, row.Count).Where(power => power != 0).Select(row.Map.Power);
        return others.RemoveAll(IsIdentity) == 1
            ? Split([AffineMap.Identity, .. others], length).Prepend([AffineMap.Identity, .. powers])
            : [maps];

        bool IsIdentity(AffineMap map) => MapRows.AreNear(map, AffineMap.Identity, RowTolerance, length);
    }

    /// <summary>Returns the hypothesis with other maps, in the same order.</summary>
    public Hypothesis WithMaps(List<AffineMap> maps)
    {
        var first = 0;
        return this with { Sets = Sets.ConvertAll(set => (List<AffineMap>)[set[0], .. Next(set.Count - 1)]), Tree = Next(Tree.Count) };

        List<AffineMap> Next(int count) => maps[first..(first += count)];
    }

    /// <summary>Returns all products, each with the indices of the maps that it is made of, outermost first.</summary>
    public List<(AffineMap Map, int[] Letters)> Words()
    {
        var maps = Maps;
        var words = new List<(AffineMap Map, int[] Letters)> { (AffineMap.Identity, []) };
        var first = 0;
        foreach (var set in Sets)
        {
            words = [.. words.SelectMany(word => Append(word, first, set.Count - 1).Prepend(word))];
            first += set.Count - 1;
        }

        var level = words;
        for (var depth = 0; depth < Depth; depth++)
        {
            level = [.. level.SelectMany(word => Append(word, first, Tree.Count)
                .Where(next => Follows?[depth > 0 ? word.Letters[^1] - first : Tree.Count, next.Letters[^1] - first] ?? true))];
            words = [.. words, .. level];
        }

        return words;

        IEnumerable<(AffineMap Map, int[] Letters)> Append((AffineMap Map, int[] Letters) word, int start, int count) =>
            Enumerable.Range(start, count).Select(letter => (word.Map * maps[letter], (int[])[.. word.Letters, letter]));
    }
}
