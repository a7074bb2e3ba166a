using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Physics.Solving;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>
/// Moves a compound through one step: to the moment of an impact, the response there, and the same again with the remaining time. What it
/// touches is solved as an island of one body, again after each impact and each small turn.
/// </summary>
internal sealed partial class CompoundMover
{
    // Where there is no end of tiny impacts, as on the dust of an infinite fractal, the body loses the time that is left.
    private const int MaxImpacts = 60;

    // Impacts without time in between: more of them are a corner that leaves no path.
    private const int MaxSimultaneousImpacts = 16;

    // Radians: a turn that is planned at once.
    private const double MaxTurn = 0.25;

    // Relative to the speed that gravity gives: a plan that leaves no more is rest.
    private const double RestFraction = 1e-10;

    // Relative to the smallest radius: how deep the body may be in something at an impact. A shorter plan finds the impact more exactly.
    private const double MaxDip = 1e-7;
    private const int MaxPlans = 12;

    // Relative to the squared speeds: what rounding adds.
    private const double EnergyRounding = 1e-12;

    private const int InitialCapacity = 64;

    private readonly List<Body> _bodies;
    private readonly Obstacles _obstacles;
    private readonly SleepIslands _islands;
    private readonly IslandPlanner _planner;
    private readonly CompoundContacts _contacts;
    private readonly CompoundSweep _sweep;
    private readonly CompoundOverlapResolver _overlapResolver;
    private readonly List<ContactRow> _rows = new(InitialCapacity);
    private readonly List<int> _members = new(InitialCapacity);

    public CompoundMover(List<Body> bodies, Obstacles obstacles, SleepIslands islands, IslandPlanner planner)
    {
        _bodies = bodies;
        _obstacles = obstacles;
        _islands = islands;
        _planner = planner;
        _contacts = new(obstacles);
        _sweep = new(obstacles);
        _overlapResolver = new(obstacles);
    }

    /// <summary>Moves a compound that touches no other body that is awake. The obstacles must be set up for it.</summary>
    /// <param name="body">Awake and prepared.</param>
    /// <param name="stepLength">Seconds.</param>
    public void Move(Body body, double stepLength)
    {
        if (!body.IsOverlapResolved)
        {
            return;
        }

        _sweep.ResetStepBudget();
        var simultaneousImpacts = 0;
        var timeLeft = stepLength;
        for (var impact = 0; impact < MaxImpacts && simultaneousImpacts < MaxSimultaneousImpacts && timeLeft > 0; impact++)
        {
            _obstacles.Time = stepLength - timeLeft;
            _contacts.TakeBackRounding(body);
            var speed = body.Velocity.Length() + (timeLeft * body.FreeAcceleration.Length());
            var turn = Math.Min(MaxTurn, timeLeft * body.AngularVelocity.Length());
            _contacts.FindNearSurfaces(body, timeLeft * speed, turn, timeLeft);
            _contacts.AddTouchedBodies(body);
            if (!TryRespond(body))
            {
                // What gives way does so in its own step. Until then it is as immovable as the ground, and this body waits.
                break;
            }

            var spin = body.AngularVelocity.Length();
            var elapsed = Advance(body, spin * timeLeft > MaxTurn ? MaxTurn / spin : timeLeft);
            timeLeft -= elapsed;
            simultaneousImpacts = elapsed > 0 ? 0 : simultaneousImpacts + 1;
        }
    }

    /// <summary>Moves the body along a plan until it touches something new, or the time is up.</summary>
    /// <returns>The time that has passed; infinite where the sweep needed too many advances, which loses the remaining time.</returns>
    private double Advance(Body body, double duration)
    {
        CollectRows(body, withAwake: false);
        var start = body.Position;
        var startTime = _obstacles.Time;
        var isCarried = body.HasMovingSurface;
        var orientation = body.Orientation;
        var energy = body.KineticEnergy;
        var momentum = body.InertiaTensor * body.AngularVelocity;
        var minRadius = double.PositiveInfinity;
        foreach (var ball in body.Balls)
        {
            minRadius = Math.Min(minRadius, ball.Radius);
        }

        Contact? touched = null;
        var touchedBall = 0;
        for (var plan = 1; ; plan++)
        {
            var end = Plan(body, duration, out var planned);
            _obstacles.Time = startTime;
            if (planned == default && body.Velocity == Vector.Zero && body.AngularVelocity == Vector.Zero && !isCarried
                && body.KinematicPush == 0)
            {
                return duration;
            }

            var turn = 0.5 * (body.SpinBase + planned.Spin);
            var path = new RigidPath(new(start, body.Velocity, (planned.Velocity - body.Velocity) / duration), turn);
            _obstacles.SelectBall(body.Radius, body.SafeDistance);
            _obstacles.CollectNearbyBodies(path.Motion, duration, body.Index);
            var allowance = _rows.Count > 0 ? path.Sagitta(body.MaxArm, duration) : 0;
            var isHit = _sweep.TryFindImpact(body, in path, duration, allowance, out var hit, out var ballIndex, out var elapsed);
            var share = elapsed / duration;
            if (isHit && elapsed > 0 && 4 * allowance * share * (1 - share) > MaxDip * minRadius && plan < MaxPlans)
            {
                duration = elapsed;
                touched = hit;
                touchedBall = ballIndex;
                continue;
            }

            if (isHit && 4 * allowance * share * (1 - share) > MaxDip * minRadius)
            {
                _obstacles.Time = startTime;
                isHit = _sweep.TryFindImpact(body, in path, duration, allowance: 0, out hit, out ballIndex, out elapsed);
                share = elapsed / duration;
            }

            if (!isHit && elapsed < duration)
            {
                // Somewhere on the way it may be as deep as is allowed there.
                return double.PositiveInfinity;
            }

            // Between both ends the angular momentum changes evenly: in free flight not at all.
            body.Position = path.Motion.PositionAt(elapsed);
            body.SetOrientation(orientation.TurnedBy(duration * turn));
            var finalMomentum = body.InertiaTensor * planned.Spin;
            body.SetOrientation(orientation.TurnedBy(elapsed * turn));
            body.AngularVelocity = share < 1 ? body.InverseInertiaTensor * (momentum + (share * (finalMomentum - momentum))) : end.Spin;
            body.NetAcceleration = path.Motion.Acceleration;
            body.Velocity = share < 1 ? path.Motion.VelocityAt(elapsed) : end.Velocity;
            if (isHit)
            {
                body.Balls[ballIndex].Contacts.Add(in hit, body.BallCentre(ballIndex));
            }
            else if (touched is { } last)
            {
                // What the shorter plan does not quite meet is as near as a contact.
                body.Balls[touchedBall].Contacts.Add(in last, body.BallCentre(touchedBall));
            }

            _contacts.UpdateAfterMove(body);
            _planner.Report(CollectionsMarshal.AsSpan(_rows));
            if (isCarried || body.HasMovingSurface)
            {
                // What moves does work.
                return elapsed;
            }

            LimitEnergy(body, energy + (body.Description.Mass * Vector.Dot(body.FreeAcceleration, body.Position - start)));
            return elapsed;
        }
    }

    /// <summary>Finds the velocities at the end of a time, with the forces of all contacts; 0 for a body that rests.</summary>
    /// <param name="body">The compound.</param>
    /// <param name="duration">Seconds.</param>
    /// <param name="planned">Receives the velocities whose mean with those at the beginning is the way.</param>
    private (Vector Velocity, Vector Spin) Plan(Body body, double duration, out (Vector Velocity, Vector Spin) planned)
    {
        if (_rows.Count == 0)
        {
            FreeTurn.Plan(body, duration);
            planned = (body.Velocity + (duration * body.FreeAcceleration), body.FreeSpin);
            return planned;
        }

        var end = _planner.FindForcesOn([body.Index], CollectionsMarshal.AsSpan(_rows), duration, out planned);
        var negligible = RestFraction * duration * body.FreeAcceleration.Length();
        if (planned.Velocity.MaxAbsComponent() <= negligible && body.Velocity.MaxAbsComponent() <= negligible
            && planned.Spin.MaxAbsComponent() * body.Radius <= negligible
            && body.AngularVelocity.MaxAbsComponent() * body.Radius <= negligible)
        {
            planned = default;
            end = default;
            body.Velocity = Vector.Zero;
            body.AngularVelocity = Vector.Zero;
        }

        return end;
    }

    /// <summary>Takes back what contacts have added to the energy of a body: what is immovable does no work.</summary>
    private static void LimitEnergy(Body body, double limit)
    {
        var energy = body.KineticEnergy;
        if (energy > 0 && energy > limit + (EnergyRounding * (energy + Math.Abs(limit))))
        {
            var scale = Math.Sqrt(Math.Max(0, limit) / energy);
            body.Velocity *= scale;
            body.AngularVelocity *= scale;
        }
    }
}
