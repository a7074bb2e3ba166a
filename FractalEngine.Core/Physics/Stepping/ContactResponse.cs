using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Physics.Solving;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>
/// How contacts change the velocity of a body: the paper's response v ← −e·vₙ + vₛ (§4.4.4), and friction.
/// </summary>
internal sealed class ContactResponse(List<Body> bodies, SleepIslands islands, IslandPlanner planner, ContactLog contactLog)
{
    // Bounces at the same moment, one after the other: more of them are a corner that leaves no path.
    private const int MaxBounces = 16;

    // Relative to the speed: what rounding leaves along a normal.
    private const double RelativeTolerance = 1e-13;

    private readonly HalfSpaces _planes = new();
    private readonly ContactRow[] _rows = new ContactRow[1];

    /// <summary>Makes the velocity of a body lead into none of its contacts: by bouncing where the approach is fast enough.</summary>
    /// <param name="body">A ball, whose contacts must be up to date.</param>
    public void ResolveContacts(Body body)
    {
        var contacts = body.Contacts;
        for (var bounce = 0; bounce < MaxBounces; bounce++)
        {
            var fastestIndex = -1;
            var fastestSpeed = 0.0;
            for (var i = 0; i < contacts.Count; i++)
            {
                var velocity = RelativeVelocity(body, in contacts[i]);
                var speed = Vector.Dot(velocity, contacts[i].Normal(body.Position));
                if (speed < fastestSpeed && speed < -RelativeTolerance * velocity.MaxAbsComponent()
                    && (contacts[i].IsBody || -speed > body.RestitutionThreshold))
                {
                    fastestIndex = i;
                    fastestSpeed = speed;
                }
            }

            if (fastestIndex < 0)
            {
                break;
            }

            Bounce(body, in contacts[fastestIndex], -fastestSpeed);
        }

        // Slow approaches to surfaces, all at once.
        var velocityBefore = body.Velocity;
        body.Velocity = contacts.ProjectVelocity(body.Velocity, body.Position, _planes, onlySurfaces: true);
        if (body.Velocity != velocityBefore)
        {
            contactLog.AddSum(body, body.Position, body.Description.Mass * (body.Velocity - velocityBefore));
        }
    }

    /// <summary>
    /// Reduces an acceleration by friction. It acts against the velocity at the end of the time, so that it never turns a body round, and
    /// holds slow bodies.
    /// </summary>
    /// <param name="body">Touches something.</param>
    /// <param name="velocity">Velocity of the body relative to what it touches.</param>
    /// <param name="acceleration">By gravity and forces.</param>
    /// <param name="netAcceleration">What the contacts leave of it; receives what friction leaves of that.</param>
    /// <param name="duration">Seconds; receives the time until the body stops or turns, if that is sooner.</param>
    /// <returns>True when the body stops then.</returns>
    public static bool ApplyFriction(
        Body body, Vector velocity, Vector acceleration, ref Vector netAcceleration, ref double duration)
    {
        var frictionDeceleration = body.Description.Friction * (acceleration - netAcceleration).Length();
        var velocityDotAcceleration = Vector.Dot(velocity, netAcceleration);
        var speedSquared = velocity.LengthSquared();
        if (velocityDotAcceleration < 0)
        {
            // Beyond that time the friction would help it.
            duration = Math.Min(duration, -speedSquared / velocityDotAcceleration);
        }

        var velocityWithoutFriction = velocity + (duration * netAcceleration);
        var speedWithoutFriction = velocityWithoutFriction.Length();
        if (speedWithoutFriction > duration * frictionDeceleration)
        {
            netAcceleration -= frictionDeceleration / speedWithoutFriction * velocityWithoutFriction;
            return false;
        }

        // When friction has taken all that the acceleration has added to the velocity: |v + s·t| = f·t.
        var excess = (frictionDeceleration * frictionDeceleration) - netAcceleration.LengthSquared();
        var stopTime = excess > 0
            ? (velocityDotAcceleration + Math.Sqrt((velocityDotAcceleration * velocityDotAcceleration) + (excess * speedSquared))) / excess
            : velocityDotAcceleration < 0
                // Uphill, where the friction alone would not hold: the same root, without the division by the excess.
                ? speedSquared / (Math.Sqrt(Math.Max(0, (velocityDotAcceleration * velocityDotAcceleration) + (excess * speedSquared)))
                    - velocityDotAcceleration)
                : duration;
        duration = Math.Min(duration, stopTime);
        netAcceleration = duration > 0 ? -velocity / duration : Vector.Zero;
        return true;
    }

    private Vector RelativeVelocity(Body body, in Contact contact) =>
        body.Velocity - (contact.IsBody ? contact.VelocityOf(bodies[contact.BodyIndex]) : contact.SurfaceVelocity(body.Position));

    private void Bounce(Body body, in Contact contact, double approachSpeed)
    {
        var normal = contact.Normal(body.Position);
        var other = contact.IsBody ? bodies[contact.BodyIndex] : null;
        if (other is { IsAsleep: true } && approachSpeed > body.RestitutionThreshold)
        {
            islands.Wake(other);
        }

        // A body that sleeps on is as immovable as the ground.
        var movable = other is { IsAsleep: false, IsStuck: false } ? other : null;
        if (movable is { IsCompound: true })
        {
            ContactRow.Clear(ref _rows[0]);
            ContactRows.SetBalls(ref _rows[0], body, ball: 0, movable, contact.BodyBall, isImmovable: false, isAhead: false);
            planner.StopApproachesOf([body.Index, movable.Index], _rows);
            return;
        }

        var inverseMass = 1 / body.Description.Mass;
        var otherInverseMass = movable is null ? 0 : 1 / movable.Description.Mass;
        var description = other?.Description ?? body.Description;
        var restitution =
            approachSpeed > body.RestitutionThreshold ? Math.Min(body.Description.Restitution, description.Restitution) : 0;
        var impulse = (1 + restitution) * approachSpeed / (inverseMass + otherInverseMass) * normal;
        contactLog.Add(body, in contact, body.Position, impulse.Length());
        var friction = Math.Min(body.Description.Friction, description.Friction);
        if (friction > 0)
        {
            var across = StopSlip(body, other, movable, RelativeVelocity(body, in contact), normal, friction * impulse.Length());
            impulse += across;
            Turn(body, normal, across);
            if (movable is not null)
            {
                Turn(movable, normal, across);
            }
        }

        body.Velocity += inverseMass * impulse;
        if (movable is not null)
        {
            movable.Velocity -= otherInverseMass * impulse;
        }
    }

    /// <summary>Impulse across the normal that stops the slip of the touching points, as far as friction allows.</summary>
    private static Vector StopSlip(Body body, Body? other, Body? movable, Vector relative, Vector normal, double limit)
    {
        var spin = body.Radius * body.AngularVelocity;
        var inverseMass = InverseMassAcross(body);
        if (other is not null)
        {
            // A compound that does not give way does not turn.
            spin += other.Radius * other.AngularVelocity;
            inverseMass += movable is null ? 0 : InverseMassAcross(movable);
        }

        var slip = relative - (Vector.Dot(relative, normal) * normal) + Vector.Cross(normal, spin);
        return (-slip / inverseMass).ShortenedTo(limit);
    }

    /// <summary>Inverse of the mass that an impulse at the surface and along it moves.</summary>
    private static double InverseMassAcross(Body body) =>
        (1 / body.Description.Mass) + (body.InverseInertia * body.Radius * body.Radius);

    /// <summary>Turns a ball by an impulse at its touching point; both bodies of a contact turn alike.</summary>
    private static void Turn(Body body, Vector normal, Vector across) =>
        body.AngularVelocity -= body.InverseInertia * body.Radius * Vector.Cross(normal, across);
}
