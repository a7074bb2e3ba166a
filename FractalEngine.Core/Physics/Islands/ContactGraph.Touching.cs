using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <content>How the pairs that touch are found, on all threads.</content>
internal sealed partial class ContactGraph
{
    // Bodies are searched for in groups, each of which has its own lists: at most so many groups, of at least so many bodies.
    private const int MaxSearches = 64;
    private const int MinBodiesOfSearch = 64;

    private readonly Search[] _searches = [.. Enumerable.Range(0, MaxSearches).Select(static _ => new Search())];
    private Action<int>? _runSearch;
    private int _bodiesPerSearch = MinBodiesOfSearch;
    private int _searchCount;

    /// <summary>Finds all pairs of bodies that touch. Only those search that may: most bodies in flight have met no other.</summary>
    /// <param name="islands">Wakes bodies that sleep and are hit.</param>
    /// <param name="stepLength">Seconds.</param>
    /// <returns>True where bodies were woken, and the pairs must be collected again.</returns>
    public bool CollectTouching(SleepIslands islands, double stepLength)
    {
        Begin(stepLength);
        _searchCount = 0;
        if (!_mayHavePairs)
        {
            return false;
        }

        _bodiesPerSearch = Math.Max(MinBodiesOfSearch, (bodies.Count + MaxSearches - 1) / MaxSearches);
        _searchCount = (bodies.Count + _bodiesPerSearch - 1) / _bodiesPerSearch;
        WorkerSet.Shared.Run(_searchCount, _grid.IsBuilt ? maxThreads : 1, _runSearch ??= RunSearch);
        foreach (var search in _searches.AsSpan(0, _searchCount))
        {
            if (search.Sleeper >= 0)
            {
                islands.Wake(bodies[search.Sleeper]);
                return true;
            }

            _pairs.AddRange(search.Pairs);
        }

        return PassPushes(islands);
    }

    /// <summary>Makes room for what bodies find, so that steps need not allocate.</summary>
    private void ReserveSearches(int pairCount)
    {
        foreach (var search in _searches)
        {
            // They may have more than their share.
            search.NearPairs.EnsureCapacity(InitialCapacity + (2 * pairCount / MaxSearches));
            search.Pairs.EnsureCapacity(InitialCapacity + (2 * pairCount / MaxSearches));
        }
    }

    private void RunSearch(int index)
    {
        var search = _searches[index];
        search.Near.Clear();
        search.Pairs.Clear();
        search.NearPairs.Clear();
        search.Sleeper = -1;
        var end = Math.Min(bodies.Count, (index + 1) * _bodiesPerSearch);
        for (var i = index * _bodiesPerSearch; i < end && search.Sleeper < 0; i++)
        {
            if (_states[i].MaySearch)
            {
                CollectTouching(i, search);
            }
        }
    }

    private static double TouchDistanceOf(in GraphBody body) =>
        body.Radius * (body.HasHeapMargin ? ContactTolerances.HeapMargin : 0) + ContactTolerances.Slop(body.Radius, body.Position);

    /// <summary>What a body may meet lies among the neighbours that it may touch, unless it is fast.</summary>
    private void SetSearchDistance(ref GraphBody body)
    {
        var reach = body.CanMove ? ReachOf(in body) : 0;
        var isFast = 2 * reach > MaxEarlyDistance * body.Radius;
        body.SearchReach = isFast ? 0 : reach;
        body.NearDistance = body.MaySearch ? Math.Max(TouchDistanceOf(in body), 2 * body.SearchReach) : double.NegativeInfinity;
    }

    private void CollectTouching(int index, Search search)
    {
        ref readonly var body = ref _states[index];
        var touchDistance = TouchDistanceOf(in body);
        search.Near.Clear();
        CollectOverlaps(body.Position, body.Radius + body.NearDistance, index, search.Near);
        search.Touching.Clear();
        var firstPair = search.NearPairs.Count;
        foreach (var neighbour in CollectionsMarshal.AsSpan(search.Near))
        {
            ref readonly var other = ref _states[neighbour];
            var gap = GapOf(index, neighbour);
            if (gap <= 2 * touchDistance)
            {
                search.Touching.Add(neighbour);
            }

            // Of two that find a pair, the first one stores it.
            if (gap <= body.NearDistance && gap <= body.SearchReach + other.SearchReach && !(neighbour < index && gap <= other.NearDistance))
            {
                AddNear(index, neighbour, search.NearPairs);
            }
        }

        CollectionsMarshal.AsSpan(search.NearPairs)[firstPair..].Sort(_compareOthers);
        search.Touching.Sort();
        foreach (var neighbour in search.Touching)
        {
            ref readonly var other = ref _states[neighbour];
            var isFirm = !other.CanMove;
            // Of two that search, the first one finds the pair.
            var isInOrder = isFirm || index < neighbour;
            if ((isInOrder || !other.MaySearch) && AreTouching(index, neighbour, isInOrder))
            {
                if (bodies[neighbour].IsAsleep && BallPairs.AreHitting(bodies[index], bodies[neighbour]))
                {
                    search.Sleeper = neighbour;
                    return;
                }

                search.Pairs.Add(isInOrder ? new(index, neighbour, isFirm, true) : new(neighbour, index, false, true));
            }
        }
    }

    /// <summary>Collects the bodies that a sphere overlaps where they were when they were copied.</summary>
    private void CollectOverlaps(Vector centre, double radius, int excludedIndex, List<int> results)
    {
        if (_grid.IsBuilt)
        {
            _grid.CollectOverlaps(centre, radius, excludedIndex, results);
        }
        else
        {
            nearbyBodies.CollectOverlaps(centre, radius, excludedIndex, results);
        }
    }

    /// <summary>True where two bodies touch, the first of which stands for the position of both.</summary>
    private bool AreTouching(int index, int neighbour, bool isInOrder)
    {
        var (firstIndex, secondIndex) = isInOrder ? (index, neighbour) : (neighbour, index);
        ref readonly var first = ref _states[firstIndex];
        ref readonly var second = ref _states[secondIndex];
        if (first.IsCompound || second.IsCompound)
        {
            return BallPairs.AreTouching(bodies[firstIndex], bodies[secondIndex]);
        }

        var gap = (first.Position - second.Position).Length() - first.Radius - second.Radius;
        return gap <= ContactTolerances.TouchDistance(
            Math.Min(first.Radius, second.Radius), first.Rounding, first.HasHeapMargin && second.HasHeapMargin);
    }

    /// <summary>What a group of bodies has found.</summary>
    private sealed class Search
    {
        /// <summary>The bodies near one of the group.</summary>
        public List<int> Near { get; } = new(InitialCapacity);

        /// <summary>The bodies that one of the group may touch.</summary>
        public List<int> Touching { get; } = new(InitialCapacity);

        /// <summary>The pairs that touch, in the order of their searching body.</summary>
        public List<BodyPair> Pairs { get; } = new(InitialCapacity);

        /// <summary>The pairs that are near and do not touch. Those that are taken are marked as contacts.</summary>
        public List<BodyPair> NearPairs { get; } = new(InitialCapacity);

        /// <summary>Index of a body that sleeps and is hit; negative for none.</summary>
        public int Sleeper { get; set; }
    }
}
