using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;

namespace FractalEngine.Core.Physics.Stepping;

/// <content>What comes before and after the joint solve of islands, and the planned motion of their compounds.</content>
internal sealed partial class CompoundMover
{
    /// <summary>
    /// Updates what a compound touches of surfaces, at the beginning of a step. One that overlaps something is pushed out.
    /// </summary>
    /// <param name="body">Awake; the obstacles must be set up for it.</param>
    /// <param name="stepLength">Seconds.</param>
    public void Prepare(Body body, double stepLength)
    {
        // What has moved may have come to overlap a body that had nowhere to go.
        body.IsOverlapResolved &= !_contacts.IsOverrun(body);
        if (!body.IsOverlapResolved)
        {
            foreach (var ball in body.Balls)
            {
                ball.InvalidateSurroundings();
            }

            body.IsStuck = !_overlapResolver.TryResolve(body);
            body.IsOverlapResolved = !body.IsStuck;
            body.Velocity = body.IsStuck ? Vector.Zero : body.Velocity;
            body.AngularVelocity = body.IsStuck ? Vector.Zero : body.AngularVelocity;
        }

        _contacts.Refresh(body);
        _contacts.FindKinematicPush(body, stepLength);
    }

    /// <summary>Finds faces that a compound of an island touches or may meet in the step.</summary>
    public void FindNearSurfaces(Body body, double reach, double stepLength) =>
        _contacts.FindNearSurfaces(body, reach, stepLength * body.AngularVelocity.Length(), stepLength);

    /// <summary>Moves a compound of an island to its target, or as far as surfaces and the character let it.</summary>
    /// <param name="body">Awake, prepared and planned. The obstacles must be set up for it.</param>
    /// <param name="stepLength">Seconds.</param>
    public void MovePlanned(Body body, double stepLength)
    {
        body.Position = body.PlannedStart;
        body.SetOrientation(body.PlannedStartOrientation);
        var way = body.Target - body.PlannedStart;
        if (way == Vector.Zero && body.PlannedTurn == Vector.Zero && !body.HasMovingSurface && body.KinematicPush == 0)
        {
            return;
        }

        var path = new RigidPath(new(body.PlannedStart, way / stepLength, Vector.Zero), body.PlannedTurn / stepLength);
        _sweep.ResetStepBudget();
        var allowance = path.Sagitta(body.MaxArm, stepLength);
        var isHit = _sweep.TryFindImpact(body, in path, stepLength, allowance, out var hit, out var ball, out var elapsed);
        if (isHit && allowance > 0)
        {
            _obstacles.Time = 0;
            isHit = _sweep.TryFindImpact(body, in path, stepLength, allowance: 0, out hit, out ball, out elapsed);
        }

        body.IsHeld = isHit || elapsed < stepLength;
        body.Position = body.IsHeld ? path.Motion.PositionAt(elapsed) : body.Target;
        body.SetOrientation(body.PlannedStartOrientation.TurnedBy(elapsed * path.Spin));
        if (isHit)
        {
            body.Balls[ball].Contacts.Add(in hit, body.BallCentre(ball));
            body.PlanStop(ball, in hit);
        }
    }

    /// <summary>Updates what a compound touches after its planned way.</summary>
    public void FinishPlanned(Body body) => _contacts.UpdateAfterMove(body);
}
