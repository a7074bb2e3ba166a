using FractalEngine.Core.Physics.Bodies;

namespace FractalEngine.Core.Physics.Islands;

/// <content>How far kinematic objects push bodies, and these push others.</content>
internal sealed partial class ContactGraph
{
    /// <summary>Finds how far bodies are pushed by those that kinematic objects push, and so on.</summary>
    /// <returns>True where a body was woken.</returns>
    private bool PassPushes(SleepIslands islands)
    {
        var hasChanged = ArePushed();
        while (hasChanged)
        {
            hasChanged = false;
            foreach (var body in bodies)
            {
                if (body.KinematicPush > 0 && CanMove(body))
                {
                    if (TryWakePushed(body, islands))
                    {
                        return true;
                    }

                    hasChanged |= PassPush(body);
                }
            }
        }

        return false;
    }

    /// <summary>True where a kinematic object pushes a body.</summary>
    private bool ArePushed()
    {
        var arePushed = false;
        foreach (var search in _searches.AsSpan(0, _searchCount))
        {
            arePushed |= search.HasPushed;
        }

        return arePushed;
    }

    private void CollectPushedBy(Body body)
    {
        _neighbours.Clear();
        nearbyBodies.CollectOverlaps(body.Position, body.Radius + body.KinematicPush, body.Index, _neighbours);
        _neighbours.Sort();
    }

    private bool TryWakePushed(Body body, SleepIslands islands)
    {
        CollectPushedBy(body);
        foreach (var neighbour in _neighbours)
        {
            if (bodies[neighbour].IsAsleep)
            {
                islands.Wake(bodies[neighbour]);
                return true;
            }
        }

        return false;
    }

    private bool PassPush(Body body)
    {
        var hasChanged = false;
        CollectPushedBy(body);
        foreach (var neighbour in _neighbours)
        {
            var other = bodies[neighbour];
            var push = body.KinematicPush - Math.Max(0, (body.Position - other.Position).Length() - body.Radius - other.Radius);
            if (push > other.KinematicPush)
            {
                other.KinematicPush = push;
                hasChanged = true;
            }
        }

        return hasChanged;
    }

    /// <summary>Finds what bodies may meet that are pushed, which touch nothing yet.</summary>
    private void CollectNearPushed()
    {
        var arePushed = false;
        for (var search = 0; search < _searchCount; search++)
        {
            var (first, end) = _searches[search].HasPushed ? BodiesOfSearch(search) : default;
            for (var i = first; i < end; i++)
            {
                if (_states[i].KinematicPush > 0 && _states[i].CanMove)
                {
                    CollectNear(i);
                    arePushed = true;
                }
            }
        }

        if (arePushed)
        {
            AddFoundPairs();
        }
    }

    private bool IsPushed(in BodyPair pair) =>
        _states[pair.First].KinematicPush > 0 || (!pair.IsSecondImmovable && _states[pair.Second].KinematicPush > 0);
}
