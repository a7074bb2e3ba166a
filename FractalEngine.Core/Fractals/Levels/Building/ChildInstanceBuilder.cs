using System.Runtime.InteropServices;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>
/// Determines the children of sub-fractals, such that no instance of the base mesh is reached by two paths. Equal children are built once.
/// </summary>
/// <param name="baseCount">Number of base meshes, which are the levels below all others.</param>
internal sealed class ChildInstanceBuilder(int baseCount)
{
    // Levels are skipped by their identities until a level has so many edges.
    private const int MaxEdges = 256;

    // A sub-fractal is expanded over several levels at once while its children are no more than this: to test some more boxes, four at a
    // time, costs less than to descend one level after another.
    private const int MaxChildren = 32;

    // The limit for expansions that give all children the same number of remaining levels.
    private const int MaxChildrenForSameLevel = 48;

    // Coordinates in the frames of smaller children leave the range in which their squares are accurate.
    private const double MaxInverseEntry = 1e40;

    /// <summary>Maximum number of edges between a sub-fractal and its children: in a repetition, of rounds.</summary>
    public const int MaxExpandedLevels = 16;

    private readonly Dictionary<ChildEdge[], ChildInstance> _instances = new(ChildEdgesComparer.Instance);

    private readonly Dictionary<ChildEdge[], ChildInstance[]> _wideLevels = new(ChildEdgesComparer.Instance);

    // By sets, the largest size of an entry in the inverse of each map: the same few are asked at each level.
    private readonly Dictionary<MapSet, double[]> _inverseEntries = [];

    private readonly HashSet<ChildEdge[]> _sharedEdges = new(ChildEdgesComparer.Instance);

    /// <summary>
    /// Lists the edges of a level. First come its own maps; then, where its identity lets it be skipped, the maps that the next levels of
    /// the same repetition add; last the level below the repetition, if all of it can be skipped.
    /// </summary>
    /// <param name="level">Remaining levels of the parent.</param>
    /// <param name="levelsBelowRepetition">Remaining levels below the repetition that the level belongs to.</param>
    /// <param name="period">Number of levels after which the sets of the repetition recur.</param>
    /// <param name="set">The set of the level.</param>
    /// <param name="setAt">Gives the set of a lower level by its remaining levels.</param>
    public static ChildEdge[] EdgesAt(long level, long levelsBelowRepetition, int period, MapSet set, Func<long, MapSet> setAt)
    {
        // One more, for the edge at the end: a list that grows would be twice as large.
        var edges = new List<ChildEdge>(set.Maps.Length + 1);
        var offeredMaps = new HashSet<(AffineMap Map, MapColour Colour)>();
        var currentSet = set;
        for (var levelsDown = 1L; ; levelsDown++)
        {
            AddEdges(edges, offeredMaps, currentSet, levelsDown);
            if (currentSet.IdentityIndex < 0)
            {
                return edges.ToArray();
            }

            // All sets of the repetition were visited, and all have the identity.
            if (level - levelsDown == levelsBelowRepetition || levelsDown == period)
            {
                edges.Add(ChildEdge.SkipTo(levelsBelowRepetition));
                return edges.ToArray();
            }

            if (edges.Count > MaxEdges)
            {
                // Short lists matter more than the last duplicate: the next level lists the rest.
                edges.Add(new(MapSet.Identity, 0, LevelStep.Down(levelsDown)));
                return edges.ToArray();
            }

            // Only where another level follows: these are as many bytes as the maps.
            offeredMaps.UnionWith(currentSet.Maps.Select((map, index) => (map, currentSet.ColourOf(index))));
            currentSet = setAt(level - levelsDown);
        }
    }

    /// <summary>Returns the edges of an earlier level where they are equal: most levels share theirs.</summary>
    public ChildEdge[] Share(ChildEdge[] edges)
    {
        if (_sharedEdges.TryGetValue(edges, out var shared))
        {
            return shared;
        }

        _sharedEdges.Add(edges);
        return edges;
    }

    /// <summary>Builds the children of a level: its edges, expanded by the edges of the levels they lead to while these are few.</summary>
    /// <param name="level">Remaining levels of the parent.</param>
    /// <param name="edges">The edges of the level.</param>
    /// <param name="edgesAt">Gives the edges of a lower level by its remaining levels; it is never called for a base mesh.</param>
    public ChildInstance[] ExpandChildren(long level, ChildEdge[] edges, Func<long, ChildEdge[]> edgesAt)
    {
        if (IsPick(edges))
        {
            return Array.ConvertAll(edges, edge => GetOrCreate([edge]));
        }

        if (edges.Length > MaxChildrenForSameLevel && !LeadToNothing(level, edges, edgesAt))
        {
            // Too many to expand, and perhaps so many that the list would take more memory than they do.
            return GetOrCreateAll(edges);
        }

        var chains = edges.Select(edge => new EdgeChain([edge], edge.RemainingLevels(level))).ToList();
        var best = chains;
        var bestHasSameLevel = HaveSameLevel(chains);
        for (var expandedLevels = 1; expandedLevels < MaxExpandedLevels; expandedLevels++)
        {
            // The highest level is expanded first, so that all chains come to end at the same level and few levels are ever visited.
            var highestLevel = HighestLevel(chains);
            if (highestLevel < baseCount)
            {
                break;
            }

            var nextEdges = edgesAt(highestLevel);
            if (IsPick(nextEdges) || !CanExpand(chains, highestLevel, nextEdges.Length))
            {
                break;
            }

            chains = Expand(chains, highestLevel, nextEdges);
            var haveSameLevel = HaveSameLevel(chains);
            if (chains.Count <= MaxChildren ? haveSameLevel || !bestHasSameLevel : haveSameLevel && !bestHasSameLevel)
            {
                best = chains;
                bestHasSameLevel = haveSameLevel;
            }
        }

        return [.. best.Select(chain => GetOrCreate(chain.Edges))];
    }

    /// <summary>Tells whether chance decides about edges: only a search knows which one stands there.</summary>
    private static bool IsPick(ChildEdge[] edges) => edges is [{ Set.Pick: not null }, ..];

    /// <summary>Tells whether the highest level that edges lead to has no edges itself.</summary>
    private bool LeadToNothing(long level, ChildEdge[] edges, Func<long, ChildEdge[]> edgesAt)
    {
        var highest = edges.Select(edge => edge.RemainingLevels(level)).DefaultIfEmpty().Max();
        return highest >= baseCount && edgesAt(highest).Length == 0;
    }

    /// <summary>The children of a level that is too wide to be expanded: one for each edge, shared by levels with these edges.</summary>
    private ChildInstance[] GetOrCreateAll(ChildEdge[] edges)
    {
        if (_wideLevels.TryGetValue(edges, out var known))
        {
            return known;
        }

        // Not looked for among those of other levels: that would take as much memory as they do.
        ChildInstance[] children = [.. Enumerable.Range(0, edges.Length).Select(i => new ChildInstance(edges, i, 1))];
        _wideLevels.Add(edges, children);
        return children;
    }

    private static long HighestLevel(List<EdgeChain> chains) =>
        chains.Select(static chain => chain.RemainingLevels).DefaultIfEmpty().Max();

    private static List<EdgeChain> Expand(List<EdgeChain> chains, long level, ChildEdge[] nextEdges)
    {
        var expanded = new List<EdgeChain>(chains.Count + nextEdges.Length);
        foreach (var chain in chains)
        {
            if (chain.RemainingLevels < level)
            {
                expanded.Add(chain);
                continue;
            }

            foreach (var edge in nextEdges)
            {
                expanded.Add(chain.Append(edge));
            }
        }

        return expanded;
    }

    /// <summary>Tells whether the chains to a level may be followed by the edges of that level.</summary>
    private bool CanExpand(List<EdgeChain> chains, long level, int edgeCount)
    {
        var count = 0L;
        foreach (var chain in chains)
        {
            count += chain.RemainingLevels == level ? edgeCount : 1;
            if (count > MaxChildrenForSameLevel || !CanGrow(chain))
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>True when the maps of a chain and one more stay well within the range of a double.</summary>
    private bool CanGrow(EdgeChain chain)
    {
        var inverseEntry = 1.0;
        foreach (var edge in chain.Edges)
        {
            ref var entries = ref CollectionsMarshal.GetValueRefOrAddDefault(_inverseEntries, edge.Set, out _);
            entries ??= Array.ConvertAll(edge.Set.Maps, static map => map.Inverse().Linear.MaxAbsEntry());
            inverseEntry *= Math.Max(1, entries[edge.MapIndex]);
        }

        return inverseEntry < MaxInverseEntry;
    }

    /// <summary>True when all chains that don't lead to a base mesh end at the same level.</summary>
    private bool HaveSameLevel(List<EdgeChain> chains)
    {
        var commonLevel = 0L;
        foreach (var chain in chains)
        {
            if (chain.RemainingLevels >= baseCount)
            {
                if (commonLevel > 0 && chain.RemainingLevels != commonLevel)
                {
                    return false;
                }

                commonLevel = chain.RemainingLevels;
            }
        }

        return true;
    }

    /// <summary>Adds the edges of a set: each map once that no level above offers.</summary>
    /// <param name="edges">Receives the edges.</param>
    /// <param name="offeredMaps">The maps of the levels above.</param>
    /// <param name="set">The set.</param>
    /// <param name="levelsDown">Number of levels from the parent to the children.</param>
    private static void AddEdges(List<ChildEdge> edges, HashSet<(AffineMap Map, MapColour Colour)> offeredMaps, MapSet set, long levelsDown)
    {
        // The order of the indices is sorted, since maps of wide sets are many bytes.
        var mapsOfThisLevel = new HashSet<int>(set.Maps.Length, new MapIndexComparer(set));
        for (var i = 0; i < set.Maps.Length; i++)
        {
            // A map that a level above offers is found there, provided that this level could be skipped instead.
            var isNew = set.IdentityIndex < 0 || !offeredMaps.Contains((set.Maps[i], set.ColourOf(i)));
            if (!set.IsIdentity(i) && mapsOfThisLevel.Add(i) && isNew)
            {
                edges.Add(new(set, i, LevelStep.Down(levelsDown)));
            }
        }
    }

    private ChildInstance GetOrCreate(ChildEdge[] edges)
    {
        ref var instance = ref CollectionsMarshal.GetValueRefOrAddDefault(_instances, edges, out _);
        return instance ??= new(edges);
    }

    /// <summary>Edges one after another, and the remaining levels of the sub-fractal that they lead to.</summary>
    private sealed record EdgeChain(ChildEdge[] Edges, long RemainingLevels)
    {
        public EdgeChain Append(ChildEdge edge) => new([.. Edges, edge], edge.RemainingLevels(RemainingLevels));
    }
}
