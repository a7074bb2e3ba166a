using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Solving;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>
/// Leads a ball from impact to impact in closed form. What it rests on cancels its part of the acceleration, so that nothing is pressed in
/// and pushed out again.
/// </summary>
internal sealed class BallFlight(
    List<Body> bodies, Obstacles obstacles, BodySweep sweep, SleepIslands islands, IslandPlanner planner, ContactLog contactLog)
{
    // Relative to the step: an advance shorter than this makes no progress.
    private const double NegligibleTimeFraction = 1e-3;

    // Relative to the speed: a body that leads more into another, which will give way, waits until it has.
    private const double MaxBlockedSpeedRatio = 0.01;

    // Relative to the restitution threshold: a body that leaves more slowly does not leave.
    private const double NegligibleSpeedFraction = 1e-4;

    private readonly ContactResponse _response = new(bodies, islands, planner, contactLog);
    private readonly SpinFriction _spinFriction = new(bodies);
    private readonly HalfSpaces _planes = new();
    private double _stepLength;
    private bool _isBlocked;

    /// <summary>Begins the step of a ball.</summary>
    /// <param name="body">Its contacts must be up to date.</param>
    /// <param name="stepLength">Seconds.</param>
    public void Begin(Body body, double stepLength)
    {
        body.MayTouchBodies |= body.Contacts.HasBody;
        _stepLength = stepLength;
        _isBlocked = false;
    }

    /// <summary>Responds to what the ball touches, and moves it until it touches something new, or the time is up.</summary>
    /// <param name="body">The ball. Obstacles must be set up for it.</param>
    /// <param name="timeLeft">Seconds.</param>
    /// <returns>The time that has passed; infinite where the remaining time is lost.</returns>
    public double Advance(Body body, double timeLeft)
    {
        var contacts = body.Contacts;
        var negligibleSpeed = NegligibleSpeedFraction * body.RestitutionThreshold;
        var velocityBefore = body.Velocity;
        _response.ResolveContacts(body);
        body.Velocity = contacts.RemoveSeparating(body.Position, body.Velocity, bodies, negligibleSpeed);
        var hasResponded = (body.Velocity - velocityBefore).MaxAbsComponent() > negligibleSpeed;
        var elapsed = Follow(body, timeLeft, negligibleSpeed);
        // A body that is run into gives way, but in its own turn. Until then it is immovable: this one slides or waits.
        _isBlocked |= !hasResponded && elapsed < NegligibleTimeFraction * _stepLength && contacts.HasAwakeBody(bodies);
        return elapsed;
    }

    /// <summary>Chooses where contacts let the ball go, and moves it there.</summary>
    /// <param name="body">Leads into nothing that it touches.</param>
    /// <param name="duration">Seconds.</param>
    /// <param name="negligibleSpeed">Speed below which a body without acceleration rests.</param>
    /// <returns>The time that has passed.</returns>
    private double Follow(Body body, double duration, double negligibleSpeed)
    {
        var contacts = body.Contacts;
        var acceleration = body.FreeAcceleration;
        var start = body.Position;
        var energy = body.KineticEnergy;
        var mayGain = (contacts.HasBody || (body.Description is { Friction: > 0, IsRotationLocked: false } && contacts.Count > 0))
            && !contacts.HasMovingSurface;
        var projectedVelocity = _isBlocked ? contacts.ProjectVelocity(body.Velocity, start, _planes) : body.Velocity;
        var blockedVelocity = body.Velocity - projectedVelocity;
        if (blockedVelocity.Length() > MaxBlockedSpeedRatio * projectedVelocity.Length())
        {
            // It would go another path than its own.
            return duration;
        }

        body.Velocity = projectedVelocity;
        var netAcceleration = contacts.ProjectAcceleration(acceleration, start, projectedVelocity, _planes, out var validDuration);
        var elapsed = FollowAcceleration(body, netAcceleration, Math.Min(duration, validDuration), negligibleSpeed);
        body.Velocity += blockedVelocity;
        contactLog.AddRest(body, body.Position, acceleration, netAcceleration, Math.Min(elapsed, duration));
        if (mayGain)
        {
            body.LimitEnergy(energy + (body.Description.Mass * Vector.Dot(acceleration, body.Position - start)));
        }

        return elapsed;
    }

    /// <summary>Moves the ball until it touches something new, friction has stopped or turned it, or the time is up.</summary>
    /// <param name="body">Leads into nothing that it touches.</param>
    /// <param name="netAcceleration">What the contacts leave of the acceleration.</param>
    /// <param name="duration">Seconds.</param>
    /// <param name="negligibleSpeed">Speed below which a body without acceleration rests.</param>
    /// <returns>The time that has passed; infinite where the sweep needed too many advances, which loses the remaining time.</returns>
    private double FollowAcceleration(Body body, Vector netAcceleration, double duration, double negligibleSpeed)
    {
        var contacts = body.Contacts;
        var isStopping = false;
        var stoppedVelocity = Vector.Zero;
        var spinAcceleration = Vector.Zero;
        var maxDuration = duration;
        if (body.Description.Friction > 0 && contacts.Count > 0)
        {
            if (body.Description.IsRotationLocked)
            {
                isStopping = ApplyFriction(body, ref netAcceleration, ref duration, out stoppedVelocity);
            }
            else
            {
                _spinFriction.Apply(body, ref netAcceleration, ref duration, out spinAcceleration);
            }
        }

        var isSlow = contacts.Count > 0 && !contacts.HasMovingSurface && body.Velocity.MaxAbsComponent() <= negligibleSpeed;
        body.Velocity = netAcceleration == Vector.Zero && isSlow ? Vector.Zero : body.Velocity;
        var motion = new SphereMotion(body.Position, body.Velocity, netAcceleration);
        if (body.Velocity == Vector.Zero && netAcceleration == Vector.Zero && obstacles.MaxKinematicSpeed(in motion, duration) == 0)
        {
            body.AngularVelocity += (spinAcceleration == Vector.Zero ? 0 : duration) * spinAcceleration;
            return spinAcceleration == Vector.Zero ? maxDuration : duration;
        }

        obstacles.CollectNearbyBodies(in motion, duration, body.Index);
        var isHit = sweep.TryFindImpact(body, in motion, Vector.Zero, duration, out var hit, out _, out var elapsed);
        body.Position = motion.PositionAt(elapsed);
        body.Velocity = motion.VelocityAt(elapsed);
        body.AngularVelocity += elapsed * spinAcceleration;
        if (isHit)
        {
            sweep.RemoveRoundingOverlap(body, ball: 0, in hit);
            contacts.Add(in hit, body.Position);
            if (hit.IsBody)
            {
                body.MayTouchBodies = true;
                bodies[hit.BodyIndex].MayTouchBodies = true;
            }
        }
        else if (isStopping)
        {
            body.Velocity = stoppedVelocity;
        }

        obstacles.UpdateAfterMove(contacts, body.Position, obstacles.ContactSlop(body.Position));
        if (hit.Kinematic is not null)
        {
            // A face that turns is met again where it has turned to.
            contacts.RemoveDuplicates(body.Position);
        }

        return isHit || elapsed >= duration ? elapsed : double.PositiveInfinity;
    }

    /// <summary>Slows down a body that does not turn, relative to what carries it.</summary>
    /// <returns>True when the body has the velocity of what carries it after that time.</returns>
    private static bool ApplyFriction(Body body, ref Vector netAcceleration, ref double duration, out Vector stoppedVelocity)
    {
        var maxDuration = duration;
        var carrying = body.Contacts.CarryingVelocity(body.Position, out var carryingAcceleration);
        netAcceleration -= carryingAcceleration;
        var isStopping = ContactResponse.ApplyFriction(
            body, body.Velocity - carrying, body.FreeAcceleration - carryingAcceleration, ref netAcceleration, ref duration);
        netAcceleration += carryingAcceleration;
        if (body.Contacts.HasMovingSurface && !(duration > 0))
        {
            // It goes along already.
            duration = maxDuration;
        }

        stoppedVelocity = carrying + (duration * carryingAcceleration);
        return isStopping;
    }
}
