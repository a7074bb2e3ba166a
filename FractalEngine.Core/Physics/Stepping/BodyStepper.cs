using System.Globalization;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Solving;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>Takes one body through one step: shrinking, damping, forces, motion and sleep.</summary>
internal sealed class BodyStepper(
    PhysicsSettings settings, List<Body> bodies, BodyGrid grid, NearbyBodies nearbyBodies, Obstacles obstacles, SleepIslands islands,
    IslandPlanner planner, QueryContext queryContext, ContactLog contactLog)
{
    // Relative to the speed that the acceleration adds in a step.
    private const double RestitutionThresholdFraction = 0.5;

    // Relative to √(acceleration · radius), the speed that a body reaches by falling half its radius.
    private const double SleepSpeedFraction = 0.02;

    // Relative to the radius: how much farther than a body goes in two steps its queries search, so that the next ones need none.
    private const double SearchMargin = 0.5;

    /// <summary>The offset of the only sphere of a body.</summary>
    public static readonly Vector[] SingleSphereOffset = [Vector.Zero];

    private readonly BodyMover _mover = new(bodies, obstacles, islands, planner, contactLog);

    /// <summary>Makes room for so many bodies near one.</summary>
    public void Reserve(int bodyCount)
    {
        nearbyBodies.Reserve(bodyCount);
        obstacles.Reserve(bodyCount);
    }

    /// <summary>Begins the step of a body that is awake: all but its motion.</summary>
    /// <param name="body">Its previous state must have been saved.</param>
    /// <param name="staticColliders">Colliders of the body's kind; null where there are no static objects.</param>
    /// <param name="character">Character that is in the way; null for none.</param>
    /// <param name="gravity">Units per second².</param>
    /// <param name="stepLength">Seconds, positive.</param>
    public void Prepare(Body body, StaticColliders? staticColliders, CharacterController? character, Vector gravity, double stepLength)
    {
        body.IsPrepared = true;
        var description = body.Description;
        body.Shrink(stepLength);
        var acceleration = gravity + ((body.Force + body.StepForce) / description.Mass);
        if (description.Damping > 0)
        {
            body.Velocity *= Math.Exp(-description.Damping * stepLength);
            body.AngularVelocity *= Math.Exp(-description.Damping * stepLength);
        }

        if (body.StepTorque != Vector.Zero)
        {
            body.AngularVelocity += stepLength * body.SpinChange(body.StepTorque);
        }

        body.FreeAcceleration = acceleration;
        body.RestitutionThreshold =
            settings.RestitutionThreshold ?? RestitutionThresholdFraction * acceleration.Length() * stepLength;
        var wasResolved = body.IsOverlapResolved;
        Begin(body, staticColliders, character, stepLength);
        _mover.Prepare(body, stepLength);
        if (!wasResolved)
        {
            grid.Update(body.Index);
        }

        End(body);
    }

    /// <summary>Tells whether a kinematic object may come to touch a body that sleeps.</summary>
    /// <param name="body">Any body.</param>
    /// <param name="staticColliders">Colliders of the body's kind; null where there are no static objects.</param>
    /// <param name="distance">How far the object moves.</param>
    public bool IsNearKinematic(Body body, StaticColliders? staticColliders, double distance)
    {
        obstacles.SetMover(staticColliders, SingleSphereOffset, body.Radius, body.SafeDistance, 0);
        obstacles.Time = 0;
        return obstacles.TryFindNearKinematic(body.Position, distance + obstacles.ContactSlop(body.Position), out _);
    }

    /// <summary>Finds the surfaces that a body may meet in the step.</summary>
    /// <param name="body">Must have been prepared.</param>
    /// <param name="staticColliders">Colliders of the body's kind; null where there are no static objects.</param>
    /// <param name="reach">How far it may move.</param>
    /// <param name="stepLength">Seconds, positive.</param>
    public void FindNearSurfaces(Body body, StaticColliders? staticColliders, double reach, double stepLength)
    {
        if (IsFree(body, body.Position, reach))
        {
            return;
        }

        Begin(body, staticColliders, character: null, stepLength);
        _mover.FindNearSurfaces(body, reach, stepLength);
        End(body);
    }

    /// <summary>Makes the step of a body that is awake and of no island.</summary>
    /// <param name="body">Must have been prepared.</param>
    /// <param name="staticColliders">Colliders of the body's kind; null where there are no static objects.</param>
    /// <param name="character">Character that is in the way; null for none.</param>
    /// <param name="stepLength">Seconds, positive.</param>
    /// <param name="stepIndex">Number of steps before this one, for the message.</param>
    /// <exception cref="InvalidOperationException">The body has left the range of a double; the message names it.</exception>
    public void Step(Body body, StaticColliders? staticColliders, CharacterController? character, double stepLength, long stepIndex)
    {
        var motion = new SphereMotion(body.Position, body.Velocity, body.FreeAcceleration);
        Begin(body, staticColliders, character, stepLength);
        obstacles.PrepareNearbyBodies(in motion, stepLength, body.Index);
        _mover.Move(body, stepLength);
        End(body);
        Finish(body, stepLength, stepIndex);
        CommitPosition(body);
    }

    /// <summary>Moves a body of an island, before it is known whether all of them have room.</summary>
    /// <inheritdoc cref="Step"/>
    public void MovePlanned(Body body, StaticColliders? staticColliders, CharacterController? character, double stepLength)
    {
        if (character is null && IsFree(body, body.PlannedStart, (body.Target - body.PlannedStart).Length()))
        {
            BodyMover.MoveFreely(body);
            return;
        }

        Begin(body, staticColliders, character, stepLength);
        _mover.MovePlanned(body, stepLength);
        End(body);
    }

    /// <summary>Ends the step of a body of an island, whose position is known. Its position has to be committed then.</summary>
    /// <inheritdoc cref="Step"/>
    public void FinishPlanned(Body body, StaticColliders? staticColliders, double stepLength, long stepIndex)
    {
        var hasMoved = body.Position != body.PlannedStart || body.Contacts.HasMovingSurface;
        if (body.IsCompound || (hasMoved && body.Contacts.Count > 0))
        {
            Begin(body, staticColliders, character: null, stepLength, stepLength);
            _mover.FinishPlanned(body);
            End(body);
        }

        Finish(body, stepLength, stepIndex);
    }

    /// <summary>Tells others where a body is that has ended its step: it wakes what may have lain on it. One thread at a time.</summary>
    public void CommitPosition(Body body)
    {
        islands.WakeLeft(body);
        // Last, so that what was collected for this body serves its islands too.
        grid.Update(body.Index);
    }

    /// <summary>Does so unless others may have to be told: many threads may do so at once.</summary>
    /// <returns>False where <see cref="CommitPosition"/> has to be called.</returns>
    public bool TryCommitPosition(Body body) => !islands.HasSleeping && grid.TryUpdateWithinCell(body.Index);

    /// <summary>Moves a body on that a kinematic object has overrun, at the end of the step.</summary>
    /// <param name="body">Must have been moved.</param>
    /// <param name="staticColliders">Colliders of the body's kind; null where there are no static objects.</param>
    /// <param name="stepLength">Seconds, positive.</param>
    public void PushOut(Body body, StaticColliders? staticColliders, double stepLength)
    {
        Begin(body, staticColliders, character: null, stepLength, stepLength);
        body.MayTouchBodies = true;
        _mover.PushOut(body);
        End(body);
        grid.Update(body.Index);
    }

    /// <summary>Ends the step of a body that has moved.</summary>
    /// <param name="body">Must have been moved.</param>
    /// <param name="stepLength">Seconds, positive.</param>
    /// <param name="stepIndex">Number of steps before this one, for the message.</param>
    /// <exception cref="InvalidOperationException">The body has left the range of a double; the message names it.</exception>
    private void Finish(Body body, double stepLength, long stepIndex)
    {
        if (!body.Position.IsFinite() || !body.Velocity.IsFinite())
        {
            var state = $"position {body.Position}, velocity {body.Velocity}";
            throw new InvalidOperationException(string.Create(
                CultureInfo.InvariantCulture, $"body {body.Name} has left the range of a double in step {stepIndex}: {state}"));
        }

        body.Turn(stepLength);
        var sleepSpeed = settings.SleepSpeed ?? SleepSpeedFraction * Math.Sqrt(body.FreeAcceleration.Length() * body.Radius);
        islands.Update(body, sleepSpeed, settings.TimeBeforeSleep, stepLength);
        body.IsFinished = true;
    }

    /// <summary>True for a ball that meets no surface on a way, as far as is known without a query.</summary>
    private bool IsFree(Body body, Vector start, double way) =>
        !body.IsCompound && !obstacles.HasKinematics && body.SafeDistance.LowerBoundAt(start) - body.Radius > way;

    /// <summary>Makes a body the mover of the obstacles, and begins to count its tests.</summary>
    private void Begin(
        Body body, StaticColliders? staticColliders, CharacterController? character, double stepLength, double time = 0)
    {
        var maxTravel = new SphereMotion(body.Position, body.Velocity, body.FreeAcceleration).MaxTravelDistance(stepLength);
        var margin = (2 * maxTravel) + (SearchMargin * body.Radius);
        obstacles.SetMover(staticColliders, SingleSphereOffset, body.Radius, body.SafeDistance, margin, character);
        obstacles.Time = time;
        body.FaceTests -= queryContext.Statistics.FaceTests;
        body.BoundTests -= queryContext.Statistics.BoundTests;
    }

    private void End(Body body)
    {
        body.FaceTests += queryContext.Statistics.FaceTests;
        body.BoundTests += queryContext.Statistics.BoundTests;
    }
}
