using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>
/// Takes a body through a step: free flight to the moment of an impact, the paper's response there (v ← −e·vₙ + vₛ, §4.4.4), and on with the rest of
/// the time. What it rests on takes its part of the acceleration away, so that nothing is pressed in and pushed out again.
/// </summary>
internal sealed class BodyMover(List<Body> bodies, Obstacles obstacles, Action<Body> wake)
{
    private const int MostImpacts = 1000;

    // Impacts at the same moment, one after the other: more are a corner that leaves no way.
    private const int MostAtOnce = 16;

    // Of a step: what is sooner is soon.
    private const double NoTime = 1e-3;

    // Of the speed: who leads more into a body that gives way waits until it has.
    private const double Recoil = 0.01;

    // Relative to the speed: what rounding leaves along a normal.
    private const double Rounding = 1e-13;

    // Of the rest speed: what leaves more slowly does not leave.
    private const double NoSpeed = 1e-4;

    private readonly HalfSpaces _planes = new();
    private readonly Sweep _sweep = new(obstacles);
    private readonly Placement _placement = new(obstacles, new());

    /// <summary>Moves a body. The obstacles must be set up for it.</summary>
    /// <param name="body">Awake.</param>
    /// <param name="acceleration">By gravity and forces.</param>
    /// <param name="time">Seconds.</param>
    /// <param name="restSpeed">Approaches that are slower do not bounce.</param>
    public void Move(Body body, Vector acceleration, double time, double restSpeed)
    {
        var (position, contacts) = (body.Position, body.Contacts);
        var hold = obstacles.Hold(position);
        if (!body.IsPlaced && !TryPlace(body, ref position))
        {
            return;
        }

        _sweep.Begin();
        contacts.Refresh(position, hold, body.Radius);
        obstacles.Collect(new(position, Vector.Zero, Vector.Zero), 0, body.Index);
        obstacles.AddTouchedBodies(position, hold, contacts);
        TakePressure(body, position);
        var (left, impactsHere, isBlocked, slow) = (time, 0, false, NoSpeed * restSpeed);
        for (var impact = 0; impact < MostImpacts && impactsHere < MostAtOnce && left > 0; impact++)
        {
            var velocity = body.Velocity;
            Respond(body, position, restSpeed);
            body.Velocity = contacts.RemoveSeparating(position, body.Velocity, bodies, slow, isBlocked);
            var isAnswered = (body.Velocity - velocity).MaximumComponent() > slow;
            var elapsed = Glide(body, acceleration, ref position, left, slow, isBlocked);
            (left, impactsHere) = (left - elapsed, elapsed > 0 ? 0 : impactsHere + 1);
            // What is run into gives way, but at its own turn: until then it is as firm as the ground, and one can only slide over it or wait.
            isBlocked |= !isAnswered && elapsed < NoTime * time && contacts.HasMoving(bodies);
        }

        // An impact in the last moment is answered in the next step.
        body.Position = position;
    }

    /// <summary>Goes on until something new is touched, friction has done its work, or the time is up.</summary>
    /// <param name="body">Leads into nothing that it touches.</param>
    /// <param name="acceleration">By gravity and forces.</param>
    /// <param name="position">Receives where it comes to.</param>
    /// <param name="time">Seconds.</param>
    /// <param name="slow">What is slower, and not accelerated, rests.</param>
    /// <param name="isBlocked">Nothing gives way.</param>
    /// <returns>The time that has passed.</returns>
    private double Glide(Body body, Vector acceleration, ref Vector position, double time, double slow, bool isBlocked)
    {
        var contacts = body.Contacts;
        var free = isBlocked ? contacts.Allow(body.Velocity, position, _planes) : body.Velocity;
        var kept = body.Velocity - free;
        if (kept.Length() > Recoil * free.Length())
        {
            // It would go another way than its own.
            return time;
        }

        body.Velocity = free;
        var steady = contacts.AllowAcceleration(acceleration, position, free, bodies, _planes, isBlocked, out var turnTime);
        var elapsed = Glide(body, steady, acceleration, ref position, Math.Min(time, turnTime), slow);
        body.Velocity += kept;
        return elapsed;
    }

    private double Glide(Body body, Vector steady, Vector acceleration, ref Vector position, double time, double slow)
    {
        var contacts = body.Contacts;
        var (duration, stands) = (time, false);
        if (body.Description.Friction > 0 && contacts.Count > 0)
        {
            stands = Rub(body, acceleration, ref steady, ref duration);
        }

        var isSlow = contacts.Count > 0 && body.Velocity.MaximumComponent() <= slow;
        body.Velocity = steady == Vector.Zero && isSlow ? Vector.Zero : body.Velocity;
        body.FreeAcceleration = steady;
        if (body.Velocity == Vector.Zero && steady == Vector.Zero)
        {
            Press(body, acceleration, position, time);
            return time;
        }

        var motion = new Motion(position, body.Velocity, steady);
        obstacles.Collect(in motion, duration, body.Index);
        var isHit = _sweep.TryHit(in motion, duration, out var hit, out var elapsed);
        Press(body, acceleration, position, elapsed);
        (position, body.Velocity) = (motion.At(elapsed), motion.VelocityAt(elapsed));
        if (isHit)
        {
            position = WithoutRounding(position, in hit);
            contacts.Add(in hit, position);
        }
        else if (stands)
        {
            body.Velocity = Vector.Zero;
        }

        contacts.Follow(position, obstacles.Hold(position), obstacles);
        // After too many advances the rest of the time is lost.
        return isHit || elapsed >= duration ? elapsed : double.PositiveInfinity;
    }

    /// <summary>A body that begins inside of something is pushed out; one that can't be stops.</summary>
    private bool TryPlace(Body body, ref Vector position)
    {
        body.Clearance.Forget();
        body.Contacts.Clear();
        body.IsStuck = !_placement.TryFree(ref position, body.Index);
        body.IsPlaced = !body.IsStuck;
        body.Position = position;
        if (body.IsStuck)
        {
            (body.Velocity, body.FreeAcceleration) = (Vector.Zero, Vector.Zero);
        }

        return body.IsPlaced;
    }

    /// <summary>
    /// What friction leaves of an acceleration. It acts against the velocity at the end of the time, so that it never turns a body round, and holds what is slow.
    /// </summary>
    /// <param name="body">Touches something.</param>
    /// <param name="acceleration">By gravity and forces.</param>
    /// <param name="steady">What the contacts leave of it; receives what friction leaves of that.</param>
    /// <param name="duration">How long it acts; receives the time until the body stands or turns, if that is sooner.</param>
    /// <returns>True when the body stands then.</returns>
    private static bool Rub(Body body, Vector acceleration, ref Vector steady, ref double duration)
    {
        var strength = body.Description.Friction * (acceleration - steady).Length();
        var (velocity, along) = (body.Velocity, Vector.Dot(body.Velocity, steady));
        var squared = velocity.LengthSquared();
        if (along < 0)
        {
            // From there on the friction would help it.
            duration = Math.Min(duration, -squared / along);
        }

        var free = velocity + (duration * steady);
        var speed = free.Length();
        if (speed > duration * strength)
        {
            steady -= strength / speed * free;
            return false;
        }

        // When all that acceleration has added to the velocity, friction has taken: |v + s·t| = f·t.
        var excess = (strength * strength) - steady.LengthSquared();
        var time = excess > 0 ? (along + Math.Sqrt((along * along) + (excess * squared))) / excess : duration;
        duration = Math.Min(duration, time);
        steady = duration > 0 ? -velocity / duration : Vector.Zero;
        return true;
    }

    /// <summary>What others press on a body with: it gives way where it can, and presses on what it lies on itself. Nothing bounces from a load.</summary>
    private void TakePressure(Body body, Vector position)
    {
        var (pressed, contacts) = (body.Pressed, body.Contacts);
        body.Pressed = Vector.Zero;
        if (pressed == Vector.Zero)
        {
            return;
        }

        body.Velocity += contacts.Allow(pressed, position, _planes);
        for (var i = 0; i < contacts.Count; i++)
        {
            var normal = contacts[i].Normal(position);
            if (contacts[i].Body >= 0 && bodies[contacts[i].Body] is { IsAsleep: false } other && Vector.Dot(pressed, normal) is < 0 and var passed)
            {
                other.Pressed += passed * (body.Description.Mass / other.Description.Mass) * normal;
            }
        }
    }

    /// <summary>What a body presses on other bodies with, they get at their own turn.</summary>
    private void Press(Body body, Vector acceleration, Vector position, double time)
    {
        for (var i = 0; i < body.Contacts.Count; i++)
        {
            var contact = body.Contacts[i];
            if (contact.Body < 0 || bodies[contact.Body] is { IsAsleep: true })
            {
                continue;
            }

            var (other, normal) = (bodies[contact.Body], contact.Normal(position));
            var pressing = -Vector.Dot(acceleration - other.FreeAcceleration, normal);
            if (pressing > 0)
            {
                other.Pressed -= time * pressing * (body.Description.Mass / other.Description.Mass) * normal;
            }
        }
    }

    /// <summary>Makes the velocity lead into nothing that is touched: by bouncing where the approach is fast enough.</summary>
    private void Respond(Body body, Vector position, double restSpeed)
    {
        var contacts = body.Contacts;
        for (var round = 0; round < MostAtOnce; round++)
        {
            var (worst, approach) = (-1, 0.0);
            for (var i = 0; i < contacts.Count; i++)
            {
                var velocity = RelativeVelocity(body, contacts[i]);
                var speed = Vector.Dot(velocity, contacts[i].Normal(position));
                if (speed < approach && speed < -Rounding * velocity.MaximumComponent() && (contacts[i].Body >= 0 || -speed > restSpeed))
                {
                    (worst, approach) = (i, speed);
                }
            }

            if (worst < 0)
            {
                break;
            }

            Bounce(body, contacts[worst], contacts[worst].Normal(position), -approach, restSpeed);
        }

        // Slow approaches to surfaces, all at once.
        body.Velocity = contacts.Allow(body.Velocity, position, _planes, onlySurfaces: true);
    }

    private Vector RelativeVelocity(Body body, in Contact contact) =>
        contact.Body < 0 ? body.Velocity : body.Velocity - bodies[contact.Body].Velocity;

    private void Bounce(Body body, in Contact contact, Vector normal, double approach, double restSpeed)
    {
        var other = contact.Body < 0 ? null : bodies[contact.Body];
        if (other is { IsAsleep: true } && approach > restSpeed)
        {
            wake(other);
        }

        // What sleeps on is as firm as the ground.
        var moves = other is { IsAsleep: false, IsStuck: false } ? other : null;
        var share = moves is null ? 1 : moves.Description.Mass / (body.Description.Mass + moves.Description.Mass);
        var restitution = approach <= restSpeed ? 0 : other is null ? body.Description.Restitution : Math.Min(body.Description.Restitution, other.Description.Restitution);
        var change = (1 + restitution) * approach * normal;
        var relative = RelativeVelocity(body, in contact);
        var sliding = relative - (Vector.Dot(relative, normal) * normal);
        var slidingSpeed = sliding.Length();
        var friction = body.Description.Friction * (1 + restitution) * approach;
        if (friction > 0 && slidingSpeed > 0)
        {
            change -= Math.Min(friction / slidingSpeed, 1) * sliding;
        }

        body.Velocity += share * change;
        if (moves is not null)
        {
            moves.Velocity -= (1 - share) * change;
        }
    }

    /// <summary>Takes back by how much a place overlaps through rounding.</summary>
    private Vector WithoutRounding(Vector position, in Contact contact)
    {
        var gap = contact.Gap(position);
        return gap < 0 && -gap <= 10 * obstacles.Touch(position) ? position - (gap * contact.Normal(position)) : position;
    }
}
