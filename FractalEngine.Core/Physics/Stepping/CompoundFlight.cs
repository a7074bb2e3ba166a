using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Physics.Solving;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>
/// Leads a compound from impact to impact. What it touches is solved as an island of one body, again after each impact and each small turn.
/// </summary>
internal sealed class CompoundFlight(
    List<Body> bodies, Obstacles obstacles, BodySweep sweep, BodyContacts contacts, SleepIslands islands, IslandPlanner planner)
{
    // Radians: a turn that is planned at once.
    private const double MaxTurn = 0.25;

    // Relative to the speed that gravity gives: a plan that leaves no more is rest.
    private const double RestFraction = 1e-10;

    private const int InitialCapacity = 64;

    private readonly List<ContactRow> _rows = new(InitialCapacity);
    private readonly List<int> _members = new(InitialCapacity);

    /// <summary>True where the last advance has ended at something that was touched.</summary>
    public bool HasMet { get; private set; }

    /// <summary>Responds to what the compound touches, and moves it until it touches something new, or the time is up.</summary>
    /// <param name="body">Touches no other body that is awake. Obstacles must be set up for it.</param>
    /// <param name="timeLeft">Seconds.</param>
    /// <returns>The time that has passed; infinite where the remaining time is lost.</returns>
    public double Advance(Body body, double timeLeft)
    {
        var speed = body.Velocity.Length() + (timeLeft * body.FreeAcceleration.Length());
        var turn = Math.Min(MaxTurn, timeLeft * body.AngularVelocity.Length());
        contacts.FindNearSurfaces(body, timeLeft * speed, turn, timeLeft);
        contacts.TakeBackRounding(body);
        contacts.AddTouchedBodies(body);
        if (!TryRespond(body))
        {
            // What gives way does so in its own step. Until then it is as immovable as the ground, and this body waits.
            return double.PositiveInfinity;
        }

        var spin = body.AngularVelocity.Length();
        return Follow(body, spin * timeLeft > MaxTurn ? MaxTurn / spin : timeLeft);
    }

    /// <summary>Takes away all approaches, by impulses that other bodies receive too.</summary>
    /// <returns>False where another body that is awake stays in touch.</returns>
    private bool TryRespond(Body body)
    {
        CollectRows(body);
        planner.StopApproachesOf(CollectionsMarshal.AsSpan(_members), CollectionsMarshal.AsSpan(_rows));
        var isFree = true;
        foreach (ref readonly var row in CollectionsMarshal.AsSpan(_rows))
        {
            if (row.Second >= 0)
            {
                var velocity = body.VelocityAt(row.FirstArm) - bodies[row.Second].VelocityAt(row.SecondArm);
                isFree &= Vector.Dot(velocity, row.Normal) > 0.5 * body.RestitutionThreshold;
            }
        }

        return isFree;
    }

    /// <summary>Makes contacts of all that the balls touch or may meet.</summary>
    private void CollectRows(Body body)
    {
        _rows.Clear();
        _members.Clear();
        _members.Add(body.Index);
        for (var i = 0; i < body.Balls.Length; i++)
        {
            var ball = body.Balls[i];
            for (var j = 0; j < ball.Contacts.Count; j++)
            {
                if (ball.Contacts[j].IsBody)
                {
                    AddBody(body, i, in ball.Contacts[j]);
                }
                else
                {
                    _rows.Add(ContactRows.OfSurface(body, i, ball.Contacts[j]));
                }
            }

            for (var j = 0; j < ball.NearSurfaces.Count; j++)
            {
                _rows.Add(ContactRows.OfNearSurface(body, i, in ball.NearSurfaces[j]));
            }
        }

        if (body.Description.Shape!.IsCapsule)
        {
            CollectionsMarshal.SetCount(_rows, CapsuleRows.RemoveInner(CollectionsMarshal.AsSpan(_rows)));
        }
    }

    /// <summary>Adds the contact with another body, and wakes it where it is hit.</summary>
    private void AddBody(Body body, int ball, in Contact contact)
    {
        var other = bodies[contact.BodyIndex];
        var approach = -Vector.Dot(body.VelocityAt(body.BallOffset(ball)), contact.Normal(body.BallCentre(ball)));
        if (other.IsAsleep && approach > body.RestitutionThreshold)
        {
            islands.Wake(other);
        }

        var isImmovable = other.IsAsleep || other.IsStuck;
        var row = new ContactRow();
        ContactRows.SetBalls(ref row, body, ball, other, contact.BodyBall, isImmovable, isAhead: false);
        _rows.Add(row);
        if (!isImmovable && !_members.Contains(other.Index))
        {
            _members.Add(other.Index);
        }
    }

    /// <summary>Moves the body along a plan until it touches something new, or the time is up.</summary>
    /// <returns>The time that has passed; infinite where there is no way, which loses the remaining time.</returns>
    private double Follow(Body body, double duration)
    {
        // What is awake has been left.
        _ = _rows.RemoveAll(static row => row.Second >= 0);
        var start = body.Position;
        var startTime = obstacles.Time;
        var isCarried = body.HasMovingSurface;
        var orientation = body.Orientation;
        var energy = body.KineticEnergy;
        var momentum = body.InertiaTensor * body.AngularVelocity;
        Contact? touched = null;
        HasMet = false;
        var touchedBall = 0;
        for (var plan = 1; plan <= BodySweep.MaxPlans; plan++)
        {
            var end = Plan(body, duration, out var planned);
            obstacles.Time = startTime;
            if (planned == default && body.Velocity == Vector.Zero && body.AngularVelocity == Vector.Zero && !isCarried
                && body.KinematicPush == 0)
            {
                return duration;
            }

            var turn = 0.5 * duration * (body.SpinBase + planned.Spin);
            var motion = new SphereMotion(start, body.Velocity, (planned.Velocity - body.Velocity) / duration);
            obstacles.SelectBall(body.Radius, body.SafeDistance);
            obstacles.CollectNearbyBodies(in motion, duration, body.Index);
            // Contacts that push are kept at the end, and so all along a straight way.
            var isStraight = planned.Velocity != body.Velocity + (duration * body.FreeAcceleration);
            var way = isStraight ? new(start, motion.VelocityAt(0.5 * duration), Vector.Zero) : motion;
            var isHit = sweep.TryFindImpact(body, in way, turn, duration, out var hit, out var ball, out var elapsed);
            var share = elapsed / duration;
            if (isHit)
            {
                touched = hit;
                touchedBall = ball;
                if (!BodySweep.IsOnWay(body, turn, share, isStraight ? duration * duration * motion.Acceleration.Length() : 0))
                {
                    // Where balls turn past what they meet, halves lead on.
                    duration = plan < BodySweep.MaxPlans / 2 ? elapsed : 0.5 * elapsed;
                    continue;
                }
            }
            else if (elapsed < duration)
            {
                break;
            }

            // Between both ends the angular momentum changes evenly: in free flight not at all.
            body.Position = motion.PositionAt(elapsed);
            body.SetOrientation(orientation.TurnedBy(turn));
            var finalMomentum = body.InertiaTensor * planned.Spin;
            body.SetOrientation(orientation.TurnedBy(share * turn));
            body.AngularVelocity = share < 1 ? body.InverseInertiaTensor * (momentum + (share * (finalMomentum - momentum))) : end.Spin;
            body.Velocity = share < 1 ? motion.VelocityAt(elapsed) : end.Velocity;
            if (touched is { } met)
            {
                // What a shorter plan does not quite meet is as near as a contact.
                HasMet = true;
                body.Balls[touchedBall].Contacts.Add(in met, body.BallCentre(touchedBall));
            }

            contacts.UpdateAfterMove(body);
            planner.Log(CollectionsMarshal.AsSpan(_rows));
            if (!isCarried && !body.HasMovingSurface)
            {
                // What moves does work.
                body.LimitEnergy(energy + (body.Description.Mass * Vector.Dot(body.FreeAcceleration, body.Position - start)));
            }

            return elapsed;
        }

        return double.PositiveInfinity;
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

        var end = planner.FindForcesOn(body, CollectionsMarshal.AsSpan(_rows), duration, out planned);
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
}
