using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// Moves the bodies of an island all at once, to where their plan leads them. What the solve has left of overlaps is taken back; what it
/// did not foresee keeps bodies where they were, so that none ever enters another.
/// </summary>
internal sealed class IslandMover(List<Body> bodies, ContactGraph graph, BodyGrid grid, NearbyBodies nearbyBodies)
{
    private const int InitialCapacity = 256;

    // Of the smaller radius: overlaps for which bodies return.
    private const double MaxOverlap = 9e-7;

    // Of the radius: how far others may have moved to where a body unexpectedly goes.
    private const double SearchMargin = 0.5;

    private readonly OverlapSeparator _separator = new();
    private readonly List<int> _neighbours = new(InitialCapacity);

    // Contacts that no plan knew.
    private readonly List<ContactRow> _unplanned = new(InitialCapacity);

    /// <summary>Number of times that a body had to stay where it was.</summary>
    public long ReturnCount { get; private set; }

    /// <summary>Sets the targets of all bodies of an island.</summary>
    /// <param name="island">Planned.</param>
    /// <param name="stepLength">Seconds.</param>
    public void SetTargets(in Island island, double stepLength)
    {
        foreach (var index in graph.BodiesOf(in island))
        {
            var body = bodies[index];
            body.PlannedStart = body.Position;
            body.Target = body.Position + (stepLength * (body.Velocity + (0.5 * stepLength * body.NetAcceleration)));
            body.IsHeld = false;
        }

        _separator.Reserve(bodies.Count);
        _unplanned.Clear();
    }

    /// <summary>Adds a surface that a body has met on its way. It gives way along the surface's plane.</summary>
    /// <param name="body">Body of the present island.</param>
    /// <param name="hit">What it has met.</param>
    public void AddSurface(Body body, in Contact hit)
    {
        body.IsHeld = false;
        _unplanned.Add(new()
        {
            First = body.Index, Second = ContactRow.Firm, Offset = hit.PointToCentre(body.PlannedStart), MinDistance = body.Radius,
            Normal = hit.CachedNormal, FirstRadius = body.Radius,
        });
    }

    /// <summary>Puts an island back to where its step began, unless others have come there.</summary>
    public bool TryReturn(in Island island)
    {
        foreach (var index in graph.BodiesOf(in island))
        {
            var body = bodies[index];
            _neighbours.Clear();
            nearbyBodies.CollectOverlaps(
                new(body.PlannedStart, body.PlannedStart), body.Radius * (1 - MaxOverlap), index, _neighbours);
            foreach (var neighbour in _neighbours)
            {
                if (bodies[neighbour].IslandIndex != body.IslandIndex)
                {
                    return false;
                }
            }
        }

        foreach (var index in graph.BodiesOf(in island))
        {
            bodies[index].Position = bodies[index].PlannedStart;
            grid.Update(index);
        }

        return true;
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
            nearbyBodies.CollectOverlaps(new(body.Target, body.Target), body.Radius * (1 + SearchMargin), index, _neighbours);
            foreach (var neighbour in _neighbours)
            {
                var other = bodies[neighbour];
                if (other.IslandIndex == body.IslandIndex
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

        _separator.Separate(graph.RowsOf(in island), CollectionsMarshal.AsSpan(_unplanned));
        foreach (var index in members)
        {
            if (_separator.HasMoved(index))
            {
                bodies[index].Target = bodies[index].PlannedStart + _separator.WayOf(index);
            }
        }
    }

    /// <summary>Puts bodies back to where they were that now overlap others, after all of an island have moved.</summary>
    public void ReturnOverlapping(in Island island, double stepLength)
    {
        var members = graph.BodiesOf(in island);
        foreach (var index in members)
        {
            grid.Update(index);
        }

        var hasReturned = false;
        foreach (var index in members)
        {
            var body = bodies[index];
            if (HasDeviated(body, body.Position, stepLength))
            {
                hasReturned |= ReturnAmongAll(body);
            }
        }

        do
        {
            hasReturned = ReturnOverlapping(graph.RowsOf(in island));
        }
        while (hasReturned);
    }

    private bool HasDeviated(Body body, Vector position, double stepLength)
    {
        var free = body.PlannedStart + (stepLength * (body.PlannedVelocity + (0.5 * stepLength * body.FreeAcceleration)));
        var limit = graph.DeviationLimit(body.Index);
        return (position - free).LengthSquared() > limit * limit;
    }

    private bool ReturnOverlapping(Span<ContactRow> rows)
    {
        var hasReturned = false;
        foreach (ref readonly var row in rows)
        {
            if (!row.IsBall)
            {
                continue;
            }

            var first = bodies[row.First];
            var second = row.Second >= 0 ? bodies[row.Second] : null;
            var offset = row.Offset + (first.Position - first.PlannedStart);
            if (second is not null)
            {
                offset -= second.Position - second.PlannedStart;
            }

            var least = row.MinDistance * (1 - (MaxOverlap * row.SmallerRadiusShare));
            if (offset.LengthSquared() < least * least)
            {
                hasReturned |= Return(first);
                hasReturned |= second is not null && Return(second);
            }
        }

        return hasReturned;
    }

    /// <summary>Puts a body back that overlaps any other, and that one with it.</summary>
    private bool ReturnAmongAll(Body body)
    {
        _neighbours.Clear();
        nearbyBodies.CollectOverlaps(
            new(body.Position, body.Position), body.Radius * (1 - MaxOverlap), body.Index, _neighbours);
        var hasReturned = false;
        foreach (var neighbour in _neighbours)
        {
            hasReturned |= Return(body);
            hasReturned |= bodies[neighbour].IslandIndex == body.IslandIndex && Return(bodies[neighbour]);
        }

        return hasReturned;
    }

    private bool Return(Body body)
    {
        if (body.Position == body.PlannedStart)
        {
            return false;
        }

        ReturnCount++;
        body.Position = body.PlannedStart;
        grid.Update(body.Index);
        return true;
    }
}
