using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// Moves the bodies of an island all at once, to where their plan leads them. What the solve has left of overlaps is taken back; what it
/// did not foresee keeps bodies where they were, so that none ever enters another.
/// </summary>
internal sealed class IslandMover(
    List<Body> bodies, ContactGraph graph, BodyGrid grid, NearbyBodies nearbyBodies, int maxThreads)
{
    private const int InitialCapacity = 256;

    // Of the smaller radius: overlaps for which bodies return.
    private const double MaxOverlap = 9e-7;

    // Of the radius: how far others may have moved to where a body unexpectedly goes.
    private const double SearchMargin = 0.5;

    // Of the way that the speed tells: a body that gets less far is held up, and for how many steps it may be.
    private const double JamFraction = 0.25;
    private const int MaxJammedSteps = 8;

    private readonly OverlapSeparator _separator = new(graph, maxThreads);
    private readonly List<int> _neighbours = new(InitialCapacity);

    // Contacts that no plan knew.
    private readonly List<ContactRow> _unplanned = new(InitialCapacity);

    /// <summary>Number of times that a body had to stay where it was.</summary>
    public long ReturnCount { get; private set; }

    /// <summary>Sets the targets of all bodies of all islands, which have been planned.</summary>
    /// <param name="stepLength">Seconds.</param>
    public void SetTargets(double stepLength)
    {
        foreach (var island in graph.Islands)
        {
            foreach (var index in graph.BodiesOf(in island))
            {
                var body = bodies[index];
                body.PlannedStart = body.Position;
                body.Target = body.Position + body.PlannedWay;
                body.IsHeld = false;
            }
        }

        _separator.Reserve(bodies.Count);
    }

    /// <summary>Finds a body of no island that stands where one of an island will be. It has to go first.</summary>
    /// <param name="pairIndex">Index of the pair from which to search; receives that after the one found.</param>
    /// <returns>Null where there is none left.</returns>
    public Body? FindInTheWay(ref int pairIndex)
    {
        var pairs = graph.Pairs;
        while (pairIndex < pairs.Length)
        {
            ref readonly var pair = ref pairs[pairIndex++];
            var first = bodies[pair.First];
            var second = bodies[pair.Second];
            if (!pair.IsSecondFirm && (first.IslandIndex >= 0) != (second.IslandIndex >= 0))
            {
                var (member, single) = first.IslandIndex >= 0 ? (first, second) : (second, first);
                var distance = (member.Radius + single.Radius) * (1 - OverlapSeparator.NegligibleOverlap);
                if (!single.HasMoved && (member.Target - single.Position).LengthSquared() < distance * distance)
                {
                    return single;
                }
            }
        }

        return null;
    }

    /// <summary>Begins the motion of an island.</summary>
    public void BeginIsland() => _unplanned.Clear();

    /// <summary>Adds a surface that a body has met on its way. It gives way along the surface's plane.</summary>
    /// <param name="body">Body of the present island.</param>
    /// <param name="hit">What it has met.</param>
    public void AddSurface(Body body, in Contact hit)
    {
        var ball = body.IsCompound ? body.PlannedHitBall : 0;
        var offset = body.IsCompound ? body.PlannedOffset(ball) : Vector.Zero;
        body.IsHeld = false;
        var radius = body.BallRadius(ball);
        _unplanned.Add(new()
        {
            First = body.Index, Second = ContactRow.Firm, Offset = hit.PointToCentre(body.PlannedStart + offset), MinDistance = radius,
            Normal = hit.CachedNormal, FirstRadius = radius,
        });
    }

    /// <summary>Puts an island back to where its step began, unless others have come there.</summary>
    public bool TryReturn(in Island island)
    {
        var members = graph.BodiesOf(in island);
        foreach (var index in members)
        {
            bodies[index].CheckedTarget = bodies[index].Position;
            bodies[index].MovedOrientation = bodies[index].Orientation;
            PutBack(bodies[index]);
        }

        var isFree = true;
        foreach (var index in members)
        {
            isFree &= !OverlapsOthers(bodies[index]);
        }

        foreach (var index in isFree ? [] : members)
        {
            bodies[index].Position = bodies[index].CheckedTarget;
            bodies[index].SetOrientation(bodies[index].MovedOrientation);
            grid.Update(index);
        }

        return isFree;
    }

    /// <summary>True where a body overlaps one that is not of its island.</summary>
    private bool OverlapsOthers(Body body)
    {
        _neighbours.Clear();
        nearbyBodies.CollectOverlaps(body.Position, body.Radius * (1 - MaxOverlap), body.Index, _neighbours);
        foreach (var neighbour in _neighbours)
        {
            if (bodies[neighbour].IslandIndex != body.IslandIndex && BallPairs.AreOverlapping(body, bodies[neighbour], MaxOverlap))
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>Finds bodies that others meet which have got farther than was foreseen.</summary>
    public void FindUnplanned(in Island island, double stepLength)
    {
        foreach (var index in graph.BodiesOf(in island))
        {
            var body = bodies[index];
            if (!HasDeviated(body, body.Target, stepLength))
            {
                continue;
            }

            _neighbours.Clear();
            nearbyBodies.CollectOverlaps(body.Target, body.Radius * (1 + SearchMargin), index, _neighbours);
            foreach (var neighbour in _neighbours)
            {
                var other = bodies[neighbour];
                if (other.IslandIndex == body.IslandIndex && !body.IsCompound && !other.IsCompound
                    && (body.Target - other.Target).Length() < (body.Radius + other.Radius) * (1 - OverlapSeparator.NegligibleOverlap))
                {
                    _unplanned.Add(new()
                    {
                        First = index, Second = neighbour, Offset = body.PlannedStart - other.PlannedStart,
                        MinDistance = body.Radius + other.Radius, IsBall = true, FirstRadius = body.Radius, SecondRadius = other.Radius,
                    });
                }
            }
        }
    }

    /// <summary>Changes the targets until the bodies overlap as little as the contacts tell. What is held gives way to nothing.</summary>
    public void SeparateTargets(in Island island)
    {
        var members = graph.BodiesOf(in island);
        foreach (var index in members)
        {
            var body = bodies[index];
            _separator.SetBody(index, body.Target - body.PlannedStart, body.IsHeld ? 0 : 1 / body.Description.Mass);
        }

        _separator.Separate(in island, CollectionsMarshal.AsSpan(_unplanned));
        foreach (var index in members)
        {
            if (_separator.HasMoved(index))
            {
                bodies[index].Target = bodies[index].PlannedStart + _separator.WayOf(index);
            }
        }
    }

    /// <summary>
    /// Puts bodies back to where they were that now overlap others, after those of all islands have moved. What returns may overlap
    /// others in turn, which return as well; where all began, none overlapped.
    /// </summary>
    public void ReturnOverlapping()
    {
        foreach (var island in graph.Islands)
        {
            foreach (var index in graph.BodiesOf(in island))
            {
                grid.Update(index);
            }
        }

        while (ReturnPairs() || ReturnBeyondReach())
        {
        }
    }

    /// <summary>Slows down bodies that others have held up for some steps in a row: in a jam they would push for ever.</summary>
    /// <param name="island">Has moved, and its bodies have their new velocities.</param>
    /// <param name="stepLength">Seconds.</param>
    public void DampJammed(in Island island, double stepLength)
    {
        foreach (var index in graph.BodiesOf(in island))
        {
            var body = bodies[index];
            var way = JamFraction * stepLength * body.Velocity;
            var isJammed = (body.Position - body.PlannedStart).LengthSquared() < way.LengthSquared();
            body.JammedSteps = isJammed ? body.JammedSteps + 1 : 0;
            if (body.JammedSteps >= MaxJammedSteps)
            {
                body.Velocity *= 0.5;
                body.AngularVelocity *= 0.5;
            }
        }
    }

    private bool HasDeviated(Body body, Vector position, double stepLength)
    {
        var free = body.PlannedStart + (stepLength * (body.PlannedVelocity + (0.5 * stepLength * body.FreeAcceleration)));
        var limit = graph.DeviationLimit(body.Index);
        return (position - free).LengthSquared() > limit * limit;
    }

    private bool ReturnPairs()
    {
        var hasReturned = false;
        foreach (ref readonly var pair in graph.Pairs)
        {
            var first = bodies[pair.First];
            var second = bodies[pair.Second];
            if (BallPairs.AreOverlapping(first, second, MaxOverlap))
            {
                hasReturned |= Return(first);
                hasReturned |= Return(second);
            }
        }

        return hasReturned;
    }

    /// <summary>Puts bodies back that have got farther than any pair foresees and overlap any other, and that one with them.</summary>
    private bool ReturnBeyondReach()
    {
        var hasReturned = false;
        foreach (var island in graph.Islands)
        {
            foreach (var index in graph.BodiesOf(in island))
            {
                if (graph.IsBeyondReach(bodies[index]))
                {
                    hasReturned |= ReturnAmongAll(bodies[index]);
                }
            }
        }

        return hasReturned;
    }

    private bool ReturnAmongAll(Body body)
    {
        _neighbours.Clear();
        nearbyBodies.CollectOverlaps(
            body.Position, body.Radius * (1 - MaxOverlap), body.Index, _neighbours);
        var hasReturned = false;
        foreach (var neighbour in _neighbours)
        {
            if (BallPairs.AreOverlapping(body, bodies[neighbour], MaxOverlap))
            {
                hasReturned |= Return(body);
                hasReturned |= Return(bodies[neighbour]);
            }
        }

        return hasReturned;
    }

    private bool Return(Body body)
    {
        if (body.IslandIndex < 0
            || (body.Position == body.PlannedStart && (!body.IsCompound || body.Orientation == body.PlannedStartOrientation)))
        {
            return false;
        }

        ReturnCount++;
        PutBack(body);
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
