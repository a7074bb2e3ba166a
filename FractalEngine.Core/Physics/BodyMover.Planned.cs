using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <content>What comes before and after the joint solve of islands: the surfaces that bodies may meet, and their planned motion.</content>
internal sealed partial class BodyMover
{
    /// <summary>
    /// Updates what a body touches of surfaces, at the beginning of a step. One that overlaps something is pushed out, or it stops.
    /// </summary>
    /// <param name="body">Awake; the obstacles must be set up for it.</param>
    public void Prepare(Body body)
    {
        if (body.IsOverlapResolved || TryResolveOverlap(body))
        {
            body.Contacts.Refresh(body.Position, _obstacles.ContactSlop(body.Position), body.Radius);
        }
    }

    /// <summary>Finds faces that the body touches or may meet in the step.</summary>
    /// <param name="body">Awake and prepared; the obstacles must be set up for it.</param>
    /// <param name="maxTravel">How far it may move.</param>
    /// <param name="stepLength">Seconds.</param>
    public void FindNearSurfaces(Body body, double maxTravel, double stepLength)
    {
        if (_nearSurfaceSearch.TryFind(body.Position, maxTravel, body.Contacts, body.NearSurfaces, out _))
        {
            FindSurfaceAhead(body, stepLength);
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
        body.CheckedTarget = body.Target;
        body.PlannedHit = null;
        var way = body.Target - body.PlannedStart;
        if (way == Vector.Zero)
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
            body.PlannedHit = hit;
        }
    }

    /// <summary>Updates what a body touches after its planned way.</summary>
    /// <param name="body">The obstacles must be set up for it.</param>
    public void FinishPlanned(Body body)
    {
        if (body.Position != body.PlannedStart)
        {
            body.Contacts.UpdateAfterMove(body.Position, _obstacles.ContactSlop(body.Position), _obstacles);
        }
    }
}
