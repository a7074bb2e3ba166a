using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>Says which copies sub-fractals are made of, so that no instance is reached in two ways, and makes each copy once.</summary>
internal sealed class ChildInstanceBuilder
{
    private const int MaxEdges = 256;

    // A sub-fractal is opened over several levels at once, as long as its copies are no more than these: to look at some
    // more boxes, four at a time, costs less than to go down one level after another.
    private const int MaxChildren = 32;
    private const int MaxChildrenForSameLevel = 48;


    /// <summary>Copies are of sub-fractals at most so many rounds further down.</summary>
    public const int MaxExpandedLevels = 16;

    private readonly Dictionary<ChildEdge[], ChildInstance> _instances = new(new EdgeSequenceComparer());

    /// <summary>
    /// The steps of a level: its own maps, then, where its identity lets it be passed over, those that the next levels of the same
    /// repetition add, and last what is below the repetition, if all of it can be passed over.
    /// </summary>
    /// <param name="level">Levels left.</param>
    /// <param name="levelsBelowRepetition">The levels below the repetition that the level belongs to.</param>
    /// <param name="period">After so many levels their sets are the same again.</param>
    /// <param name="set">The level's.</param>
    /// <param name="setAt">The sets of the levels below.</param>
    public static ChildEdge[] EdgesAt(long level, long levelsBelowRepetition, int period, MapSet set, Func<long, MapSet> setAt)
    {
        var edges = new List<ChildEdge>();
        var offeredMaps = new HashSet<AffineMap>();
        for (var (currentSet, levelsDown) = (set, 1L); ; levelsDown++)
        {
            AddEdges(edges, offeredMaps, currentSet, levelsDown);
            if (currentSet.IdentityIndex < 0)
            {
                return [.. edges];
            }

            // All sets of the repetition have been seen, and all have the identity.
            if (level - levelsDown == levelsBelowRepetition || levelsDown == period)
            {
                return [.. edges, ChildEdge.SkipTo(levelsBelowRepetition)];
            }

            if (edges.Count > MaxEdges)
            {
                // Short lists matter more than the last duplicate: the rest is left to the next level, as it stands.
                return [.. edges, new(MapSet.Identity, 0, LevelStep.Down(levelsDown))];
            }

            currentSet = setAt(level - levelsDown);
        }
    }

    /// <summary>The copies of a level: its steps, followed by the steps of what they lead to, as long as they are few.</summary>
    /// <param name="level">Levels left.</param>
    /// <param name="edges">Of the level.</param>
    /// <param name="edgesAt">Of the levels below; none of the base.</param>
    public ChildInstance[] ExpandChildren(long level, ChildEdge[] edges, Func<long, ChildEdge[]> edgesAt)
    {
        List<(ChildEdge[] Steps, long Below)> chains = [.. edges.Select(edge => ((ChildEdge[])[edge], edge.RemainingLevels(level)))];
        var (best, bestHasSameLevel) = (chains, HaveSameLevel(chains));
        for (var expandedLevels = 1; expandedLevels < MaxExpandedLevels; expandedLevels++)
        {
            // The largest first, so that all come to be of the same level, and few levels are ever looked at.
            var highestLevel = chains.Select(chain => chain.Below).DefaultIfEmpty().Max();
            var nextEdges = highestLevel == 0 ? [] : edgesAt(highestLevel);
            if (highestLevel == 0 || chains.Sum(chain => chain.Below == highestLevel ? nextEdges.Length : 1) > MaxChildrenForSameLevel)
            {
                break;
            }

            chains = [.. chains.SelectMany(chain => chain.Below < highestLevel
                ? [chain]
                : nextEdges.Select(edge => ((ChildEdge[])[.. chain.Steps, edge], edge.RemainingLevels(highestLevel))))];
            var haveSameLevel = HaveSameLevel(chains);
            if (chains.Count <= MaxChildren ? haveSameLevel || !bestHasSameLevel : haveSameLevel && !bestHasSameLevel)
            {
                (best, bestHasSameLevel) = (chains, haveSameLevel);
            }
        }

        return [.. best.Select(chain => GetOrCreate(chain.Steps))];
    }

    /// <summary>True when all that is not the base is of the same level.</summary>
    private static bool HaveSameLevel(List<(ChildEdge[] Steps, long Below)> chains) =>
        chains.Where(chain => chain.Below > 0).Select(chain => chain.Below).Distinct().Count() <= 1;

    private static void AddEdges(List<ChildEdge> edges, HashSet<AffineMap> offeredMaps, MapSet set, long levelsDown)
    {
        var mapsOfThisLevel = new HashSet<AffineMap>();
        for (var i = 0; i < set.Maps.Length; i++)
        {
            // What a level above offers is found there, provided that this level could be passed over instead.
            var isNew = offeredMaps.Add(set.Maps[i]) || set.IdentityIndex < 0;
            if (set.Maps[i] != AffineMap.Identity && mapsOfThisLevel.Add(set.Maps[i]) && isNew)
            {
                edges.Add(new(set, i, LevelStep.Down(levelsDown)));
            }
        }
    }

    private ChildInstance GetOrCreate(ChildEdge[] edges)
    {
        if (!_instances.TryGetValue(edges, out var instance))
        {
            _instances[edges] = instance = new(edges);
        }

        return instance;
    }

    private sealed class EdgeSequenceComparer : IEqualityComparer<ChildEdge[]>
    {
        public bool Equals(ChildEdge[]? edges1, ChildEdge[]? edges2) => edges1.AsSpan().SequenceEqual(edges2);

        public int GetHashCode(ChildEdge[] edges) => edges.Aggregate(0, HashCode.Combine);
    }
}
