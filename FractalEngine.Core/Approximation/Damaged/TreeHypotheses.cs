using FractalEngine.Core.Approximation.Damaged.Placements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>
/// Looks for a tree among damaged elements: a root, which may be missing, and maps whose products explain most elements and predict
/// fewest that are missing. Pairs of maps are tried first, since a few present elements support a pair better than a single map.
/// </summary>
internal sealed class TreeHypotheses(DamagedModel model, PlacementIndex set, List<Relation> relations, CancellationToken cancellation)
{
    private const int MaxRoots = 6;
    private const int MaxLargest = 24;
    private const int MaxRootRelations = 10;
    private const int MaxCandidates = 48;
    private const int MaxPaired = 24;
    private const int MaxDirect = 8;
    private const int BeamWidth = 4;
    private const int MaxMaps = 24;

    // A map must explain more elements than that.
    private const double MapPenalty = 1.2;

    // Of maps that explain as many elements the one that does so best is the right one.
    private const double ErrorWeight = 0.2;

    // What part of the predicted elements must be present, if nearly all are, if half of them are, if a fifth is.
    private static readonly double[] Parts = [0.7, 0.3, 0.11];

    private double _leastPart;
    private int _class;

    /// <summary>Returns the best tree, or null if none explains more than it costs.</summary>
    public Hypothesis? Find()
    {
        _class = Enumerable.Range(0, set.Count).GroupBy(member => set[member].Class)
            .OrderByDescending(group => group.Count()).ThenBy(group => group.Key).First().Key;
        var members = Enumerable.Range(0, set.Count).Where(member => set[member].Class == _class)
            .OrderByDescending(member => PlacedElement.SizeOf(set[member].Placement)).ToArray();
        var candidates = relations.Select(relation => relation.Map).Where(IsContraction).Take(MaxCandidates).ToArray();
        _leastPart = Parts[1];
        var roots = candidates.Length < 2 ? [] : Roots(members, candidates);
        var best = (Worth: 0.0, Depth: 0, Root: AffineMap.Identity, Maps: new List<AffineMap>());
        foreach (var part in Parts)
        {
            _leastPart = part;
            foreach (var (first, start, _) in roots
                .SelectMany(root => Pairs(root, [.. candidates, .. Direct(root, members.Take(MaxDirect))]))
                .OrderByDescending(pair => pair.Score).Take(BeamWidth))
            {
                var (root, grown) = Extend(first, start, candidates, members);
                var (_, worth, depth) = Judge(root, grown);
                if (worth > best.Worth + 1e-6)
                {
                    best = (worth, depth, root, grown);
                }
            }
        }

        return best.Depth > 0 ? new([best.Maps], best.Depth, [(_class, best.Root)]) : null;
    }

    private static bool IsContraction(AffineMap map) => Math.Abs(map.Linear.Determinant()) < 0.99;

    private List<AffineMap> Roots(int[] members, AffineMap[] candidates)
    {
        var largest = members.Take(MaxLargest).Select(member => set[member].Placement).ToArray();
        var known = model.CreateIndex(0.05);
        var roots = new List<(AffineMap Root, double Score)>();
        var best = candidates.Take(MaxRootRelations).ToArray();
        var inverses = Array.ConvertAll(best, map => map.Inverse());
        foreach (var root in largest.Concat(largest.SelectMany(placement => inverses.Select(map => map * placement))))
        {
            // Of a root many images are there.
            if (known.Find(_class, root) < 0 && Array.Exists(best, map => set.Find(_class, map * root) >= 0))
            {
                known.Add(_class, root);
                roots.Add((root, Pairs(root, best)[0].Score));
            }
        }

        return [.. roots.OrderByDescending(root => root.Score).ThenByDescending(root => PlacedElement.SizeOf(root.Root))
            .Take(MaxRoots).Select(root => root.Root)];
    }

    private List<(AffineMap Root, List<AffineMap> Maps, double Score)> Pairs(AffineMap root, AffineMap[] candidates)
    {
        var singles = candidates.Select(map => (Map: map, Judge(root, [map]).Score)).OrderByDescending(pair => pair.Score)
            .Take(MaxPaired).Select(pair => pair.Map).ToArray();
        var pairs = new List<(AffineMap Root, List<AffineMap> Maps, double Score)>();
        for (var first = 0; first < singles.Length; first++)
        {
            cancellation.ThrowIfCancellationRequested();
            for (var second = first + 1; second < singles.Length; second++)
            {
                List<AffineMap> maps = [singles[first], singles[second]];
                pairs.Add((root, maps, Judge(root, maps).Score));
            }
        }

        return [.. pairs.OrderByDescending(pair => pair.Score).Take(BeamWidth)];
    }

    /// <summary>The maps that take a root to elements.</summary>
    private IEnumerable<AffineMap> Direct(AffineMap root, IEnumerable<int> images)
    {
        var back = root.Inverse();
        return images.SelectMany(image => model.Templates[_class].Symmetries.Select(symmetry => new AffineMap(
            set[image].Placement.Linear * symmetry.Map, set[image].Placement.Translation) * back)).Where(IsContraction);
    }

    /// <summary>
    /// Adds and removes maps as long as that scores: known relations, and maps of the root to what is not explained. The root may become
    /// that of a larger tree, of which the tree is a branch.
    /// </summary>
    private (AffineMap Root, List<AffineMap> Maps) Extend(AffineMap root, List<AffineMap> start, AffineMap[] candidates, int[] members)
    {
        var maps = start;
        var (score, _, _) = Judge(root, maps);
        while (maps.Count < MaxMaps)
        {
            cancellation.ThrowIfCancellationRequested();
            var explained = new HashSet<int>();
            Judge(root, maps, explained);
            var direct = Direct(root, members.Where(member => !explained.Contains(member)).Take(2));
            var next = (Root: root, Maps: maps);
            var (tree, before) = (maps, root);
            IEnumerable<(AffineMap Root, List<AffineMap> Maps)> changes =
            [
                .. tree.Select(map => (before, tree.Where(other => other != map).ToList())),
                .. tree.Select(map => (map.Inverse() * before, tree)),
                .. candidates.Concat(direct).Select(map => (before, (List<AffineMap>)[.. tree, map])),
            ];
            foreach (var change in changes)
            {
                var (changed, _, _) = Judge(change.Root, change.Maps);
                if (changed > score + 1e-6)
                {
                    (score, next) = (changed, change);
                }
            }

            if (next == (root, maps))
            {
                break;
            }

            (root, maps) = next;
        }

        return (root, maps);
    }

    /// <summary>
    /// Scores a tree at its best depth: by elements that it explains, less a part of those that it predicts. Of the true tree a subset of
    /// maps has as large a part of its elements present as all maps have, unlike products and quotients of maps.
    /// </summary>
    private (double Score, double Worth, int Depth) Judge(AffineMap root, List<AffineMap> maps, HashSet<int>? all = null)
    {
        var explained = all ?? [];
        var level = new List<AffineMap> { root };
        var best = (Score: double.NegativeInfinity, Worth: 0.0, Depth: 0);
        var (predicted, quality) = (0, 0.0);
        for (var depth = 0; level.Count > 0; depth++)
        {
            var before = explained.Count;
            foreach (var placement in level)
            {
                if (set.Find(_class, placement, out _, out var error) is var found && found >= 0 && explained.Add(found))
                {
                    quality += 1 - (ErrorWeight * error);
                }
            }

            predicted += level.Count;
            var score = quality - (_leastPart * predicted) - (MapPenalty * maps.Count);
            if (score > best.Score)
            {
                best = (score, Explanation.Worth(explained.Count, predicted, maps.Count + 1), depth);
            }

            // The first levels may be missing.
            var isGoingOn = (explained.Count > before || depth < 2)
                && predicted + ((long)level.Count * maps.Count) <= (explained.Count + 3) * 3 / _leastPart;
            level = isGoingOn ? [.. level.SelectMany(placement => maps.Select(map => map * placement))] : [];
        }

        return best;
    }
}
