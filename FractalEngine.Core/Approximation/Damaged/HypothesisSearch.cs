using FractalEngine.Core.Approximation.Damaged.Placements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>
/// Looks for sets and trees among damaged elements, from the outermost set inwards: maps that take most elements to elements make a set;
/// all elements are then folded by its inverse maps, so that what is missing in one part is filled from others, and what few maps agree on
/// counts less. What is left at each level may be a tree.
/// </summary>
/// <param name="model">The elements in their classes.</param>
/// <param name="settings">Seed and effort.</param>
/// <param name="cancellation">Ends the search early.</param>
internal sealed class HypothesisSearch(DamagedModel model, DamagedSearchSettings settings, CancellationToken cancellation)
{
    private const int MaxLevels = 8;
    private const int MaxTreeDepth = 10;
    private const int MaxStartMaps = 6;
    private const int MaxTreeMaps = 12;
    private const int MaxSet = 64;
    private const int MaxMaps = 24;
    private const int MaxCandidates = 60;

    // More products of maps than elements, by this factor, explain nothing.
    private const double MaxPredicted = 8;

    // A set has no map whose support, with each map of it, is less than that part of what the others have on average.
    private const double MinSupport = 0.55;

    // Supports of a row fall with the number of steps, and are missing here and there.
    private const double MinRepeated = 0.3;

    private const double MaxContraction = 0.99;

    // Folded elements are dropped that are so unlikely, and beyond so many for each element.
    private const double MinWeight = 0.1;
    private const int MaxFolded = 2;

    private readonly PlacementIndex _all = model.CreateFullIndex(model.Tolerance);
    private Explanation _best;

    /// <summary>The hypothesis that explains most for what it costs, with its bases; null for none.</summary>
    public Hypothesis? Best { get; private set; }

    /// <summary>What part of the elements the best hypothesis explains.</summary>
    public double ExplainedPart => (double)_best.Explained / _all.Count;

    private bool IsClear => _best.IsClear(_all.Count);

    /// <summary>Finds the maps between all elements that may be those of a tree, the most supported first.</summary>
    public List<Relation> FindMapsOfTrees()
    {
        var search = SearchOfAll();
        return MapsOfTrees(search, search.Find(settings.Effort));
    }

    /// <summary>Tries all ways until one explains most elements.</summary>
    public void Run()
    {
        var search = SearchOfAll();
        var relations = search.Find(settings.Effort);
        if (Run(search, relations, isRow: true) && !IsClear)
        {
            Run(search, relations, isRow: false);
        }
    }

    private RelationSearch SearchOfAll() => new(
        model, model.CreateFullIndex(model.IsExact ? model.Tolerance : model.FirstTolerance), model.Elements.ConvertAll(_ => 1.0),
        cancellation);

    /// <summary>Tries products of sets, and a tree within those that are rows; returns whether any set was a row.</summary>
    /// <param name="search">The elements.</param>
    /// <param name="relations">The maps between them.</param>
    /// <param name="isRow">Whether sets may be the powers of one map.</param>
    private bool Run(RelationSearch search, List<Relation> relations, bool isRow)
    {
        var sets = new List<List<AffineMap>>();
        var (hasRow, isWithinRows) = (false, true);
        while (sets.Count < MaxLevels && search.Set.Count > 1)
        {
            var isLast = relations.Count == 0;
            var row = isRow && !isLast ? FindRow(search, relations) : null;
            var maps = isLast ? FindAll(search) : row ?? FindSet(search, relations);
            hasRow |= row is not null;
            if (isWithinRows)
            {
                ConsiderTrees(sets, maps, [.. GeneratorRanking.Rank(MapsOfTrees(search, relations), model).Take(MaxTreeMaps)]);
            }

            if (maps.Count < 2 || (IsClear && Best?.Tree.Count > 0))
            {
                break;
            }

            // Within sets that are no rows, what looks like a tree is a part of the product.
            isWithinRows &= row is not null;
            sets.Add(maps);
            Consider(new([.. sets], [], 0, []));
            if (isLast)
            {
                break;
            }

            search = Fold(search, maps);
            relations = search.Find(settings.Effort);
        }

        return hasRow;
    }

    /// <summary>Tries trees of the maps of a set that make smaller, and of the most supported ones that do.</summary>
    private void ConsiderTrees(List<List<AffineMap>> sets, List<AffineMap> set, List<AffineMap> supported)
    {
        var ofSet = set.Select(origin => set.Select(map => map * origin.Inverse()).Where(IsContraction).ToList()).MaxBy(maps => maps.Count);
        var ofSupported = Enumerable.Range(2, MaxStartMaps).TakeWhile(count => count <= supported.Count)
            .Select(count => supported.Take(count).ToList());
        foreach (var maps in ofSupported.Prepend(ofSet ?? []).TakeWhile(_ => !IsClear).Where(maps => maps.Count > 1))
        {
            var (before, worth) = (double.NegativeInfinity, 0.0);
            for (var depth = 2; depth <= MaxTreeDepth && worth >= before; depth++)
            {
                (before, worth) = (worth, Consider(new([.. sets], maps, depth, [])));
            }
        }

        Improve(supported);
    }

    /// <summary>Leaves out or adds maps or a level of the best tree as long as that explains more.</summary>
    private void Improve(List<AffineMap> supported)
    {
        for (var worth = 0.0; _best.Worth > worth && Best is { Tree.Count: > 1 } best;)
        {
            worth = _best.Worth;
            IEnumerable<List<AffineMap>> trees =
            [
                .. best.Tree.Select(map => best.Tree.Where(other => other != map).ToList()),
                .. supported.Except(best.Tree).Select(map => (List<AffineMap>)[.. best.Tree, map]),
            ];
            foreach (var changed in trees.Select(tree => best with { Tree = tree }).Append(best with { Depth = best.Depth + 1 }))
            {
                Consider(changed);
            }
        }
    }

    /// <summary>Finds bases for a hypothesis, and keeps it if it is the best so far; returns what it is worth.</summary>
    private double Consider(Hypothesis hypothesis)
    {
        if (hypothesis.WordCount > MaxPredicted * _all.Count)
        {
            return double.NegativeInfinity;
        }

        var (completed, explanation) = new BaseSearch(model, _all, settings.Seed, cancellation).Complete(hypothesis);
        // Of equal ones the last, which has most sets.
        if (explanation.Worth >= _best.Worth && explanation.Worth > 0)
        {
            (Best, _best) = (completed, explanation);
        }

        return explanation.Worth;
    }

    private static List<Relation> MapsOfTrees(RelationSearch search, List<Relation> relations) =>
        search.Distinct(relations.Where(relation => IsContraction(relation.Map)), GeneratorRanking.MaxMaps);

    private static bool IsContraction(AffineMap map) => Math.Abs(map.Linear.Determinant()) < MaxContraction;

    /// <summary>The maps of one element to all others that are there for sure, if these are few.</summary>
    private List<AffineMap> FindAll(RelationSearch search)
    {
        var (set, weights) = (search.Set, search.Weights);
        var members = Enumerable.Range(0, set.Count).Where(member => weights[member] >= 1).GroupBy(member => set[member].Class)
            .OrderByDescending(group => group.Count()).ThenBy(group => group.Key).FirstOrDefault()?.ToArray() ?? [];
        if (members.Length is < 2 or > MaxSet)
        {
            return [];
        }

        var back = set[members[0]].Placement.Inverse();
        return [AffineMap.Identity, .. members.Skip(1).Select(member => model.Templates[set[member].Class].Symmetries.Select(symmetry =>
            PlacedElement.After(symmetry.Map, set[member].Placement) * back).MaxBy(search.SupportOf))];
    }

    /// <summary>The powers of the best relation, as far as there are any; null where even the second one hardly is.</summary>
    private List<AffineMap>? FindRow(RelationSearch search, List<Relation> relations)
    {
        // A map that turns all onto itself by two steps counts each pair twice.
        var step = relations.Select(relation => relation.Map)
            .FirstOrDefault(map => !model.AreNear(map * map, AffineMap.Identity), relations[0].Map);
        var powers = new List<AffineMap> { AffineMap.Identity, step };
        var last = 1;
        for (var power = step * step;
            powers.Count < MaxSet && RelationSearch.CanInvert(power) && !model.AreNear(power, AffineMap.Identity);
            power = step * power)
        {
            powers.Add(power);
            last = search.SupportOf(power) > 0 ? powers.Count - 1 : last;
            if (last == 1 && powers.Count > 3)
            {
                break;
            }
        }

        return last > 1 && search.SupportOf(powers[2]) > MinRepeated * search.SupportOf(step) ? powers[..(last + 1)] : null;
    }

    /// <summary>Adds to the best relation those that most agree with it and each other.</summary>
    private List<AffineMap> FindSet(RelationSearch search, List<Relation> relations)
    {
        // What can be applied twice is a step of a row, or turns all onto itself.
        var first = relations.Find(relation =>
            search.SupportOf(relation.Map * relation.Map) < MinRepeated * search.SupportOf(relation.Map)
            && !model.AreNear(relation.Map * relation.Map, AffineMap.Identity));
        if (first.Support == 0)
        {
            return [];
        }

        List<AffineMap> maps = [AffineMap.Identity];
        var pool = relations.Take(MaxCandidates).SelectMany(relation => new[] { relation.Map, relation.Map.Inverse() }).ToArray();
        var supports = new double[pool.Length];
        var (next, sum, pairs) = (first.Map, first.Support, 1);
        Count(AffineMap.Identity);
        while (true)
        {
            maps.Add(next);
            Count(next);
            var best = Array.IndexOf(supports, supports.Max());
            if (maps.Count == MaxMaps || supports[best] < MinSupport * maps.Count * sum / pairs)
            {
                return maps;
            }

            (next, sum, pairs) = (pool[best], sum + supports[best], pairs + maps.Count);
        }

        // Adds how well each map of the pool agrees with a map that is known; where both do the same they are one.
        void Count(AffineMap known)
        {
            var back = known.Inverse();
            for (var index = 0; index < pool.Length; index++)
            {
                supports[index] = search.IsSame(pool[index], known) ? double.NegativeInfinity
                    : supports[index] + search.SupportOf(pool[index] * back);
            }
        }
    }

    /// <summary>
    /// Folds elements by the inverses of maps. What several elements are folded to is there; of the others each may be there by one map.
    /// </summary>
    private RelationSearch Fold(RelationSearch search, List<AffineMap> maps)
    {
        var (set, weights) = (search.Set, search.Weights);
        var all = model.CreateIndex(model.Tolerance);
        var sources = new List<List<int>>();
        foreach (var back in maps.Select(map => map.Inverse()))
        {
            for (var member = 0; member < set.Count; member++)
            {
                var placement = back * set[member].Placement;
                var found = all.Find(set[member].Class, placement);
                if (found < 0)
                {
                    found = all.Add(set[member].Class, placement);
                    sources.Add([]);
                }

                sources[found].Add(member);
            }
        }

        var isUsed = new bool[set.Count];
        var folded = model.CreateIndex(model.Tolerance);
        var foldedWeights = new List<double>();
        var single = new List<int>();
        foreach (var candidate in Enumerable.Range(0, all.Count)
            .OrderByDescending(candidate => sources[candidate].Sum(member => weights[member])).ThenBy(candidate => candidate))
        {
            var sum = sources[candidate].Where(member => !isUsed[member]).Sum(member => weights[member]);
            if (sum > 1.2)
            {
                folded.Add(all[candidate].Class, all[candidate].Placement);
                foldedWeights.Add(1);
                sources[candidate].ForEach(member => isUsed[member] = true);
            }
            else
            {
                single.Add(candidate);
            }
        }

        foreach (var candidate in single.OrderByDescending(Weight).TakeWhile(candidate => Weight(candidate) > MinWeight)
            .Take(Math.Max(0, (MaxFolded * set.Count) - folded.Count)).ToArray())
        {
            folded.Add(all[candidate].Class, all[candidate].Placement);
            foldedWeights.Add(Weight(candidate));
        }

        return new(model, folded, foldedWeights, cancellation);

        double Weight(int candidate) => sources[candidate].Where(member => !isUsed[member]).Sum(member => weights[member]) / maps.Count;
    }
}
