using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>
/// Moves a body through one step: free flight to the moment of an impact, the response there, and the same again with the remaining time.
/// What a body rests on cancels its part of the acceleration, so that nothing is pressed in and pushed out again.
/// </summary>
internal sealed partial class BodyMover
{
    private const int MaxImpacts = 1000;

    // Impacts without time in between: more of them are a corner that leaves no path.
    private const int MaxSimultaneousImpacts = 16;

    // Relative to the step: an advance shorter than this makes no progress.
    private const double NegligibleTimeFraction = 1e-3;

    // Relative to the speed: a body that leads more into another, which will give way, waits until it has.
    private const double MaxBlockedSpeedRatio = 0.01;

    // Relative to the restitution threshold: a body that leaves more slowly does not leave.
    private const double NegligibleSpeedFraction = 1e-4;

    // Relative to the touch tolerance: overlaps up to this are taken back as rounding.
    private const double MaxRoundingOverlap = 10;

    // Relative to the squared speeds: what rounding adds.
    private const double EnergyRounding = 1e-12;

    private readonly List<Body> _bodies;
    private readonly Obstacles _obstacles;
    private readonly ContactResponse _response;
    private readonly ContactLog _contactLog;
    private readonly SpinFriction _spinFriction;
    private readonly SphereSweep _sweep;
    private readonly OverlapResolver _overlapResolver;
    private readonly NearSurfaceSearch _nearSurfaceSearch;
    private readonly HalfSpaces _planes = new();

    public BodyMover(List<Body> bodies, Obstacles obstacles, SleepIslands islands, ContactLog contactLog)
    {
        _bodies = bodies;
        _obstacles = obstacles;
        _response = new(bodies, islands, contactLog);
        _contactLog = contactLog;
        _spinFriction = new(bodies);
        _sweep = new(obstacles);
        _overlapResolver = new(obstacles);
        _nearSurfaceSearch = new(obstacles);
    }

    /// <summary>Moves a body that touches no other, or only such as do not move. The obstacles must be set up for it.</summary>
    /// <param name="body">Awake and prepared.</param>
    /// <param name="stepLength">Seconds.</param>
    public void Move(Body body, double stepLength)
    {
        if (!body.IsOverlapResolved)
        {
            return;
        }

        var position = body.Position;
        _sweep.ResetStepBudget();
        _obstacles.CollectNearbyBodies(new(position, Vector.Zero, Vector.Zero), 0, body.Index);
        _obstacles.AddTouchedBodies(position, _obstacles.ContactSlop(position), body.Contacts);
        body.MayTouchBodies |= body.Contacts.HasBody;
        MoveOn(body, ref position, stepLength, stepLength);
        body.Position = position;
    }

    /// <summary>Moves a body from contact to contact.</summary>
    private void MoveOn(Body body, ref Vector position, double timeLeft, double stepLength)
    {
        var contacts = body.Contacts;
        var acceleration = body.FreeAcceleration;
        var restitutionThreshold = body.RestitutionThreshold;
        var simultaneousImpacts = 0;
        var isBlocked = false;
        var negligibleSpeed = NegligibleSpeedFraction * restitutionThreshold;
        for (var impact = 0; impact < MaxImpacts && simultaneousImpacts < MaxSimultaneousImpacts && timeLeft > 0; impact++)
        {
            _obstacles.Time = stepLength - timeLeft;
            var velocityBefore = body.Velocity;
            _response.ResolveContacts(body, position, restitutionThreshold);
            body.Velocity = contacts.RemoveSeparating(position, body.Velocity, _bodies, negligibleSpeed, true);
            var hasResponded = (body.Velocity - velocityBefore).MaxAbsComponent() > negligibleSpeed;
            var elapsed = Advance(body, acceleration, ref position, timeLeft, negligibleSpeed, isBlocked);
            timeLeft -= elapsed;
            simultaneousImpacts = elapsed > 0 ? 0 : simultaneousImpacts + 1;
            // A body that is run into gives way, but in its own turn. Until then it is immovable: this one slides or waits.
            isBlocked |= !hasResponded && elapsed < NegligibleTimeFraction * stepLength && contacts.HasAwakeBody(_bodies);
        }
    }

    /// <summary>Chooses where contacts let the body go, and moves it there.</summary>
    /// <param name="body">Leads into nothing that it touches.</param>
    /// <param name="acceleration">By gravity and forces.</param>
    /// <param name="position">Position of the body; receives the new one.</param>
    /// <param name="duration">Seconds.</param>
    /// <param name="negligibleSpeed">Speed below which a body without acceleration rests.</param>
    /// <param name="isBlocked">Other bodies do not give way.</param>
    /// <returns>The time that has passed.</returns>
    private double Advance(Body body, Vector acceleration, ref Vector position, double duration, double negligibleSpeed, bool isBlocked)
    {
        var contacts = body.Contacts;
        var start = position;
        var energy = body.KineticEnergy;
        var mayGain = (contacts.HasBody || (body.Description is { Friction: > 0, IsRotationLocked: false } && contacts.Count > 0))
            && !contacts.HasMovingSurface;
        var projectedVelocity = isBlocked ? contacts.ProjectVelocity(body.Velocity, position, _planes) : body.Velocity;
        var blockedVelocity = body.Velocity - projectedVelocity;
        if (blockedVelocity.Length() > MaxBlockedSpeedRatio * projectedVelocity.Length())
        {
            // It would go another path than its own.
            return duration;
        }

        body.Velocity = projectedVelocity;
        var netAcceleration = contacts.ProjectAcceleration(acceleration, position, projectedVelocity, _bodies, _planes, true,
            out var validDuration);
        var elapsed =
            AdvanceAlong(body, netAcceleration, acceleration, ref position, Math.Min(duration, validDuration), negligibleSpeed);
        body.Velocity += blockedVelocity;
        _contactLog.AddRest(body, position, acceleration, netAcceleration, Math.Min(elapsed, duration));
        if (mayGain)
        {
            LimitEnergy(body, energy + (body.Description.Mass * Vector.Dot(acceleration, position - start)));
        }

        return elapsed;
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

    /// <summary>Moves the body until it touches something new, friction has stopped or turned it, or the time is up.</summary>
    /// <param name="body">Leads into nothing that it touches.</param>
    /// <param name="netAcceleration">What the contacts leave of the acceleration.</param>
    /// <param name="acceleration">By gravity and forces.</param>
    /// <param name="position">Position of the body; receives the new one.</param>
    /// <param name="duration">Seconds.</param>
    /// <param name="negligibleSpeed">Speed below which a body without acceleration rests.</param>
    /// <returns>The time that has passed; infinite where the sweep needed too many advances, which loses the remaining time.</returns>
    private double AdvanceAlong(
        Body body, Vector netAcceleration, Vector acceleration, ref Vector position, double duration, double negligibleSpeed)
    {
        var contacts = body.Contacts;
        var isStopping = false;
        var stoppedVelocity = Vector.Zero;
        var spinAcceleration = Vector.Zero;
        var maxDuration = duration;
        var isCarried = contacts.HasMovingSurface;
        if (body.Description.Friction > 0 && contacts.Count > 0)
        {
            if (body.Description.IsRotationLocked)
            {
                isStopping = ApplyFriction(body, position, acceleration, ref netAcceleration, ref duration, out stoppedVelocity);
            }
            else
            {
                _spinFriction.Apply(body, position, acceleration, ref netAcceleration, ref duration, out spinAcceleration);
            }
        }

        var isSlow = contacts.Count > 0 && !isCarried && body.Velocity.MaxAbsComponent() <= negligibleSpeed;
        body.Velocity = netAcceleration == Vector.Zero && isSlow ? Vector.Zero : body.Velocity;
        body.NetAcceleration = netAcceleration;
        var motion = new SphereMotion(position, body.Velocity, netAcceleration);
        if (body.Velocity == Vector.Zero && netAcceleration == Vector.Zero && _obstacles.MaxKinematicSpeed(in motion, duration) == 0)
        {
            body.AngularVelocity += (spinAcceleration == Vector.Zero ? 0 : duration) * spinAcceleration;
            return spinAcceleration == Vector.Zero ? maxDuration : duration;
        }

        _obstacles.CollectNearbyBodies(in motion, duration, body.Index);
        var isHit = _sweep.TryFindImpact(in motion, duration, out var hit, out var elapsed);
        position = motion.PositionAt(elapsed);
        body.Velocity = motion.VelocityAt(elapsed);
        body.AngularVelocity += elapsed * spinAcceleration;
        if (isHit)
        {
            position = RemoveRoundingOverlap(position, in hit);
            contacts.Add(in hit, position);
            if (hit.IsBody)
            {
                body.MayTouchBodies = true;
                _bodies[hit.BodyIndex].MayTouchBodies = true;
            }
        }
        else if (isStopping)
        {
            body.Velocity = stoppedVelocity;
        }

        _obstacles.UpdateAfterMove(contacts, position);
        return isHit || elapsed >= duration ? elapsed : double.PositiveInfinity;
    }

    /// <summary>Slows down a body that does not turn, relative to what carries it.</summary>
    /// <returns>True when the body has the velocity of what carries it after that time.</returns>
    private static bool ApplyFriction(
        Body body, Vector position, Vector acceleration, ref Vector netAcceleration, ref double duration, out Vector stoppedVelocity)
    {
        var maxDuration = duration;
        var carrying = body.Contacts.CarryingVelocity(position, out var carryingAcceleration);
        netAcceleration -= carryingAcceleration;
        var isStopping = ContactResponse.ApplyFriction(
            body, body.Velocity - carrying, acceleration - carryingAcceleration, ref netAcceleration, ref duration);
        netAcceleration += carryingAcceleration;
        if (body.Contacts.HasMovingSurface && !(duration > 0))
        {
            // It goes along already.
            duration = maxDuration;
        }

        stoppedVelocity = carrying + (duration * carryingAcceleration);
        return isStopping;
    }

    /// <summary>Pushes a body out that overlaps something; one that cannot be pushed out stops.</summary>
    private bool TryResolveOverlap(Body body)
    {
        var position = body.Position;
        body.SafeDistance.Invalidate();
        body.Contacts.Clear();
        body.IsStuck = !_overlapResolver.TryResolve(ref position, body.Index);
        body.IsOverlapResolved = !body.IsStuck;
        body.Position = position;
        if (body.IsStuck)
        {
            body.Velocity = Vector.Zero;
            body.NetAcceleration = Vector.Zero;
        }

        return body.IsOverlapResolved;
    }

    /// <summary>Moves a position out of an obstacle that it overlaps by no more than rounding.</summary>
    private Vector RemoveRoundingOverlap(Vector position, in Contact contact)
    {
        var gap = contact.Gap(position);
        return gap < 0 && -gap <= MaxRoundingOverlap * _obstacles.TouchTolerance(position)
            ? position - (gap * contact.Normal(position))
            : position;
    }
}
