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

    /// <summary>Finds all pairs of bodies that touch. Only those search that may: most bodies in flight have met no other.</summary>
    /// <param name="islands">Wakes bodies that sleep and are hit.</param>
    /// <param name="stepLength">Seconds.</param>
    /// <returns>True where bodies were woken, and the pairs must be collected again.</returns>
    public bool CollectTouching(SleepIslands islands, double stepLength)
    {
        Begin(stepLength);
        if (!_mayHavePairs)
        {
            return false;
        }

        _bodiesPerSearch = Math.Max(MinBodiesOfSearch, (bodies.Count + MaxSearches - 1) / MaxSearches);
        var searchCount = (bodies.Count + _bodiesPerSearch - 1) / _bodiesPerSearch;
        WorkerSet.Shared.Run(searchCount, _grid.IsBuilt ? maxThreads : 1, _runSearch ??= RunSearch);
        foreach (var search in _searches.AsSpan(0, searchCount))
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
    private void ReserveSearches(int neighbourCount, int pairCount)
    {
        foreach (var search in _searches)
        {
            // They may have more than their share.
            search.Near.EnsureCapacity(InitialCapacity + (2 * neighbourCount / MaxSearches));
            search.Pairs.EnsureCapacity(InitialCapacity + (2 * pairCount / MaxSearches));
        }
    }

    private void RunSearch(int index)
    {
        var search = _searches[index];
        search.Near.Clear();
        search.Pairs.Clear();
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

    private void CollectTouching(int index, Search search)
    {
        ref var body = ref _states[index];
        var touchDistance = body.Radius * (body.HasHeapMargin ? ContactTolerances.HeapMargin : 0)
            + ContactTolerances.Slop(body.Radius, body.Position);
        // What the body may meet lies among the same neighbours.
        var distance = 2 * ReachOf(in body);
        distance = Math.Max(touchDistance, distance <= MaxEarlyDistance * body.Radius ? distance : 0);
        body.FirstNear = search.Near.Count;
        body.NearDistance = distance;
        CollectOverlaps(body.Position, body.Radius + distance, index, search.Near);
        body.NearCount = search.Near.Count - body.FirstNear;
        search.Touching.Clear();
        foreach (var neighbour in CollectionsMarshal.AsSpan(search.Near)[body.FirstNear..])
        {
            var maxDistance = body.Radius + _states[neighbour].Radius + (2 * touchDistance);
            if ((body.Position - _states[neighbour].Position).LengthSquared() <= maxDistance * maxDistance)
            {
                search.Touching.Add(neighbour);
            }
        }

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
        /// <summary>The bodies near each of the group, one list after the other.</summary>
        public List<int> Near { get; } = new(InitialCapacity);

        /// <summary>The bodies that one of the group may touch.</summary>
        public List<int> Touching { get; } = new(InitialCapacity);

        /// <summary>The pairs that touch, in the order of their searching body.</summary>
        public List<BodyPair> Pairs { get; } = new(InitialCapacity);

        /// <summary>Index of a body that sleeps and is hit; negative for none.</summary>
        public int Sleeper { get; set; }
    }
}
