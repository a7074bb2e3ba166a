using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Separation;

/// <summary>What keeps bodies of islands from each other where their plans do not work out.</summary>
internal sealed class IslandMover(List<Body> bodies, IslandSet islands, BodyGrid grid, NearbyBodies nearbyBodies)
{
    // Relative to the distance at which two touch.
    private const double NegligibleOverlap = 3e-7;

    private readonly List<int> _neighbours = [];

    // In which round of the step a body has returned, counted from 1.
    private int[] _returnedIn = [];
    private int _round;

    /// <summary>Number of times that a body had to stay where it was.</summary>
    public long ReturnCount { get; private set; }

    /// <summary>Makes room for the bodies of a world.</summary>
    public void Reserve(int bodyCount)
    {
        _neighbours.EnsureCapacity(bodyCount);
        _returnedIn = new int[bodyCount];
    }

    /// <summary>Finds a body of no island that stands where one of an island will be. It has to go first.</summary>
    /// <param name="pairIndex">Index of the pair from which to search; receives that after the one found.</param>
    /// <returns>Null where there is none left.</returns>
    public Body? FindObstructing(ref int pairIndex)
    {
        var pairs = islands.All is [var only] && only.BodyCount == bodies.Count ? [] : islands.Graph.Pairs;
        while (pairIndex < pairs.Length)
        {
            ref readonly var pair = ref pairs[pairIndex++];
            if (!pair.IsSecondImmovable && (islands.IslandOf(pair.First) >= 0) != (islands.IslandOf(pair.Second) >= 0))
            {
                var isFirstMember = islands.IslandOf(pair.First) >= 0;
                var member = bodies[isFirstMember ? pair.First : pair.Second];
                var single = bodies[isFirstMember ? pair.Second : pair.First];
                var distance = (member.Radius + single.Radius) * (1 - NegligibleOverlap);
                if (!single.HasMoved && (member.Target - single.Position).LengthSquared() < distance * distance)
                {
                    return single;
                }
            }
        }

        return null;
    }

    /// <summary>
    /// Puts bodies back to where they were that now overlap others, after those of all islands have moved. What returns may overlap
    /// others in turn, which return as well; where all began, none overlapped, or no less deeply.
    /// </summary>
    /// <param name="mayBeDeep">True where bodies of islands may overlap deeply; else it is looked at those that something has held.</param>
    public void ReturnOverlapping(bool mayBeDeep)
    {
        foreach (var body in bodies)
        {
            mayBeDeep |= body.IslandIndex >= 0 && body.IsHeld;
        }

        if (!mayBeDeep)
        {
            return;
        }

        foreach (var island in islands.All)
        {
            foreach (var index in islands.BodiesOf(in island))
            {
                grid.Update(index);
            }
        }

        Array.Clear(_returnedIn, 0, bodies.Count);
        _round = 0;
        while (ReturnOnce())
        {
        }
    }

    /// <summary>Puts both of two bodies back that overlap, unless they do so less than before.</summary>
    private bool Return(Body first, Body second) => (first.IslandIndex >= 0 || second.IslandIndex >= 0)
        && BallPairs.AreOverlapping(first, second, ContactTolerances.MaxOverlap)
        && (first.IsCompound || second.IsCompound
            || (first.Position - second.Position).LengthSquared() < (StartOf(first) - StartOf(second)).LengthSquared())
        && (Return(first) | Return(second));

    private static Vector StartOf(Body body) => body.IslandIndex >= 0 ? body.PlannedStart : body.Position;

    /// <summary>
    /// Looks for what bodies overlap that have gone a way; after the first round, for what those overlap that returned in the one before.
    /// Pairs are known, but for those of bodies that got farther than was foreseen, or are of no island and have moved ahead.
    /// </summary>
    /// <returns>True where a body has returned.</returns>
    private bool ReturnOnce()
    {
        var last = _round++;
        var hasReturned = false;
        foreach (ref readonly var pair in islands.Graph.Pairs)
        {
            if (last == 0 || _returnedIn[pair.First] == last || _returnedIn[pair.Second] == last)
            {
                hasReturned |= Return(bodies[pair.First], bodies[pair.Second]);
            }
        }

        foreach (var body in bodies)
        {
            if (last == 0 ? MayMeetUnknown(body) : _returnedIn[body.Index] == last)
            {
                hasReturned |= ReturnAmongAll(body);
            }
        }

        return hasReturned;
    }

    private bool MayMeetUnknown(Body body) =>
        HasGone(body) ? islands.Graph.HasDeviated(body.Index, body.Position - body.PlannedStart) : body.HasMoved;

    private static bool HasGone(Body body) => body.IslandIndex >= 0
        && (body.Position != body.PlannedStart || (body.IsCompound && body.Orientation != body.PlannedStartOrientation));

    private bool ReturnAmongAll(Body body)
    {
        _neighbours.Clear();
        nearbyBodies.CollectOverlaps(body.Position, body.Radius, body.Index, _neighbours);
        var hasReturned = false;
        foreach (var neighbour in _neighbours)
        {
            hasReturned |= Return(body, bodies[neighbour]);
        }

        return hasReturned;
    }

    private bool Return(Body body)
    {
        if (!HasGone(body) || body.BeganDeep)
        {
            return false;
        }

        ReturnCount++;
        _returnedIn[body.Index] = _round;
        PutBack(body);
        // It has gone no way on which anything could have made it faster.
        body.LimitEnergy(body.PlannedStartEnergy);
        return true;
    }

    private void PutBack(Body body)
    {
        body.Position = body.PlannedStart;
        grid.Update(body.Index);
        if (body.IsCompound)
        {
            body.SetOrientation(body.PlannedStartOrientation);
        }
    }
}
