using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Trees;

/// <summary>
/// Looks for a tree: a root, and smaller parts that the products of a few maps make of it. By falling size, each element that no
/// product of known maps explains is a new map.
/// </summary>
/// <remarks>
/// Where all maps make things smaller, a product is smaller than each of its factors' images of the root, so that factors are found
/// before their products. Cost O(elements · maps) look-ups.
/// </remarks>
/// <param name="group">The elements that are to be explained.</param>
/// <param name="cancellation">Ends the search early.</param>
internal sealed class TreeSearch(ElementGroup group, CancellationToken cancellation)
{
    private const int MaxClasses = 3;
    private const int MaxMaps = 40;
    private const int MaxFullMaps = 24;
    private const int SampleSize = 96;

    private readonly ElementSet _set = group.Set;
    private readonly List<AffineMap> _maps = [];
    private readonly List<AffineMap> _products = [];
    private readonly HashSet<int> _explained = [];
    private int _root;
    private int[] _bySize = [];

    /// <summary>Finds a tree that explains all given elements exactly, or null.</summary>
    /// <param name="set">All elements.</param>
    /// <param name="members">The elements of the tree.</param>
    /// <param name="isFull">Whether only trees are wanted in which each map follows each, which numbers of parts soon tell.</param>
    /// <param name="cancellation">Ends the search early.</param>
    public static TreeGrammar? Find(ElementSet set, int[] members, bool isFull, CancellationToken cancellation)
    {
        var whole = new ElementGroup(set, members);
        var classes = members.GroupBy(member => set.Elements[member].Class).Where(parts => parts.Count() > 2)
            .OrderByDescending(parts => parts.Count()).ThenBy(parts => parts.Key).Select(parts => parts.ToArray()).ToArray();
        var first = classes.Take(MaxClasses).Select(parts => new TreeSearch(whole, cancellation).Find(parts, isFull))
            .FirstOrDefault(grammar => grammar is not null && (!isFull || grammar.IsFull));
        // What stands at all calls is larger than what stands at the ends.
        return first is not null || isFull ? first
            : classes.OrderByDescending(parts => parts.Max(part => set.Elements[part].Shape.Size)).Take(MaxClasses)
                .Select(parts => CallSearch.Find(whole, parts, cancellation)).FirstOrDefault(grammar => grammar is not null);
    }

    private TreeGrammar? Find(int[] parts, bool isFull)
    {
        _bySize = [.. parts.OrderByDescending(SizeOf).ThenBy(member => member)];
        _root = _bySize[0];
        if (!_set.IsSmaller(_bySize[^1], _root))
        {
            return null;
        }

        Explain(AffineMap.Identity);
        foreach (var element in _bySize)
        {
            cancellation.ThrowIfCancellationRequested();
            // Others as large as the root belong to the base, if they are no images.
            if (_explained.Contains(element) || !_set.IsSmaller(element, _root))
            {
                continue;
            }

            var map = BestMap(element);
            if (_maps.Count == (isFull ? MaxFullMaps : MaxMaps) || map is null)
            {
                return null;
            }

            Add(map.Value);
        }

        return _maps.Count > 0 && (!isFull || (_maps.Count > 1 && IsCountOfFull()))
            ? new TreeLevels(group, _root, _maps).Describe()
            : null;
    }

    /// <summary>Whether there are as many parts as a full tree of some depth has: 1 + k + k² + …</summary>
    private bool IsCountOfFull()
    {
        var count = 1L;
        for (var level = (long)_maps.Count; count < _explained.Count; level *= _maps.Count)
        {
            count += level;
        }

        return count == _explained.Count;
    }

    private double SizeOf(int element) => _set.Elements[element].Shape.Size;

    /// <summary>Of the maps that take the root to an element, the one that takes most other elements to elements.</summary>
    private AffineMap? BestMap(int element)
    {
        var sample = _bySize.AsSpan(0, Math.Min(SampleSize, _bySize.Length)).ToArray();
        var maps = _set.MapsBetween(_root, element).OrderBy(Oddity).ToList();
        if (_set.Elements[_root].Shape.IsFlat)
        {
            var parts = OutOfPlane.PartsOf(_set, _root, _bySize.Skip(1));
            maps.AddRange(maps.SelectMany(map => parts.SelectMany(part => OutOfPlane.MapsOf(
                _set, _root, map, part, _bySize.SkipWhile(member => SizeOf(member) > SizeOf(part))))).ToArray());
        }

        return maps.MaxBy(map => sample.Count(member => group.Image(map, member) >= 0));
    }

    /// <summary>Of maps that explain as much, those come first that turn less, and mirrors last.</summary>
    private static double Oddity(AffineMap map) => Math.Round(Conjugation.Oddity(map), 9);

    /// <summary>Adds a map, and all products with it.</summary>
    private void Add(AffineMap map)
    {
        _maps.Add(map);
        var known = _products.Count;
        for (var index = 0; index < _products.Count; index++)
        {
            // What was there before has the products with all other maps.
            foreach (var next in index < known ? [map] : _maps)
            {
                Explain(_products[index] * next);
            }
        }
    }

    private void Explain(AffineMap product)
    {
        if (group.Image(product, _root) is var image && image >= 0 && _explained.Add(image))
        {
            _products.Add(product);
        }
    }
}
