using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Trees;

/// <summary>Finds which products of a tree's maps exist, and what stands at each, and says whether that is a grammar.</summary>
/// <param name="group">The elements that are to be explained.</param>
/// <param name="root">The element that products are applied to.</param>
/// <param name="maps">The maps of the products.</param>
/// <param name="known">Which map follows which, as in <see cref="TreeGrammar.Follows"/>; null where that is to be found out.</param>
internal sealed class TreeLevels(ElementGroup group, int root, List<AffineMap> maps, bool[,]? known = null)
{
    private const int MaxLeafAttempts = 64;

    private readonly ElementSet _set = group.Set;
    private readonly List<(AffineMap Product, int Last, int Level)> _products = [];

    /// <summary>Returns the grammar, or null where it does not explain all elements and nothing else.</summary>
    public TreeGrammar? Describe()
    {
        var follows = known ?? new bool[maps.Count + 1, maps.Count];
        var depth = Trace(follows);
        if (!IsRegular(follows, depth))
        {
            return null;
        }

        var remaining = new HashSet<int>(group.Members);
        var bases = new List<int>();
        foreach (var member in Roots())
        {
            if (_products.TrueForAll(product => group.Image(product.Product, member) >= 0))
            {
                bases.Add(member);
                remaining.ExceptWith(_products.Select(product => _set.Match(product.Product, member)));
            }
        }

        var leaves = new List<(int, AffineMap)>();
        while (remaining.Count > 0)
        {
            if (FindLeaf(remaining, follows, depth) is not { } leaf)
            {
                return null;
            }

            leaves.Add(leaf);
        }

        // Maps that none follows lead to the base, on the last level, too.
        if (leaves.Count > 0 && Enumerable.Range(0, maps.Count).Any(map => IsEnd(follows, map) && _products.Exists(
            product => product.Level == depth && follows[product.Last, map])))
        {
            return null;
        }

        // Leaves end the last level, which the base then has not.
        return new(maps, follows, leaves.Count > 0 ? depth + 1 : depth, bases, leaves);
    }

    /// <summary>
    /// Finds all products by rising length, and which maps follow which; those that lead to a part by the same last map count once.
    /// </summary>
    private int Trace(bool[,] follows)
    {
        var seen = new HashSet<(int, int)>();
        _products.Add((AffineMap.Identity, maps.Count, 0));
        for (var next = 0; next < _products.Count; next++)
        {
            var (product, last, level) = _products[next];
            for (var map = 0; map < maps.Count; map++)
            {
                if (known is not null && !known[last, map])
                {
                    continue;
                }

                var image = group.Image(product * maps[map], root);
                if (image >= 0)
                {
                    follows[last, map] = true;
                    if (seen.Add((image, map)))
                    {
                        _products.Add((product * maps[map], map, level + 1));
                    }
                }
            }
        }

        return _products[^1].Level;
    }

    private bool IsEnd(bool[,] follows, int map) => !Enumerable.Range(0, maps.Count).Any(next => follows[map, next]);

    private bool IsRegular(bool[,] follows, int depth)
    {
        foreach (var (product, last, level) in _products)
        {
            for (var map = 0; map < maps.Count; map++)
            {
                if (level < depth && (known is null || known[last, map])
                    && (group.Image(product * maps[map], root) >= 0) != follows[last, map])
                {
                    return false;
                }
            }
        }

        return true;
    }

    /// <summary>The elements that are no image of another one.</summary>
    private IEnumerable<int> Roots()
    {
        var isImage = new bool[_set.Count];
        foreach (var member in group.Members)
        {
            foreach (var map in maps)
            {
                if (_set.Match(map, member) is var image && image >= 0 && image != member)
                {
                    isImage[image] = true;
                }
            }
        }

        return group.Members.Where(member => !isImage[member]);
    }

    /// <summary>Looks for an element at the root whose images under all products of one map more than the depth remain.</summary>
    private (int Class, AffineMap Placement)? FindLeaf(HashSet<int> remaining, bool[,] follows, int depth)
    {
        var ends = new List<AffineMap>();
        foreach (var (product, last, _) in _products.Where(product => product.Level == depth))
        {
            ends.AddRange(Enumerable.Range(0, maps.Count).Where(map => follows[last, map]).Select(map => product * maps[map]));
        }

        if (ends.Count == 0)
        {
            return null;
        }

        var back = ends[0].Inverse();
        var tip = ends[0] * _set.Elements[root].Shape.Centroid;
        foreach (var element in remaining.OrderBy(element => (_set.Elements[element].Shape.Centroid - tip).LengthSquared())
            .ThenBy(element => element).Take(MaxLeafAttempts))
        {
            var placement = back * _set.Elements[element].Placement;
            var kind = _set.Elements[element].Class;
            var images = ends.Select(end => _set.Find(end * placement, kind))
                .TakeWhile(image => image >= 0 && remaining.Contains(image)).ToList();
            if (images.Count == ends.Count)
            {
                remaining.ExceptWith(images);
                return (kind, placement);
            }
        }

        return null;
    }
}
