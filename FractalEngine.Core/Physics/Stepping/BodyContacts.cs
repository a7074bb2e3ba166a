using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>Finds and keeps what the balls of a body touch. Obstacles must be set up for the body.</summary>
internal sealed class BodyContacts(Obstacles obstacles, BodySweep sweep)
{
    // Relative to a ball's radius: overlaps up to this are taken back as rounding.
    private const double MaxRoundingOverlap = 1e-6;

    // Relative to a ball's radius: more than the solve leaves, and less than can be seen.
    private const double MaxKinematicOverlap = 2e-6;

    // Relative to the radius: what is met on a shorter way is met on the planned way.
    private const double NegligibleWay = 0.01;

    private readonly NearSurfaceSearch _search = new(obstacles);
    private readonly HalfSpaces _planes = new();

    /// <summary>Removes what is not touched any more, and all other bodies, since those move.</summary>
    public void Refresh(Body body)
    {
        foreach (var ball in body.Balls)
        {
            var centre = Select(body, ball);
            ball.Contacts.Refresh(centre, SlopOf(body, ball, centre), ball.Radius);
        }
    }

    /// <summary>Finds the surfaces that the balls touch or may meet.</summary>
    /// <param name="body">Awake and prepared.</param>
    /// <param name="reach">How far its centre of mass may get.</param>
    /// <param name="turn">Angle by which it may turn, radians.</param>
    /// <param name="duration">Seconds for which it is planned.</param>
    public void FindNearSurfaces(Body body, double reach, double turn, double duration)
    {
        obstacles.SelectBall(body.Radius, body.SafeDistance);
        var approach = duration * obstacles.MaxKinematicSpeed(new(body.Position, Vector.Zero, Vector.Zero), 0);
        foreach (var ball in body.Balls)
        {
            var centre = Select(body, ball);
            var ballReach = reach + (turn * ball.Offset.Length());
            ball.NearSurfaces.Clear();
            var isFound = _search.TryFind(centre, ballReach, ball.Contacts, ball.NearSurfaces, out var closest);
            if (body.IsCompound)
            {
                KeepClosest(ball, centre, in closest, isFound);
            }

            if (obstacles.TryFindNearKinematic(centre, ballReach + approach, out var kinematic))
            {
                ball.IsOnSurface |= body.IsCompound && kinematic.Gap(centre) <= obstacles.ContactSlop(centre);
                ball.NearSurfaces.Add(in kinematic, kinematic.Normal(centre), ball.Contacts, centre);
                isFound = true;
            }

            if (isFound && !body.IsCompound)
            {
                FindSurfaceAhead(body, duration);
            }
        }
    }

    /// <summary>Keeps the edge or corner that a compound's ball touches.</summary>
    private void KeepClosest(BodyBall ball, Vector centre, in Contact closest, bool isFound)
    {
        ball.IsOnSurface = isFound && closest.Gap(centre) <= obstacles.ContactSlop(centre);
        if (ball.IsOnSurface && !closest.IsFlat)
        {
            ball.Contacts.Add(in closest, centre);
        }
    }

    /// <summary>Finds what a ball runs into along the surfaces that it touches, if nothing else turns it aside.</summary>
    private void FindSurfaceAhead(Body body, double stepLength)
    {
        var velocity = body.Contacts.ProjectVelocity(body.Velocity, body.Position, _planes, onlySurfaces: true);
        sweep.ResetStepBudget();
        if (stepLength * velocity.Length() > NegligibleWay * body.Radius
            && sweep.TryFindImpact(
                body, new(body.Position, velocity, Vector.Zero), Vector.Zero, stepLength, out var hit, out _, out var elapsed))
        {
            body.NearSurfaces.Add(in hit, hit.Normal(body.Position + (elapsed * velocity)), body.Contacts, body.Position);
        }

        obstacles.Time = 0;
    }

    /// <summary>True where an object that moves by itself has come to overlap a ball.</summary>
    public bool IsOverrun(Body body)
    {
        foreach (var ball in body.Balls)
        {
            if (obstacles.TryFindNearKinematic(Select(body, ball), -MaxKinematicOverlap * ball.Radius, out _))
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>Finds how far objects that move by themselves push a body that stays where it is.</summary>
    public void FindKinematicPush(Body body, double duration)
    {
        obstacles.SelectBall(body.Radius, body.SafeDistance);
        var motion = new SphereMotion(body.Position, body.Velocity, body.FreeAcceleration);
        var way = duration * obstacles.MaxKinematicSpeed(in motion, duration);
        if (!(way > 0))
        {
            return;
        }

        var reach = way + motion.MaxTravelDistance(duration) + (duration * body.AngularVelocity.Length() * body.MaxArm);
        foreach (var ball in body.Balls)
        {
            if (obstacles.TryFindNearKinematic(Select(body, ball), reach, out var surface))
            {
                // Whichever way: another face of the same object may be as near.
                body.KinematicPush = Math.Max(body.KinematicPush, duration * surface.Kinematic!.VelocityAt(surface.Point).Length());
            }
        }
    }

    /// <summary>Adds the other bodies that the balls touch.</summary>
    public void AddTouchedBodies(Body body)
    {
        obstacles.SelectBall(body.Radius, body.SafeDistance);
        obstacles.CollectNearbyBodies(new(body.Position, Vector.Zero, Vector.Zero), 0, body.Index);
        foreach (var ball in body.Balls)
        {
            var centre = Select(body, ball);
            obstacles.AddTouchedBodies(centre, obstacles.ContactSlop(centre), ball.Contacts);
        }
    }

    /// <summary>Finds the new closest points of surfaces after a move, and removes contacts that are not touched any more.</summary>
    public void UpdateAfterMove(Body body)
    {
        foreach (var ball in body.Balls)
        {
            var centre = Select(body, ball);
            obstacles.UpdateAfterMove(ball.Contacts, centre, SlopOf(body, ball, centre));
            if (body.IsCompound)
            {
                ball.Contacts.RemoveDuplicates(centre);
            }
        }
    }

    private double SlopOf(Body body, BodyBall ball, Vector centre) =>
        body.HasHeapMargin ? ContactTolerances.SurfaceMargin * ball.Radius : obstacles.ContactSlop(centre);

    /// <summary>Moves a compound out of what it overlaps by no more than rounding, and into nothing else that is near.</summary>
    public void TakeBackRounding(Body body)
    {
        _planes.Clear();
        var isOverlapping = false;
        foreach (var ball in body.Balls)
        {
            var centre = body.Position + ball.Offset;
            for (var i = 0; i < ball.Contacts.Count; i++)
            {
                isOverlapping |= AddPlane(ball.Contacts[i].Normal(centre), ball.Contacts[i].Gap(centre), ball.Radius);
            }

            for (var i = 0; i < ball.NearSurfaces.Count; i++)
            {
                var face = ball.NearSurfaces[i];
                isOverlapping |= AddPlane(
                    face.CachedNormal, Vector.Dot(face.PointToCentre(centre), face.CachedNormal) - ball.Radius, ball.Radius);
            }
        }

        if (isOverlapping)
        {
            body.Position += _planes.ProjectOrZero(Vector.Zero);
        }
    }

    /// <summary>Adds a plane that the way of the whole body must not pass, where it is so near.</summary>
    /// <returns>True where it is overlapped.</returns>
    private bool AddPlane(Vector normal, double gap, double radius)
    {
        var isNear = Math.Abs(gap) <= MaxRoundingOverlap * radius;
        if (isNear)
        {
            _planes.Add(normal, -gap);
        }

        return isNear && gap < 0;
    }

    private Vector Select(Body body, BodyBall ball)
    {
        obstacles.SelectBall(ball.Radius, ball.SafeDistance);
        return body.Position + ball.Offset;
    }
}
