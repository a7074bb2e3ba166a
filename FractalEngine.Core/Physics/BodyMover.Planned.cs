using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <content>What comes before and after the joint solve of islands: the surfaces that bodies may meet, and their planned motion.</content>
internal sealed partial class BodyMover
{
    /// <summary>
    /// Updates what a body touches of surfaces, at the beginning of a step. One that overlaps something is pushed out, or it stops.
    /// </summary>
    /// <param name="body">Awake; the obstacles must be set up for it.</param>
    /// <param name="maxTravel">How far it may move in the step; 0 where no other body is near.</param>
    public void Prepare(Body body, double maxTravel)
    {
        body.NearSurface = null;
        body.TouchedSurface = null;
        if (body.IsOverlapResolved || TryResolveOverlap(body))
        {
            body.Contacts.Refresh(body.Position, _obstacles.ContactSlop(body.Position), body.Radius);
            if (maxTravel > 0)
            {
                FindNearSurface(body, maxTravel);
            }
        }
    }

    /// <summary>Finds a face that the body touches or may meet in the step.</summary>
    private void FindNearSurface(Body body, double maxTravel)
    {
        if (!_obstacles.TryFindNearSurface(body.Position, maxTravel, out var surface) || !surface.IsFlat)
        {
            return;
        }

        if (surface.Gap(body.Position) <= _obstacles.ContactSlop(body.Position))
        {
            body.TouchedSurface = surface;
        }
        else
        {
            body.NearSurface = surface;
        }
    }

    /// <summary>
    /// Moves a body whose island has been solved: along the planned parabola, until it meets what the plan does not know. One that meets a
    /// body of its island, which is still in the way, waits there. It may go on when the other has moved, else it loses the time.
    /// </summary>
    /// <param name="body">Awake, prepared and planned. The obstacles must be set up for it.</param>
    /// <param name="stepLength">Seconds.</param>
    public void MovePlanned(Body body, double stepLength)
    {
        // By how much others have changed its velocity while it waited.
        var push = Vector.Zero;
        var isGoingOn = body.IsWaiting;
        if (isGoingOn)
        {
            push = body.Velocity - body.PlannedEndVelocity;
        }
        else
        {
            body.PlannedMotion = new(body.Position, body.Velocity, body.NetAcceleration);
            body.PlannedTime = 0;
        }

        var planned = body.PlannedMotion;
        if (!isGoingOn)
        {
            var energyBefore = body.SpinEnergy;
            body.AngularVelocity += body.PlannedSpinChange;
            body.PlannedSpinGain = body.SpinEnergy - energyBefore;
            body.EnergyGain = body.PlannedSpinGain;
        }

        if (planned.Velocity == Vector.Zero && planned.Acceleration == Vector.Zero)
        {
            return;
        }

        var motion = new Motion(body.Position, planned.VelocityAt(body.PlannedTime), planned.Acceleration);
        var timeLeft = stepLength - body.PlannedTime;
        _sweep.ResetStepBudget();
        _obstacles.CollectNearbyBodies(in motion, timeLeft, body.Index);
        var isHit = _sweep.TryFindImpact(in motion, timeLeft, out var hit, out var elapsed);
        body.PlannedTime += elapsed;
        body.IsWaiting = isHit && hit.IsBody && _bodies[hit.BodyIndex].IslandIndex == body.IslandIndex;
        var position = motion.PositionAt(elapsed);
        var isComplete = !isHit && elapsed >= timeLeft;
        var velocity = isComplete || body.IsWaiting ? body.PlannedEndVelocity : planned.VelocityAt(body.PlannedTime);
        body.Velocity = velocity + push;
        body.EnergyGain = body.EnergyGainOf(velocity, position);
        var isUnplanned = isHit && !body.IsWaiting;
        if (isUnplanned)
        {
            // The others of the island have their part of the contacts' impulses, whether this one goes on or not.
            var velocityThere = body.PlannedEndVelocity - ((timeLeft - elapsed) * body.FreeAcceleration);
            body.EnergyGain = body.EnergyGainOf(velocityThere, position);
            body.Velocity = velocityThere + push;
            position = RemoveRoundingOverlap(position, in hit);
            body.Contacts.Add(in hit, position);
        }

        body.Contacts.UpdateAfterMove(position, _obstacles.ContactSlop(position), _obstacles);
        if (isUnplanned)
        {
            MoveOn(body, ref position, timeLeft - elapsed, stepLength);
        }

        body.Position = position;
    }
}
