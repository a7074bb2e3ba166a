using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Solving;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>
/// Moves a body through one step: alone from impact to impact, or as its island has been planned. Obstacles must be set up for the body.
/// </summary>
internal sealed class BodyMover
{
    private const int MaxImpacts = 1000;

    // Where there is no end of tiny impacts, as on the dust of an infinite fractal, a compound loses the time that is left.
    private const int MaxImpactsOfCompound = 60;

    // Impacts without time in between: more of them are a corner that leaves no path.
    private const int MaxSimultaneousImpacts = 16;

    // Relative to the radius: by so much an object may overrun what has stopped at it, and still pushes it out on the same side.
    private const double MaxOverrun = 0.25;

    private readonly Obstacles _obstacles;
    private readonly BodySweep _sweep;
    private readonly BodyContacts _contacts;
    private readonly BallFlight _ballFlight;
    private readonly CompoundFlight _compoundFlight;
    private readonly OverlapResolver _overlapResolver;

    public BodyMover(List<Body> bodies, Obstacles obstacles, SleepIslands islands, IslandPlanner planner, ContactLog contactLog)
    {
        _obstacles = obstacles;
        _sweep = new(obstacles);
        _contacts = new(obstacles, _sweep);
        _ballFlight = new(bodies, obstacles, _sweep, islands, planner, contactLog);
        _compoundFlight = new(bodies, obstacles, _sweep, _contacts, islands, planner);
        _overlapResolver = new(obstacles);
    }

    /// <summary>
    /// Updates what a body touches of surfaces, at the beginning of a step. One that overlaps something is pushed out, or it stops.
    /// </summary>
    /// <param name="body">Awake.</param>
    /// <param name="stepLength">Seconds.</param>
    public void Prepare(Body body, double stepLength)
    {
        // What has moved may have come to overlap a body that had nowhere to go.
        body.IsOverlapResolved &= !_contacts.IsOverrun(body);
        if (body.IsOverlapResolved || TryResolveOverlap(body))
        {
            _contacts.Refresh(body);
            _contacts.FindKinematicPush(body, stepLength);
        }
    }

    /// <summary>Finds the faces that a body of an island touches or may meet in the step.</summary>
    /// <param name="body">Awake and prepared.</param>
    /// <param name="reach">How far it may move.</param>
    /// <param name="stepLength">Seconds.</param>
    public void FindNearSurfaces(Body body, double reach, double stepLength) =>
        _contacts.FindNearSurfaces(body, reach, stepLength * body.AngularVelocity.Length(), stepLength);

    /// <summary>
    /// Moves a body that touches no other, or only such as do not move: free flight to the moment of an impact, the response there, and the
    /// same again with the remaining time.
    /// </summary>
    /// <param name="body">Awake and prepared.</param>
    /// <param name="stepLength">Seconds.</param>
    public void Move(Body body, double stepLength)
    {
        if (!body.IsOverlapResolved)
        {
            return;
        }

        if (body.HasHeapMargin)
        {
            // It has left its island, and touches only what it does without a margin.
            body.HasHeapMargin = false;
            _contacts.Refresh(body);
        }

        _sweep.ResetStepBudget();
        if (!body.IsCompound)
        {
            _contacts.AddTouchedBodies(body);
            _ballFlight.Begin(body, stepLength);
        }

        var simultaneousImpacts = 0;
        var timeLeft = stepLength;
        var impactsLeft = body.IsCompound ? MaxImpactsOfCompound : MaxImpacts;
        for (var advance = 0; advance < MaxImpacts && impactsLeft > 0 && simultaneousImpacts < MaxSimultaneousImpacts && timeLeft > 0;
            advance++)
        {
            _obstacles.Time = stepLength - timeLeft;
            var elapsed = body.IsCompound ? _compoundFlight.Advance(body, timeLeft) : _ballFlight.Advance(body, timeLeft);
            timeLeft -= elapsed;
            impactsLeft -= body.IsCompound && _compoundFlight.HasMet ? 1 : 0;
            simultaneousImpacts = elapsed > 0 ? 0 : simultaneousImpacts + 1;
        }
    }

    /// <summary>
    /// Moves a body whose island has been solved to its target, or as far as surfaces and the character let it. Bodies are not in the way:
    /// those that it may meet are in the plan.
    /// </summary>
    /// <param name="body">Awake, prepared and planned.</param>
    /// <param name="stepLength">Seconds.</param>
    public void MovePlanned(Body body, double stepLength)
    {
        body.SetOrientation(body.PlannedStartOrientation);
        var way = body.Target - body.PlannedStart;
        if (way == Vector.Zero && body.PlannedTurn == Vector.Zero
            && _obstacles.MaxKinematicSpeed(new(body.PlannedStart, Vector.Zero, Vector.Zero), 0) == 0)
        {
            body.Position = body.Target;
            return;
        }

        // Straight: its plan keeps the ends of the way before the surfaces that it touches, and so all that lies between.
        var motion = new SphereMotion(body.PlannedStart, way / stepLength, Vector.Zero);
        _sweep.ResetStepBudget();
        var duration = stepLength;
        var elapsed = 0.0;
        Contact? met = null;
        var metBall = 0;
        for (var plan = 0; plan < BodySweep.MaxPlans; plan++)
        {
            var turn = duration / stepLength * body.PlannedTurn;
            _obstacles.Time = 0;
            if (!_sweep.TryFindImpact(body, in motion, turn, duration, out var hit, out var ball, out elapsed))
            {
                break;
            }

            (met, metBall) = (hit, ball);
            if (BodySweep.IsOnWay(body, turn, elapsed / duration))
            {
                break;
            }

            // The balls of a compound are there only where their ways end.
            duration = elapsed;
            elapsed = 0;
        }

        body.IsHeld = met is not null || elapsed < stepLength;
        body.Position = body.IsHeld ? motion.PositionAt(elapsed) : body.Target;
        body.SetOrientation(body.PlannedStartOrientation.TurnedBy(elapsed / stepLength * body.PlannedTurn));
        if (met is { } contact)
        {
            _sweep.RemoveRoundingOverlap(body, metBall, in contact);
            body.Balls[metBall].Contacts.Add(in contact, body.BallCentre(metBall));
            body.PlanStop(metBall, in contact);
            CarryAlong(body, body.BallCentre(metBall), in contact, stepLength - elapsed);
        }
    }

    /// <summary>Takes a body along that has stopped at an object, which would go through it in the time that is left.</summary>
    private void CarryAlong(Body body, Vector centre, in Contact contact, double timeLeft)
    {
        var normal = contact.Normal(centre);
        var speed = Vector.Dot(contact.SurfaceVelocity(centre), normal);
        if (timeLeft * speed > MaxOverrun * body.MinBallRadius)
        {
            var motion = new SphereMotion(body.Position, speed * normal, Vector.Zero);
            _ = _sweep.TryFindImpact(body, in motion, Vector.Zero, timeLeft, out _, out _, out var elapsed);
            body.Position = motion.PositionAt(elapsed);
        }
    }

    /// <summary>Moves a ball whose island has been solved to its target, on the way to which there is nothing.</summary>
    public static void MoveFreely(Body body)
    {
        body.IsHeld = false;
        body.Position = body.Target;
    }

    /// <summary>Updates what a body touches after its planned way.</summary>
    public void FinishPlanned(Body body) => _contacts.UpdateAfterMove(body);

    /// <summary>
    /// Moves a body on that a kinematic object overlaps at the end of the step: others were in its way, and are pushed in the next one.
    /// </summary>
    /// <param name="body">The obstacles must be those of the end of the step.</param>
    public void PushOut(Body body)
    {
        var position = body.Position;
        if (_contacts.IsOverrun(body) && _overlapResolver.TryResolve(ref position, body))
        {
            body.Position = position;
            body.Contacts.Clear();
        }
    }

    /// <summary>Pushes a body out that overlaps something; one that cannot be pushed out stops.</summary>
    private bool TryResolveOverlap(Body body)
    {
        var position = body.Position;
        body.DiscardSurfaces();
        body.IsStuck = !_overlapResolver.TryResolve(ref position, body);
        body.IsOverlapResolved = !body.IsStuck;
        body.Position = position;
        if (body.IsStuck)
        {
            body.Velocity = Vector.Zero;
            // A ball that turns in place pushes nothing along its normals.
            body.AngularVelocity = body.IsCompound ? Vector.Zero : body.AngularVelocity;
        }

        return body.IsOverlapResolved;
    }
}
