using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Stepping;

/// <content>What comes before and after the joint solve of islands: the surfaces that bodies may meet, and their planned motion.</content>
internal sealed partial class BodyMover
{
    // Relative to the radius: what is met on a shorter way is met on the planned way.
    private const double NegligibleWay = 0.01;

    // Relative to the radius: more than the solve leaves, and less than can be seen.
    private const double MaxKinematicOverlap = 2e-6;

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
        var motion = new SphereMotion(body.Position, body.Velocity, body.FreeAcceleration);
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
        var isFound = _nearSurfaceSearch.TryFind(body.Position, maxTravel, body.Contacts, body.NearSurfaces, out _);
        var approach = stepLength * _obstacles.MaxKinematicSpeed(new(body.Position, Vector.Zero, Vector.Zero), 0);
        if (_obstacles.TryFindNearKinematic(body.Position, maxTravel + approach, out var kinematic))
        {
            body.NearSurfaces.Add(in kinematic, kinematic.Normal(body.Position), body.Contacts, body.Position);
            isFound = true;
        }

        if (isFound)
        {
            FindSurfaceAhead(body, stepLength);
            _obstacles.Time = 0;
        }
    }

    /// <summary>Finds what the body runs into along the surfaces that it touches, if nothing else turns it aside.</summary>
    private void FindSurfaceAhead(Body body, double stepLength)
    {
        var velocity = body.Contacts.ProjectVelocity(body.Velocity, body.Position, _planes, onlySurfaces: true);
        _sweep.ResetStepBudget();
        if (stepLength * velocity.Length() > NegligibleWay * body.Radius
            && _sweep.TryFindImpact(new(body.Position, velocity, Vector.Zero), stepLength, out var hit, out var elapsed))
        {
            body.NearSurfaces.Add(in hit, hit.Normal(body.Position + (elapsed * velocity)), body.Contacts, body.Position);
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
        var way = body.Target - body.PlannedStart;
        if (way == Vector.Zero && _obstacles.MaxKinematicSpeed(new(body.PlannedStart, Vector.Zero, Vector.Zero), 0) == 0)
        {
            body.Position = body.Target;
            return;
        }

        // Straight: its plan keeps the ends of the way before the surfaces that it touches, and so all that lies between.
        var motion = new SphereMotion(body.PlannedStart, way / stepLength, Vector.Zero);
        _sweep.ResetStepBudget();
        var isHit = _sweep.TryFindImpact(in motion, stepLength, out var hit, out var elapsed);
        body.IsHeld = isHit || elapsed < stepLength;
        body.Position = body.IsHeld ? motion.PositionAt(elapsed) : body.Target;
        if (isHit)
        {
            body.Position = RemoveRoundingOverlap(body.Position, in hit);
            body.Contacts.Add(in hit, body.Position);
            body.PlanStop(0, in hit);
        }
    }

    /// <summary>Moves a body whose island has been solved to its target, on the way to which there is nothing.</summary>
    public static void MoveFreely(Body body)
    {
        body.IsHeld = false;
        body.Position = body.Target;
    }

    /// <summary>Updates what a body touches after its planned way.</summary>
    /// <param name="body">The obstacles must be set up for it.</param>
    public void FinishPlanned(Body body)
    {
        if (body.Position != body.PlannedStart || body.Contacts.HasMovingSurface)
        {
            _obstacles.UpdateAfterMove(body.Contacts, body.Position);
        }
    }
}
