using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>
/// Moves a body through one step: free flight to the moment of an impact, the response there, and the same again with the remaining time.
/// What a body rests on cancels its part of the acceleration, so that nothing is pressed in and pushed out again.
/// </summary>
internal sealed class BodyMover
{
    private const int MaxImpacts = 1000;

    // Impacts without time in between: more of them are a corner that leaves no path.
    private const int MaxSimultaneousImpacts = 16;

    // Of the step: an advance shorter than this makes no progress.
    private const double NegligibleTimeFraction = 1e-3;

    // Of the speed: a body that leads more into another, which will give way, waits until it has.
    private const double MaxBlockedSpeedRatio = 0.01;

    // Of the restitution threshold: a body that leaves more slowly does not leave.
    private const double NegligibleSpeedFraction = 1e-4;

    // Of the touch tolerance: overlaps up to this are taken back as rounding.
    private const double MaxRoundingOverlap = 10;

    private readonly List<Body> _bodies;
    private readonly Obstacles _obstacles;
    private readonly ContactResponse _response;
    private readonly SphereSweep _sweep;
    private readonly OverlapResolver _overlapResolver;
    private readonly HalfSpaces _planes = new();

    public BodyMover(List<Body> bodies, Obstacles obstacles, SleepIslands islands)
    {
        _bodies = bodies;
        _obstacles = obstacles;
        _response = new(bodies, islands);
        _sweep = new(obstacles);
        _overlapResolver = new(obstacles);
    }

    /// <summary>Moves a body. The obstacles must be set up for it.</summary>
    /// <param name="body">Awake.</param>
    /// <param name="acceleration">By gravity and forces, units per second².</param>
    /// <param name="stepLength">Seconds.</param>
    /// <param name="restitutionThreshold">Approach speed below which the body does not bounce, units per second.</param>
    public void Move(Body body, Vector acceleration, double stepLength, double restitutionThreshold)
    {
        var position = body.Position;
        var contacts = body.Contacts;
        var contactSlop = _obstacles.ContactSlop(position);
        if (!body.IsOverlapResolved && !TryResolveOverlap(body, ref position))
        {
            return;
        }

        _sweep.ResetStepBudget();
        contacts.Refresh(position, contactSlop, body.Radius);
        _obstacles.CollectNearbyBodies(new(position, Vector.Zero, Vector.Zero), 0, body.Index);
        _obstacles.AddTouchedBodies(position, contactSlop, contacts);
        _response.ApplyPendingLoad(body, position);
        var timeLeft = stepLength;
        var simultaneousImpacts = 0;
        var isBlocked = false;
        var negligibleSpeed = NegligibleSpeedFraction * restitutionThreshold;
        for (var impact = 0; impact < MaxImpacts && simultaneousImpacts < MaxSimultaneousImpacts && timeLeft > 0; impact++)
        {
            var velocityBefore = body.Velocity;
            _response.ResolveContacts(body, position, restitutionThreshold);
            body.Velocity = contacts.RemoveSeparating(position, body.Velocity, _bodies, negligibleSpeed, isBlocked);
            var hasResponded = (body.Velocity - velocityBefore).MaxAbsComponent() > negligibleSpeed;
            var elapsed = Advance(body, acceleration, ref position, timeLeft, negligibleSpeed, isBlocked);
            timeLeft -= elapsed;
            simultaneousImpacts = elapsed > 0 ? 0 : simultaneousImpacts + 1;
            // A body that is run into gives way, but in its own turn. Until then it is as firm as the ground: this one slides or waits.
            isBlocked |= !hasResponded && elapsed < NegligibleTimeFraction * stepLength && contacts.HasAwakeBody(_bodies);
        }

        // The response to an impact in the last moment follows in the next step.
        body.Position = position;
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
        var projectedVelocity = isBlocked ? contacts.ProjectVelocity(body.Velocity, position, _planes) : body.Velocity;
        var blockedVelocity = body.Velocity - projectedVelocity;
        if (blockedVelocity.Length() > MaxBlockedSpeedRatio * projectedVelocity.Length())
        {
            // It would go another path than its own.
            return duration;
        }

        body.Velocity = projectedVelocity;
        var netAcceleration = contacts.ProjectAcceleration(acceleration, position, projectedVelocity, _bodies, _planes, isBlocked,
            out var validDuration);
        var elapsed =
            AdvanceAlong(body, netAcceleration, acceleration, ref position, Math.Min(duration, validDuration), negligibleSpeed);
        body.Velocity += blockedVelocity;
        return elapsed;
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
        var maxDuration = duration;
        if (body.Description.Friction > 0 && contacts.Count > 0)
        {
            isStopping = ContactResponse.ApplyFriction(body, acceleration, ref netAcceleration, ref duration);
        }

        var isSlow = contacts.Count > 0 && body.Velocity.MaxAbsComponent() <= negligibleSpeed;
        body.Velocity = netAcceleration == Vector.Zero && isSlow ? Vector.Zero : body.Velocity;
        body.NetAcceleration = netAcceleration;
        if (body.Velocity == Vector.Zero && netAcceleration == Vector.Zero)
        {
            _response.TransmitLoad(body, acceleration, position, maxDuration);
            return maxDuration;
        }

        var motion = new Motion(position, body.Velocity, netAcceleration);
        _obstacles.CollectNearbyBodies(in motion, duration, body.Index);
        var isHit = _sweep.TryFindImpact(in motion, duration, out var hit, out var elapsed);
        _response.TransmitLoad(body, acceleration, position, elapsed);
        position = motion.PositionAt(elapsed);
        body.Velocity = motion.VelocityAt(elapsed);
        if (isHit)
        {
            position = RemoveRoundingOverlap(position, in hit);
            contacts.Add(in hit, position);
        }
        else if (isStopping)
        {
            body.Velocity = Vector.Zero;
        }

        contacts.UpdateAfterMove(position, _obstacles.ContactSlop(position), _obstacles);
        return isHit || elapsed >= duration ? elapsed : double.PositiveInfinity;
    }

    /// <summary>Pushes a body out that overlaps something; one that cannot be pushed out stops.</summary>
    private bool TryResolveOverlap(Body body, ref Vector position)
    {
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
