using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <content>What comes before and after the joint solve of islands: the surfaces that bodies may meet, and their planned motion.</content>
internal sealed partial class BodyMover
{
    // Cosine between normals from which on two surfaces near a body count as one.
    private const double SameNormal = 0.999;

    // Of the radius.
    private const double MaxLift = 0.5;

    // Of the radius: more than the solve leaves, and less than can be seen.
    private const double MaxKinematicOverlap = 2e-6;

    // Searches for surfaces near a body: in a corner it has three.
    private const int MaxSurfaceQueries = 3;

    /// <summary>
    /// Updates what a body touches of surfaces, at the beginning of a step. One that overlaps something is pushed out, or it stops.
    /// </summary>
    /// <param name="body">Awake; the obstacles must be set up for it.</param>
    /// <param name="stepLength">Seconds.</param>
    public void Prepare(Body body, double stepLength)
    {
        // What has moved may have come to overlap a body that had nowhere to go.
        body.IsOverlapResolved &= !_obstacles.TryFindNearKinematic(body.Position, -MaxKinematicOverlap * body.Radius, out _);
        if (body.IsOverlapResolved || TryResolveOverlap(body))
        {
            body.Contacts.Refresh(body.Position, _obstacles.ContactSlop(body.Position), body.Radius);
            FindKinematicPush(body, stepLength);
        }
    }

    /// <summary>
    /// Moves a body on that a kinematic object overlaps at the end of the step: others were in its way, and are pushed in the next one.
    /// </summary>
    /// <param name="body">The obstacles must be set up for it, at the end of the step.</param>
    public void PushOut(Body body)
    {
        var position = body.Position;
        if (_obstacles.TryFindNearKinematic(position, -MaxKinematicOverlap * body.Radius, out _)
            && _overlapResolver.TryResolve(ref position, body.Index, ignoresBodies: true))
        {
            body.Position = position;
            body.Contacts.Clear();
        }
    }

    /// <summary>Finds how far the closest kinematic object pushes a body that stays where it is.</summary>
    private void FindKinematicPush(Body body, double stepLength)
    {
        var motion = new Motion(body.Position, body.Velocity, body.FreeAcceleration);
        var way = stepLength * _obstacles.MaxKinematicSpeed(in motion, stepLength);
        if (way > 0 && _obstacles.TryFindNearKinematic(body.Position, way + motion.MaxTravelDistance(stepLength), out var surface))
        {
            // Whichever way: another face of the same object may be as near.
            body.KinematicPush = stepLength * surface.Kinematic!.VelocityAt(surface.Point).Length();
        }
    }

    /// <summary>Finds faces that the body touches or may meet in the step.</summary>
    /// <param name="body">Awake and prepared; the obstacles must be set up for it.</param>
    /// <param name="maxTravel">How far it may move.</param>
    /// <param name="stepLength">Seconds.</param>
    public void FindNearSurfaces(Body body, double maxTravel, double stepLength)
    {
        var isFound = _obstacles.TryFindNearSurface(body.Position, maxTravel, out var surface);
        if (isFound)
        {
            AddNearSurfaces(body, maxTravel, surface);
        }

        var approach = stepLength * _obstacles.MaxKinematicSpeed(new(body.Position, Vector.Zero, Vector.Zero), 0);
        if (_obstacles.TryFindNearKinematic(body.Position, maxTravel + approach, out var kinematic))
        {
            AddNearSurface(body, in kinematic, kinematic.Normal(body.Position));
            isFound = true;
        }

        if (isFound)
        {
            FindSurfaceAhead(body, stepLength);
            _obstacles.Time = 0;
        }
    }

    /// <summary>Adds the closest face, and those that are as close to others.</summary>
    private void AddNearSurfaces(Body body, double maxTravel, Contact surface)
    {
        var lift = surface.Normal(body.Position);
        if (surface.IsFlat)
        {
            AddNearSurface(body, in surface, lift);
        }

        // From somewhat farther off all that is known, the next surface is the closest one. No surface is within half a radius of there.
        var height = Math.Min(maxTravel, MaxLift * body.Radius);
        for (var i = 1; i < MaxSurfaceQueries && surface.IsFlat; i++)
        {
            if (!_obstacles.TryFindFace(body.Position + (height * lift), body.Position, height, out surface, out var normal))
            {
                break;
            }

            lift = (lift + normal).UnitVectorOrZero();
            AddNearSurface(body, in surface, normal);
        }
    }

    /// <summary>Finds what the body runs into along the surfaces that it touches, if nothing else turns it aside.</summary>
    private void FindSurfaceAhead(Body body, double stepLength)
    {
        var velocity = body.Contacts.ProjectVelocity(body.Velocity, body.Position, _planes, onlySurfaces: true);
        _sweep.ResetStepBudget();
        if (velocity != Vector.Zero
            && _sweep.TryFindImpact(new(body.Position, velocity, Vector.Zero), stepLength, out var hit, out var elapsed))
        {
            AddNearSurface(body, in hit, hit.Normal(body.Position + (elapsed * velocity)));
        }
    }

    private static void AddNearSurface(Body body, in Contact surface, Vector normal)
    {
        var isKnown = body.NearSurfaceCount == Body.MaxNearSurfaces;
        for (var i = 0; i < body.NearSurfaceCount; i++)
        {
            isKnown |= body.NearSurfaces[i].Kinematic == surface.Kinematic
                && Vector.Dot(body.NearSurfaces[i].CachedNormal, normal) > SameNormal;
        }

        for (var i = 0; i < body.Contacts.Count; i++)
        {
            isKnown |= !body.Contacts[i].IsBody && body.Contacts[i].Kinematic == surface.Kinematic
                && Vector.Dot(body.Contacts[i].Normal(body.Position), normal) > SameNormal;
        }

        if (!isKnown)
        {
            body.NearSurfaces[body.NearSurfaceCount++] = surface with { CachedNormal = normal };
        }
    }

    /// <summary>
    /// Moves a body whose island has been solved to its target, or as far as surfaces and the character let it. Bodies are not in the way:
    /// those that it may meet are in the plan.
    /// </summary>
    /// <param name="body">Awake, prepared and planned. The obstacles must be set up for it.</param>
    /// <param name="stepLength">Seconds.</param>
    public void MovePlanned(Body body, double stepLength)
    {
        body.CheckedTarget = body.Target;
        body.PlannedHit = null;
        var way = body.Target - body.PlannedStart;
        if (way == Vector.Zero && _obstacles.MaxKinematicSpeed(new(body.PlannedStart, Vector.Zero, Vector.Zero), 0) == 0)
        {
            body.Position = body.Target;
            return;
        }

        // Straight: its plan keeps the ends of the way before the surfaces that it touches, and so all that lies between.
        var motion = new Motion(body.PlannedStart, way / stepLength, Vector.Zero);
        _sweep.ResetStepBudget();
        var isHit = _sweep.TryFindImpact(in motion, stepLength, out var hit, out var elapsed);
        body.IsHeld = isHit || elapsed < stepLength;
        body.Position = body.IsHeld ? motion.PositionAt(elapsed) : body.Target;
        if (isHit)
        {
            body.Position = RemoveRoundingOverlap(body.Position, in hit);
            body.Contacts.Add(in hit, body.Position);
            body.PlannedHit = hit with { CachedNormal = hit.Normal(body.Position) };
        }
    }

    /// <summary>Updates what a body touches after its planned way.</summary>
    /// <param name="body">The obstacles must be set up for it.</param>
    public void FinishPlanned(Body body)
    {
        if (body.Position != body.PlannedStart || body.Contacts.HasMovingSurface)
        {
            body.Contacts.UpdateAfterMove(body.Position, _obstacles.ContactSlop(body.Position), _obstacles);
        }
    }
}
