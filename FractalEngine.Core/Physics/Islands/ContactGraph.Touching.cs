using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Islands;

/// <content>How the pairs that touch are found, on all threads.</content>
internal sealed partial class ContactGraph
{
    // Bodies are searched for in groups, each of which has its own lists: at most so many groups, of at least so many bodies.
    private const int MaxSearches = 64;
    private const int MinBodiesOfSearch = 64;

    // More than rounding takes from a distance.
    private const double RoundingFactor = 1 - 1e-9;

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
        if (!_mayHavePairs)
        {
            return false;
        }

        WorkerSet.Shared.Run(_searchCount, _grid.IsBuilt ? maxThreads : 1, _runSearch!);
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

    private void ReserveSearches(int pairCount)
    {
        SetSearches();
        foreach (var search in _searches.AsSpan(0, Math.Min(2 * _searchCount, MaxSearches)))
        {
            // Some may have more than their share.
            search.Neighbours.EnsureCapacity(pairCount / _searchCount);
            search.NearPairs.EnsureCapacity(2 * pairCount / _searchCount);
            search.Pairs.EnsureCapacity(2 * pairCount / _searchCount);
        }
    }

    /// <summary>Sets the groups in which bodies are searched for.</summary>
    private void SetSearches()
    {
        _bodiesPerSearch = Math.Max(MinBodiesOfSearch, (bodies.Count + MaxSearches - 1) / MaxSearches);
        _searchCount = (bodies.Count + _bodiesPerSearch - 1) / _bodiesPerSearch;
    }

    private (int First, int End) BodiesOfSearch(int index) =>
        (index * _bodiesPerSearch, Math.Min(bodies.Count, (index + 1) * _bodiesPerSearch));

    private void RunSearch(int index)
    {
        var search = _searches[index];
        search.Pairs.Clear();
        search.NearPairs.Clear();
        search.Sleeper = -1;
        var (first, end) = BodiesOfSearch(index);
        for (var i = first; i < end && search.Sleeper < 0; i++)
        {
            if (_states[i].MaySearch)
            {
                CollectTouching(i, search);
            }
        }
    }

    private static double TouchDistanceOf(in GraphBody body) =>
        (body.HasHeapMargin ? ContactTolerances.HeapMargin * body.Radius : 0) + ContactTolerances.Slop(body.Radius, body.Position);

    /// <summary>What a body may meet lies among the neighbours that it may touch, unless it is fast.</summary>
    private void SetSearchDistance(ref GraphBody body)
    {
        var reach = body.CanMove ? ReachOf(in body) : 0;
        var isFast = 2 * reach > MaxEarlyDistance * body.Radius;
        body.SearchReach = isFast ? 0 : reach;
        body.NearDistance = body.MaySearch ? Math.Max(TouchDistanceOf(in body), 2 * body.SearchReach) : double.NegativeInfinity;
    }

    /// <summary>Finds the pairs of a body that touch, and those that are near, each of them once among all bodies.</summary>
    private void CollectTouching(int index, Search search)
    {
        ref readonly var body = ref _states[index];
        var maxTouchGap = 2 * TouchDistanceOf(in body);
        search.Neighbours.Clear();
        CollectOverlaps(body.Position, body.Radius + body.NearDistance, index, search.Neighbours);
        var (firstPair, firstNear) = (search.Pairs.Count, search.NearPairs.Count);
        foreach (var neighbour in CollectionsMarshal.AsSpan(search.Neighbours))
        {
            ref readonly var other = ref _states[neighbour];
            if (neighbour < index && IsFoundBy(in other, in body))
            {
                continue;
            }

            var maxNearGap = Math.Min(body.NearDistance, body.SearchReach + other.SearchReach);
            var maxDistance = body.Radius + other.Radius + Math.Max(maxTouchGap, maxNearGap);
            if (!((body.Position - other.Position).LengthSquared() <= maxDistance * maxDistance))
            {
                continue;
            }

            var isImmovable = !other.CanMove;
            var isInOrder = isImmovable || index < neighbour;
            var gap = GapOf(index, neighbour, isInOrder);
            var isTouching = gap <= maxTouchGap && AreTouching(index, neighbour, isInOrder, gap);
            // When both search, the first one finds the pair that touches, and stores the one that both find near.
            if (isTouching && (isInOrder || !other.MaySearch))
            {
                search.Pairs.Add(isInOrder ? new(index, neighbour, isImmovable, true) : new(neighbour, index, false, true));
            }
            else if (!isTouching && gap <= maxNearGap && !(neighbour < index && gap <= other.NearDistance))
            {
                search.NearPairs.Add(new(isInOrder ? new(index, neighbour, isImmovable, false) : new(neighbour, index, false, false), gap));
            }
        }

        // By the other body's index, whichever way it was found.
        SortByBodies(CollectionsMarshal.AsSpan(search.Pairs)[firstPair..]);
        SortByBodies(CollectionsMarshal.AsSpan(search.NearPairs)[firstNear..]);
        if (HasSleeping)
        {
            FindSleeper(index, CollectionsMarshal.AsSpan(search.Pairs)[firstPair..], search);
        }
    }

    /// <summary>True for a pair that the search of its first body finds, as far as that is known without a root.</summary>
    private static bool IsFoundBy(in GraphBody first, in GraphBody second)
    {
        var distance = RoundingFactor * (first.Radius + second.Radius + first.NearDistance);
        return distance > 0 && (first.Position - second.Position).LengthSquared() < distance * distance;
    }

    /// <summary>Finds a body that sleeps and is hit.</summary>
    private void FindSleeper(int index, ReadOnlySpan<BodyPair> pairs, Search search)
    {
        foreach (ref readonly var pair in pairs)
        {
            var other = bodies[pair.First == index ? pair.Second : pair.First];
            if (other.IsAsleep && BallPairs.AreHitting(bodies[index], other))
            {
                search.Sleeper = other.Index;
                return;
            }
        }
    }

    /// <summary>Sorts the few pairs of a body.</summary>
    private static void SortByBodies<T>(Span<T> pairs)
        where T : struct, IBodyPair
    {
        for (var i = 1; i < pairs.Length; i++)
        {
            var pair = pairs[i];
            var place = i;
            for (; place > 0 && pair.Order < pairs[place - 1].Order; place--)
            {
                pairs[place] = pairs[place - 1];
            }

            pairs[place] = pair;
        }
    }

    /// <summary>Collects the bodies that a sphere overlaps where they were when they were copied.</summary>
    /// <summary>Collects the bodies that a sphere overlaps, where they are at the beginning of the step.</summary>
    public void CollectOverlaps(Vector centre, double radius, int excludedIndex, List<int> results)
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

    /// <summary>Free distance between the spheres that hold two bodies, the same bits whichever of them searches.</summary>
    private double GapOf(int index, int neighbour, bool isInOrder)
    {
        ref readonly var first = ref _states[isInOrder ? index : neighbour];
        ref readonly var second = ref _states[isInOrder ? neighbour : index];
        return (first.Position - second.Position).Length() - first.Radius - second.Radius;
    }

    /// <summary>True where two bodies touch, the first of which stands for the position of both.</summary>
    private bool AreTouching(int index, int neighbour, bool isInOrder, double gap)
    {
        var (firstIndex, secondIndex) = isInOrder ? (index, neighbour) : (neighbour, index);
        ref readonly var first = ref _states[firstIndex];
        ref readonly var second = ref _states[secondIndex];
        return first.IsCompound || second.IsCompound ? BallPairs.AreTouching(bodies[firstIndex], bodies[secondIndex])
            : gap <= ContactTolerances.TouchDistance(
                Math.Min(first.Radius, second.Radius), first.Rounding, first.HasHeapMargin && second.HasHeapMargin);
    }

    /// <summary>What a group of bodies has found.</summary>
    private sealed class Search
    {
        /// <summary>The bodies near one of the group.</summary>
        public List<int> Neighbours { get; } = [];

        /// <summary>The pairs that touch, in the order of their searching body.</summary>
        public List<BodyPair> Pairs { get; } = [];

        /// <summary>The pairs that are near and do not touch, in the order of their searching body.</summary>
        public List<NearPair> NearPairs { get; } = [];

        /// <summary>Index of a body that sleeps and is hit; negative for none.</summary>
        public int Sleeper { get; set; }

        /// <summary>True where some of the group may sleep.</summary>
        public bool HasSleeping { get; set; }

        /// <summary>True where some must look for what they may meet once more, since they are faster than was known.</summary>
        public bool HasFaster { get; set; }

        /// <summary>True where kinematic objects push some.</summary>
        public bool HasPushed { get; set; }

        /// <summary>The box of the group's centres, and its largest radius.</summary>
        public GridBounds Bounds { get; set; }
    }
}
