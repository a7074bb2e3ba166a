using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>Finds the pairs of bodies that touch, and those that are near, on all threads.</summary>
internal sealed class PairSearch(List<Body> bodies, NearbyBodies nearbyBodies, int maxThreads)
{
    // More than rounding takes from a distance.
    private const double RoundingFactor = 1 - 1e-9;

    private readonly NeighbourGrid _grid = new();
    private GroupSearch[] _searches = [];

    /// <summary>The bodies as they were copied when the step began.</summary>
    public BodyCopies Copies { get; } = new(bodies, maxThreads);

    /// <summary>What the groups of bodies have found, in their order.</summary>
    public ReadOnlySpan<GroupSearch> Results => _searches.AsSpan(0, Copies.Groups.Length);

    /// <summary>Makes room for the bodies of a world, and their pairs.</summary>
    public void Reserve(int bodyCount, int pairCount)
    {
        Copies.Reserve(bodyCount);
        _grid.Reserve(bodyCount);
        var groupCount = Copies.Groups.Length;
        var searchCount = Math.Min(2 * groupCount, BodyCopies.MaxGroups);
        _searches = [.. Enumerable.Range(0, searchCount).Select(_ => new GroupSearch(pairCount / groupCount))];
    }

    /// <summary>Finds all pairs of bodies that touch. Only those search that may: most bodies in flight have met no other.</summary>
    /// <returns>Index of a body that sleeps and is hit; negative for none.</returns>
    public int Run()
    {
        _grid.Build(nearbyBodies.HasFilters ? [] : Copies.All, Copies.Bounds);
        WorkerSet.Shared.Run(
            Copies.Groups.Length, _grid.IsBuilt ? maxThreads : 1, this, static (search, group) => search.RunSearch(group));
        foreach (var search in Results)
        {
            if (search.Sleeper >= 0)
            {
                return search.Sleeper;
            }
        }

        return -1;
    }

    private void RunSearch(int index)
    {
        var search = _searches[index];
        search.Pairs.Clear();
        search.NearPairs.Clear();
        search.Sleeper = -1;
        var (first, end) = Copies.BodiesOf(index);
        for (var i = first; i < end && search.Sleeper < 0; i++)
        {
            if (Copies[i].MaySearch)
            {
                CollectTouching(i, search);
            }
        }
    }

    /// <summary>Finds the pairs of a body that touch, and those that are near, each of them once among all bodies.</summary>
    private void CollectTouching(int index, GroupSearch search)
    {
        ref readonly var body = ref Copies[index];
        var maxTouchGap = 2 * BodyCopies.TouchDistanceOf(in body);
        search.Neighbours.Clear();
        CollectOverlaps(body.Position, body.Radius + body.NearDistance, index, search.Neighbours);
        var (firstPair, firstNear) = (search.Pairs.Count, search.NearPairs.Count);
        foreach (var neighbour in CollectionsMarshal.AsSpan(search.Neighbours))
        {
            ref readonly var other = ref Copies[neighbour];
            if (neighbour < index && IsFoundBy(in other, in body))
            {
                continue;
            }

            var maxDistance = body.Radius + other.Radius + Math.Max(maxTouchGap, body.NearDistance);
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
            else if (!isTouching && gap <= body.NearDistance && !(neighbour < index && gap <= other.NearDistance))
            {
                search.NearPairs.Add(new(isInOrder ? new(index, neighbour, isImmovable, false) : new(neighbour, index, false, false), gap));
            }
        }

        // By the other body's index, whichever way it was found.
        SortByBodies(CollectionsMarshal.AsSpan(search.Pairs)[firstPair..]);
        SortByBodies(CollectionsMarshal.AsSpan(search.NearPairs)[firstNear..]);
        if (Copies.HasSleeping)
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
    private void FindSleeper(int index, ReadOnlySpan<BodyPair> pairs, GroupSearch search)
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
    public static void SortByBodies<T>(Span<T> pairs)
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
    public double GapOf(int index, int neighbour, bool isInOrder)
    {
        ref readonly var first = ref Copies[isInOrder ? index : neighbour];
        ref readonly var second = ref Copies[isInOrder ? neighbour : index];
        return (first.Position - second.Position).Length() - first.Radius - second.Radius;
    }

    /// <summary>True where two bodies touch, the first of which stands for the position of both.</summary>
    public bool AreTouching(int index, int neighbour, bool isInOrder, double gap)
    {
        var (firstIndex, secondIndex) = isInOrder ? (index, neighbour) : (neighbour, index);
        ref readonly var first = ref Copies[firstIndex];
        ref readonly var second = ref Copies[secondIndex];
        return first.IsCompound || second.IsCompound ? BallPairs.AreTouching(bodies[firstIndex], bodies[secondIndex])
            : gap <= ContactTolerances.TouchDistance(
                Math.Min(first.Radius, second.Radius), first.Rounding, first.HasHeapMargin && second.HasHeapMargin);
    }

    /// <summary>What a group of bodies has found.</summary>
    internal sealed class GroupSearch(int capacity)
    {
        /// <summary>The bodies near one of the group.</summary>
        public List<int> Neighbours { get; } = new(capacity);

        /// <summary>The pairs that touch, in the order of their searching body. Some groups have more than their share.</summary>
        public List<BodyPair> Pairs { get; } = new(2 * capacity);

        /// <summary>The pairs that are near and do not touch, in the order of their searching body.</summary>
        public List<NearPair> NearPairs { get; } = new(2 * capacity);

        /// <summary>Index of a body that sleeps and is hit; negative for none.</summary>
        public int Sleeper { get; set; }
    }
}
