using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>Finds and keeps what the balls of a compound touch. Obstacles must be set up for the compound.</summary>
internal sealed class CompoundContacts(Obstacles obstacles)
{
    // Relative to a ball's radius: overlaps up to this are taken back as rounding.
    private const double MaxRoundingOverlap = 1e-6;

    // Relative to a ball's radius: an edge or corner within it is met in the next moment, and acts as a plane till then. Without it a body
    // that lies on the dust of an infinite fractal would fall on one corner after the other.
    private const double MaxEdgeGap = 1e-4;

    // Relative to a ball's radius: more than the solve leaves, and less than can be seen.
    private const double MaxKinematicOverlap = 2e-6;

    private readonly NearSurfaceSearch _search = new(obstacles);
    private readonly HalfSpaces _planes = new();

    /// <summary>Removes what is not touched any more, and all other bodies, since those move.</summary>
    public void Refresh(Body body)
    {
        for (var i = 0; i < body.Balls.Length; i++)
        {
            var centre = Select(body, i);
            body.Balls[i].Contacts.Refresh(centre, obstacles.ContactSlop(centre), body.Balls[i].Radius);
        }
    }

    /// <summary>Finds the surfaces that the balls touch or may meet.</summary>
    /// <param name="body">The compound.</param>
    /// <param name="reach">How far its centre of mass may get.</param>
    /// <param name="turn">Angle by which it may turn, radians.</param>
    /// <param name="duration">Seconds for which it is planned.</param>
    public void FindNearSurfaces(Body body, double reach, double turn, double duration)
    {
        obstacles.SelectBall(body.Radius, body.SafeDistance);
        var approach = duration * obstacles.MaxKinematicSpeed(new(body.Position, Vector.Zero, Vector.Zero), 0);
        for (var i = 0; i < body.Balls.Length; i++)
        {
            var ball = body.Balls[i];
            var centre = Select(body, i);
            ball.NearSurfaces.Clear();
            var ballReach = reach + (turn * ball.Offset.Length());
            ball.IsOnSurface = _search.TryFind(centre, ballReach, ball.Contacts, ball.NearSurfaces, out var closest)
                && closest.Gap(centre) <= obstacles.ContactSlop(centre);
            if (ball.IsOnSurface && !closest.IsFlat)
            {
                ball.Contacts.Add(in closest, centre);
            }
            else if (closest is { CombinedRadius: > 0, IsFlat: false } && closest.Gap(centre) <= MaxEdgeGap * ball.Radius)
            {
                ball.NearSurfaces.Add(in closest, closest.Normal(centre), ball.Contacts, centre);
            }

            if (obstacles.TryFindNearKinematic(centre, ballReach + approach, out var kinematic))
            {
                ball.IsOnSurface |= kinematic.Gap(centre) <= obstacles.ContactSlop(centre);
                ball.NearSurfaces.Add(in kinematic, kinematic.Normal(centre), ball.Contacts, centre);
            }
        }
    }

    /// <summary>True where an object that moves by itself has come to overlap a ball.</summary>
    public bool IsOverrun(Body body)
    {
        for (var i = 0; i < body.Balls.Length; i++)
        {
            var centre = Select(body, i);
            if (obstacles.TryFindNearKinematic(centre, -MaxKinematicOverlap * body.Balls[i].Radius, out _))
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>Finds how far objects that move by themselves push a compound that stays where it is.</summary>
    public void FindKinematicPush(Body body, double duration)
    {
        obstacles.SelectBall(body.Radius, body.SafeDistance);
        var motion = new SphereMotion(body.Position, body.Velocity, body.FreeAcceleration);
        var way = duration * obstacles.MaxKinematicSpeed(in motion, duration);
        var reach = way + motion.MaxTravelDistance(duration) + (duration * body.AngularVelocity.Length() * body.MaxArm);
        for (var i = 0; i < body.Balls.Length && way > 0; i++)
        {
            var centre = Select(body, i);
            if (obstacles.TryFindNearKinematic(centre, reach, out var surface))
            {
                var push = duration * surface.Kinematic!.VelocityAt(surface.Point).Length();
                body.KinematicPush = Math.Max(body.KinematicPush, push);
            }
        }
    }

    /// <summary>Adds the other bodies that the balls touch.</summary>
    public void AddTouchedBodies(Body body)
    {
        obstacles.SelectBall(body.Radius, body.SafeDistance);
        obstacles.CollectNearbyBodies(new(body.Position, Vector.Zero, Vector.Zero), 0, body.Index);
        for (var i = 0; i < body.Balls.Length; i++)
        {
            var centre = Select(body, i);
            obstacles.AddTouchedBodies(centre, obstacles.ContactSlop(centre), body.Balls[i].Contacts);
        }
    }

    /// <summary>Finds the new closest points of surfaces after a move, and removes contacts that are not touched any more.</summary>
    public void UpdateAfterMove(Body body)
    {
        for (var i = 0; i < body.Balls.Length; i++)
        {
            var centre = Select(body, i);
            obstacles.UpdateAfterMove(body.Balls[i].Contacts, centre);
            body.Balls[i].Contacts.RemoveDuplicates(centre);
        }
    }

    /// <summary>Moves a body out of what it overlaps by no more than rounding.</summary>
    public void TakeBackRounding(Body body)
    {
        _planes.Clear();
        foreach (var ball in body.Balls)
        {
            for (var i = 0; i < ball.Contacts.Count; i++)
            {
                var contact = ball.Contacts[i];
                var gap = contact.Gap(body.Position + ball.Offset);
                if (gap < 0 && gap >= -MaxRoundingOverlap * ball.Radius)
                {
                    // Relative to the way of the whole body.
                    _planes.Add(contact.Normal(body.Position + ball.Offset), -gap);
                }
            }
        }

        if (_planes.Count > 0)
        {
            body.Position += _planes.ProjectOrZero(Vector.Zero);
        }
    }

    private Vector Select(Body body, int ball)
    {
        obstacles.SelectBall(body.Balls[ball].Radius, body.Balls[ball].SafeDistance);
        return body.BallCentre(ball);
    }
}
