using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Separation;

/// <summary>
/// Moves the bodies of an island all at once, to where their plan leads them. What the solve has left of overlaps is taken back; what it
/// did not foresee keeps bodies where they were, so that none ever enters another.
/// </summary>
internal sealed class IslandMover
{
    /// <summary>Relative to the smaller radius: overlaps for which balls of islands return.</summary>
    public const double MaxOverlapOfBalls = 0.05;

    // Relative to the radius: how far others may have moved to where a body unexpectedly goes.
    private const double SearchMargin = 0.5;

    // Relative to the way that the speed tells: a body that gets less far is held up, and for how many steps it may be.
    private const double JamFraction = 0.5;
    private const int MaxJammedSteps = 8;

    // Relative to the smaller radius: overlaps for which bodies return.
    private const double MaxOverlap = 9e-7;

    private readonly List<Body> _bodies;
    private readonly ContactGraph _graph;
    private readonly BodyGrid _grid;
    private readonly NearbyBodies _nearbyBodies;
    private readonly OverlapSeparator _separator;
    private readonly List<int> _neighbours = [];

    // Contacts that no plan knew.
    private readonly List<ContactRow> _unplanned = [];

    public IslandMover(List<Body> bodies, ContactGraph graph, BodyGrid grid, NearbyBodies nearbyBodies)
    {
        _bodies = bodies;
        _graph = graph;
        _grid = grid;
        _nearbyBodies = nearbyBodies;
        _separator = new(graph);
    }

    /// <summary>Number of times that a body had to stay where it was.</summary>
    public long ReturnCount { get; private set; }

    /// <summary>Makes room for the bodies of a world and their contacts.</summary>
    public void Reserve(int bodyCount, int contactCount)
    {
        _separator.Reserve(bodyCount, contactCount);
        _neighbours.EnsureCapacity(bodyCount);
        _unplanned.EnsureCapacity(bodyCount / 2);
    }

    /// <summary>Sets the targets of the bodies of an island, which have been planned.</summary>
    public void SetTargets(in Island island)
    {
        foreach (var index in _graph.BodiesOf(in island))
        {
            var body = _bodies[index];
            body.PlannedStart = body.Position;
            body.Target = body.Position + body.PlannedDisplacement;
            body.IsHeld = false;
        }
    }

    /// <summary>Finds a body of no island that stands where one of an island will be. It has to go first.</summary>
    /// <param name="pairIndex">Index of the pair from which to search; receives that after the one found.</param>
    /// <returns>Null where there is none left.</returns>
    public Body? FindObstructing(ref int pairIndex)
    {
        var pairs = _graph.Islands is [var only] && only.BodyCount == _bodies.Count ? [] : _graph.Pairs;
        while (pairIndex < pairs.Length)
        {
            ref readonly var pair = ref pairs[pairIndex++];
            if (!pair.IsSecondImmovable && (_graph.IslandOf(pair.First) >= 0) != (_graph.IslandOf(pair.Second) >= 0))
            {
                var isFirstMember = _graph.IslandOf(pair.First) >= 0;
                var member = _bodies[isFirstMember ? pair.First : pair.Second];
                var single = _bodies[isFirstMember ? pair.Second : pair.First];
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
            First = body.Index, Second = ContactRow.Immovable, Offset = hit.PointToCentre(body.PlannedStart + offset), MinDistance = radius,
            Normal = hit.CachedNormal, FirstRadius = radius,
        });
    }

    /// <summary>Sets the ways of all bodies, and finds those that others meet which have got farther than was foreseen.</summary>
    public void FindUnplanned(in Island island)
    {
        foreach (var index in _graph.BodiesOf(in island))
        {
            var body = _bodies[index];
            _separator.SetBody(index, body.Target - body.PlannedStart, body.IsHeld ? 0 : 1 / body.Description.Mass);
            if (_graph.HasDeviated(index, body.Target - body.PlannedStart))
            {
                FindUnplanned(body);
            }
        }
    }

    private void FindUnplanned(Body body)
    {
        _neighbours.Clear();
        _nearbyBodies.CollectOverlaps(body.Target, body.Radius * (1 + SearchMargin), body.Index, _neighbours);
        foreach (var neighbour in _neighbours)
        {
            var other = _bodies[neighbour];
            if (other.IslandIndex == body.IslandIndex && !body.IsCompound && !other.IsCompound
                && (body.Target - other.Target).Length() < (body.Radius + other.Radius) * (1 - OverlapSeparator.NegligibleOverlap))
            {
                _unplanned.Add(new()
                {
                    First = body.Index, Second = neighbour, Offset = body.PlannedStart - other.PlannedStart,
                    MinDistance = body.Radius + other.Radius, IsBall = true, FirstRadius = body.Radius, SecondRadius = other.Radius,
                });
            }
        }
    }

    /// <summary>Changes the targets until the bodies overlap as little as the contacts tell. What is held gives way to nothing.</summary>
    public void SeparateTargets(in Island island)
    {
        _separator.Separate(in island, CollectionsMarshal.AsSpan(_unplanned));
        foreach (var index in _graph.BodiesOf(in island))
        {
            if (_separator.HasMoved(index))
            {
                _bodies[index].Target = _bodies[index].PlannedStart + _separator.DisplacementOf(index);
            }
        }
    }

    /// <summary>Slows down bodies that others have held up for some steps in a row: in a jam they would push for ever.</summary>
    /// <param name="island">Has moved, and its bodies have their new velocities.</param>
    /// <param name="stepLength">Seconds.</param>
    public void DampJammed(in Island island, double stepLength)
    {
        foreach (var index in _graph.BodiesOf(in island))
        {
            var body = _bodies[index];
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

    /// <summary>Puts an island back to where its step began, unless others have come there.</summary>
    public bool TryReturn(in Island island)
    {
        var members = _graph.BodiesOf(in island);
        foreach (var index in members)
        {
            _bodies[index].CheckedTarget = _bodies[index].Position;
            _bodies[index].MovedOrientation = _bodies[index].Orientation;
            PutBack(_bodies[index]);
        }

        var isFree = true;
        foreach (var index in members)
        {
            isFree &= !OverlapsOthers(_bodies[index]);
        }

        foreach (var index in isFree ? [] : members)
        {
            _bodies[index].Position = _bodies[index].CheckedTarget;
            _bodies[index].SetOrientation(_bodies[index].MovedOrientation);
            _grid.Update(index);
        }

        return isFree;
    }

    /// <summary>True where a body overlaps one that is not of its island.</summary>
    private bool OverlapsOthers(Body body)
    {
        _neighbours.Clear();
        _nearbyBodies.CollectOverlaps(body.Position, body.Radius * (1 - MaxOverlap), body.Index, _neighbours);
        foreach (var neighbour in _neighbours)
        {
            if (_bodies[neighbour].IslandIndex != body.IslandIndex && BallPairs.AreOverlapping(body, _bodies[neighbour], MaxOverlap))
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>
    /// Puts bodies back to where they were that now overlap others, after those of all islands have moved. What returns may overlap
    /// others in turn, which return as well; where all began, none overlapped, or no less deeply.
    /// </summary>
    /// <param name="mayHaveDeepBalls">True where balls of islands may overlap deeply.</param>
    public void ReturnOverlapping(bool mayHaveDeepBalls)
    {
        var hasOthers = false;
        foreach (var island in _graph.Islands)
        {
            if (!mayHaveDeepBalls && island.IsOfBalls)
            {
                foreach (var index in _graph.BodiesOf(in island))
                {
                    mayHaveDeepBalls |= _bodies[index].IsHeld;
                }
            }

            hasOthers |= !island.IsOfBalls;
        }

        if (!hasOthers && !mayHaveDeepBalls)
        {
            return;
        }

        foreach (var island in _graph.Islands)
        {
            foreach (var index in _graph.BodiesOf(in island))
            {
                _grid.Update(index);
            }
        }

        while (ReturnPairs() | ReturnUnforeseen())
        {
        }
    }

    private bool ReturnPairs()
    {
        var hasReturned = false;
        foreach (ref readonly var pair in _graph.Pairs)
        {
            hasReturned |= Return(_bodies[pair.First], _bodies[pair.Second]);
        }

        return hasReturned;
    }

    /// <summary>Puts both of two bodies back that overlap.</summary>
    private bool Return(Body first, Body second)
    {
        if (first.IslandIndex < 0 && second.IslandIndex < 0)
        {
            return false;
        }

        if (HasCompound(first) || HasCompound(second))
        {
            return BallPairs.AreOverlapping(first, second, MaxOverlap) && (Return(first) | Return(second));
        }

        return BallPairs.AreOverlapping(first, second, MaxOverlapOfBalls)
            && (first.Position - second.Position).LengthSquared() < (StartOf(first) - StartOf(second)).LengthSquared()
            && (Return(first) | Return(second));
    }

    private bool HasCompound(Body body) => body.IslandIndex >= 0 && _graph.Islands[body.IslandIndex].HasCompound;

    private static Vector StartOf(Body body) => body.IslandIndex >= 0 ? body.PlannedStart : body.Position;

    /// <summary>
    /// Puts bodies back that overlap others of which no pair tells: where one has got farther than was foreseen, or was of no island and
    /// has moved ahead.
    /// </summary>
    private bool ReturnUnforeseen()
    {
        var hasReturned = false;
        foreach (var body in _bodies)
        {
            if (body.IslandIndex >= 0 ? _graph.IsBeyondReach(body) : body.HasMoved)
            {
                hasReturned |= ReturnAmongAll(body);
            }
        }

        return hasReturned;
    }

    private bool ReturnAmongAll(Body body)
    {
        _neighbours.Clear();
        _nearbyBodies.CollectOverlaps(body.Position, body.Radius, body.Index, _neighbours);
        var hasReturned = false;
        foreach (var neighbour in _neighbours)
        {
            hasReturned |= Return(body, _bodies[neighbour]);
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
        _grid.Update(body.Index);
        if (body.IsCompound)
        {
            body.SetOrientation(body.PlannedStartOrientation);
        }
    }
}
