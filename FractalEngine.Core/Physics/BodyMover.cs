using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>
/// Takes a body through a step: free flight to the moment of an impact, the paper's response there (v ← −e·vₙ + vₛ, §4.4.4), and on with
/// the rest of the time. What it rests on takes its part of the acceleration away, so that nothing is pressed in and pushed out again.
/// </summary>
internal sealed class BodyMover(List<Body> bodies, Obstacles obstacles, Action<Body> wakeIsland)
{
    private const int MaxImpacts = 1000;

    // Impacts at the same moment, one after the other: more are a corner that leaves no way.
    private const int MaxSimultaneousImpacts = 16;

    // Of a step: what is sooner is soon.
    private const double NegligibleTimeFraction = 1e-3;

    // Of the speed: who leads more into a body that gives way waits until it has.
    private const double MaxBlockedSpeedRatio = 0.01;

    // Relative to the speed: what rounding leaves along a normal.
    private const double RelativeTolerance = 1e-13;

    // Of the rest speed: what leaves more slowly does not leave.
    private const double NegligibleSpeedFraction = 1e-4;

    private readonly HalfSpaces _planes = new();
    private readonly SphereSweep _sweep = new(obstacles);
    private readonly OverlapResolver _overlapResolver = new(obstacles, new());

    /// <summary>Moves a body. The obstacles must be set up for it.</summary>
    /// <param name="body">Awake.</param>
    /// <param name="acceleration">By gravity and forces.</param>
    /// <param name="timeStep">Seconds.</param>
    /// <param name="restitutionThreshold">Approaches that are slower do not bounce.</param>
    public void Move(Body body, Vector acceleration, double timeStep, double restitutionThreshold)
    {
        var (position, contacts) = (body.Position, body.Contacts);
        var contactSlop = obstacles.ContactSlop(position);
        if (!body.IsOverlapResolved && !TryResolveOverlap(body, ref position))
        {
            return;
        }

        _sweep.ResetStepBudget();
        contacts.Refresh(position, contactSlop, body.Radius);
        obstacles.CollectNearbyBodies(new(position, Vector.Zero, Vector.Zero), 0, body.Index);
        obstacles.AddTouchedBodies(position, contactSlop, contacts);
        ApplyPendingLoad(body, position);
        var (timeLeft, simultaneousImpacts, isBlocked, negligibleSpeed) =
            (timeStep, 0, false, NegligibleSpeedFraction * restitutionThreshold);
        for (var impact = 0; impact < MaxImpacts && simultaneousImpacts < MaxSimultaneousImpacts && timeLeft > 0; impact++)
        {
            var velocityBefore = body.Velocity;
            ResolveContacts(body, position, restitutionThreshold);
            body.Velocity = contacts.RemoveSeparating(position, body.Velocity, bodies, negligibleSpeed, isBlocked);
            var hasResponded = (body.Velocity - velocityBefore).MaxAbsComponent() > negligibleSpeed;
            var elapsed = Advance(body, acceleration, ref position, timeLeft, negligibleSpeed, isBlocked);
            (timeLeft, simultaneousImpacts) = (timeLeft - elapsed, elapsed > 0 ? 0 : simultaneousImpacts + 1);
            // What is run into gives way, but at its own turn: until then it is as firm as the ground, and one can only slide over it or
            // wait.
            isBlocked |= !hasResponded && elapsed < NegligibleTimeFraction * timeStep && contacts.HasAwakeBody(bodies);
        }

        // An impact in the last moment is answered in the next step.
        body.Position = position;
    }

    /// <summary>Goes on until something new is touched, friction has done its work, or the time is up.</summary>
    /// <param name="body">Leads into nothing that it touches.</param>
    /// <param name="acceleration">By gravity and forces.</param>
    /// <param name="position">Receives where it comes to.</param>
    /// <param name="time">Seconds.</param>
    /// <param name="negligibleSpeed">What is slower, and not accelerated, rests.</param>
    /// <param name="isBlocked">Nothing gives way.</param>
    /// <returns>The time that has passed.</returns>
    private double Advance(Body body, Vector acceleration, ref Vector position, double time, double negligibleSpeed, bool isBlocked)
    {
        var contacts = body.Contacts;
        var projectedVelocity = isBlocked ? contacts.ProjectVelocity(body.Velocity, position, _planes) : body.Velocity;
        var blockedVelocity = body.Velocity - projectedVelocity;
        if (blockedVelocity.Length() > MaxBlockedSpeedRatio * projectedVelocity.Length())
        {
            // It would go another way than its own.
            return time;
        }

        body.Velocity = projectedVelocity;
        var netAcceleration = contacts.ProjectAcceleration(acceleration, position, projectedVelocity, bodies, _planes, isBlocked,
            out var validDuration);
        var elapsed = Advance(body, netAcceleration, acceleration, ref position, Math.Min(time, validDuration), negligibleSpeed);
        body.Velocity += blockedVelocity;
        return elapsed;
    }

    private double Advance(Body body, Vector netAcceleration, Vector acceleration, ref Vector position, double time, double negligibleSpeed)
    {
        var contacts = body.Contacts;
        var (duration, isStopping) = (time, false);
        if (body.Description.Friction > 0 && contacts.Count > 0)
        {
            isStopping = ApplyFriction(body, acceleration, ref netAcceleration, ref duration);
        }

        var isSlow = contacts.Count > 0 && body.Velocity.MaxAbsComponent() <= negligibleSpeed;
        body.Velocity = netAcceleration == Vector.Zero && isSlow ? Vector.Zero : body.Velocity;
        body.NetAcceleration = netAcceleration;
        if (body.Velocity == Vector.Zero && netAcceleration == Vector.Zero)
        {
            TransmitLoad(body, acceleration, position, time);
            return time;
        }

        var motion = new Motion(position, body.Velocity, netAcceleration);
        obstacles.CollectNearbyBodies(in motion, duration, body.Index);
        var isHit = _sweep.TryFindImpact(in motion, duration, out var hit, out var elapsed);
        TransmitLoad(body, acceleration, position, elapsed);
        (position, body.Velocity) = (motion.PositionAt(elapsed), motion.VelocityAt(elapsed));
        if (isHit)
        {
            position = RemoveRoundingOverlap(position, in hit);
            contacts.Add(in hit, position);
        }
        else if (isStopping)
        {
            body.Velocity = Vector.Zero;
        }

        contacts.UpdateAfterMove(position, obstacles.ContactSlop(position), obstacles);
        // After too many advances the rest of the time is lost.
        return isHit || elapsed >= duration ? elapsed : double.PositiveInfinity;
    }

    /// <summary>A body that begins inside of something is pushed out; one that can't be stops.</summary>
    private bool TryResolveOverlap(Body body, ref Vector position)
    {
        body.SafeDistance.Invalidate();
        body.Contacts.Clear();
        body.IsStuck = !_overlapResolver.TryResolve(ref position, body.Index);
        body.IsOverlapResolved = !body.IsStuck;
        body.Position = position;
        if (body.IsStuck)
        {
            (body.Velocity, body.NetAcceleration) = (Vector.Zero, Vector.Zero);
        }

        return body.IsOverlapResolved;
    }

    /// <summary>
    /// What friction leaves of an acceleration. It acts against the velocity at the end of the time, so that it never turns a body round,
    /// and holds what is slow.
    /// </summary>
    /// <param name="body">Touches something.</param>
    /// <param name="acceleration">By gravity and forces.</param>
    /// <param name="netAcceleration">What the contacts leave of it; receives what friction leaves of that.</param>
    /// <param name="duration">How long it acts; receives the time until the body stands or turns, if that is sooner.</param>
    /// <returns>True when the body stands then.</returns>
    private static bool ApplyFriction(Body body, Vector acceleration, ref Vector netAcceleration, ref double duration)
    {
        var frictionDeceleration = body.Description.Friction * (acceleration - netAcceleration).Length();
        var (velocity, velocityDotAcceleration) = (body.Velocity, Vector.Dot(body.Velocity, netAcceleration));
        var speedSquared = velocity.LengthSquared();
        if (velocityDotAcceleration < 0)
        {
            // From there on the friction would help it.
            duration = Math.Min(duration, -speedSquared / velocityDotAcceleration);
        }

        var velocityWithoutFriction = velocity + (duration * netAcceleration);
        var speedWithoutFriction = velocityWithoutFriction.Length();
        if (speedWithoutFriction > duration * frictionDeceleration)
        {
            netAcceleration -= frictionDeceleration / speedWithoutFriction * velocityWithoutFriction;
            return false;
        }

        // When all that acceleration has added to the velocity, friction has taken: |v + s·t| = f·t.
        var excess = (frictionDeceleration * frictionDeceleration) - netAcceleration.LengthSquared();
        var stopTime = excess > 0
            ? (velocityDotAcceleration + Math.Sqrt((velocityDotAcceleration * velocityDotAcceleration) + (excess * speedSquared))) / excess
            : duration;
        duration = Math.Min(duration, stopTime);
        netAcceleration = duration > 0 ? -velocity / duration : Vector.Zero;
        return true;
    }

    /// <summary>
    /// What others press on a body with: it gives way where it can, and presses on what it lies on itself. Nothing bounces from a load.
    /// </summary>
    private void ApplyPendingLoad(Body body, Vector position)
    {
        var (loadVelocity, contacts) = (body.PendingLoadVelocity, body.Contacts);
        body.PendingLoadVelocity = Vector.Zero;
        if (loadVelocity == Vector.Zero)
        {
            return;
        }

        body.Velocity += contacts.ProjectVelocity(loadVelocity, position, _planes);
        for (var i = 0; i < contacts.Count; i++)
        {
            var normal = contacts[i].Normal(position);
            if (contacts[i].BodyIndex >= 0 && bodies[contacts[i].BodyIndex] is { IsAsleep: false } other
                && Vector.Dot(loadVelocity, normal) is < 0 and var normalSpeed)
            {
                other.PendingLoadVelocity += normalSpeed * (body.Description.Mass / other.Description.Mass) * normal;
            }
        }
    }

    /// <summary>What a body presses on other bodies with, they get at their own turn.</summary>
    private void TransmitLoad(Body body, Vector acceleration, Vector position, double time)
    {
        for (var i = 0; i < body.Contacts.Count; i++)
        {
            var contact = body.Contacts[i];
            if (contact.BodyIndex < 0 || bodies[contact.BodyIndex] is { IsAsleep: true })
            {
                continue;
            }

            var (other, normal) = (bodies[contact.BodyIndex], contact.Normal(position));
            var loadAcceleration = -Vector.Dot(acceleration - other.NetAcceleration, normal);
            if (loadAcceleration > 0)
            {
                other.PendingLoadVelocity -= time * loadAcceleration * (body.Description.Mass / other.Description.Mass) * normal;
            }
        }
    }

    /// <summary>Makes the velocity lead into nothing that is touched: by bouncing where the approach is fast enough.</summary>
    private void ResolveContacts(Body body, Vector position, double restitutionThreshold)
    {
        var contacts = body.Contacts;
        for (var iteration = 0; iteration < MaxSimultaneousImpacts; iteration++)
        {
            var (fastestIndex, fastestSpeed) = (-1, 0.0);
            for (var i = 0; i < contacts.Count; i++)
            {
                var velocity = RelativeVelocity(body, contacts[i]);
                var speed = Vector.Dot(velocity, contacts[i].Normal(position));
                if (speed < fastestSpeed && speed < -RelativeTolerance * velocity.MaxAbsComponent()
                    && (contacts[i].BodyIndex >= 0 || -speed > restitutionThreshold))
                {
                    (fastestIndex, fastestSpeed) = (i, speed);
                }
            }

            if (fastestIndex < 0)
            {
                break;
            }

            Bounce(body, contacts[fastestIndex], contacts[fastestIndex].Normal(position), -fastestSpeed, restitutionThreshold);
        }

        // Slow approaches to surfaces, all at once.
        body.Velocity = contacts.ProjectVelocity(body.Velocity, position, _planes, onlySurfaces: true);
    }

    private Vector RelativeVelocity(Body body, in Contact contact) =>
        contact.BodyIndex < 0 ? body.Velocity : body.Velocity - bodies[contact.BodyIndex].Velocity;

    private void Bounce(Body body, in Contact contact, Vector normal, double approachSpeed, double restitutionThreshold)
    {
        var other = contact.BodyIndex < 0 ? null : bodies[contact.BodyIndex];
        if (other is { IsAsleep: true } && approachSpeed > restitutionThreshold)
        {
            wakeIsland(other);
        }

        // What sleeps on is as firm as the ground.
        var movable = other is { IsAsleep: false, IsStuck: false } ? other : null;
        var massShare = movable is null ? 1 : movable.Description.Mass / (body.Description.Mass + movable.Description.Mass);
        var restitution = approachSpeed <= restitutionThreshold ? 0 : other is null
            ? body.Description.Restitution
            : Math.Min(body.Description.Restitution, other.Description.Restitution);
        var velocityChange = (1 + restitution) * approachSpeed * normal;
        var relativeVelocity = RelativeVelocity(body, in contact);
        var tangentialVelocity = relativeVelocity - (Vector.Dot(relativeVelocity, normal) * normal);
        var tangentialSpeed = tangentialVelocity.Length();
        var maxFrictionSpeed = body.Description.Friction * (1 + restitution) * approachSpeed;
        if (maxFrictionSpeed > 0 && tangentialSpeed > 0)
        {
            velocityChange -= Math.Min(maxFrictionSpeed / tangentialSpeed, 1) * tangentialVelocity;
        }

        body.Velocity += massShare * velocityChange;
        if (movable is not null)
        {
            movable.Velocity -= (1 - massShare) * velocityChange;
        }
    }

    /// <summary>Takes back by how much a place overlaps through rounding.</summary>
    private Vector RemoveRoundingOverlap(Vector position, in Contact contact)
    {
        var gap = contact.Gap(position);
        return gap < 0 && -gap <= 10 * obstacles.TouchTolerance(position) ? position - (gap * contact.Normal(position)) : position;
    }
}
