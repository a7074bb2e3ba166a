using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Physics.Solving;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>
/// Finds how friction at its contacts slows, turns and holds a body that touches no island. A body slides until its touching point stands
/// still, and rolls from then on.
/// </summary>
internal sealed class SpinFriction(List<Body> bodies)
{
    // Relative to the acceleration: less is rounding, and the body rests.
    private const double RestFraction = 1e-12;

    // Relative to the duration: a shorter time makes no progress.
    private const double MinFraction = 1e-9;

    // What turns makes a body slip anew all the time.
    private const double MinFractionOnTurning = 1e-3;

    // Seconds: in a shorter time friction does nothing that rounding does not.
    private const double MinDuration = 1e-12;

    private readonly ContactSolver _solver = new(bodyCount: 1);
    private readonly ContactRow[] _rows = new ContactRow[HalfSpaces.Capacity];

    /// <summary>Finds the accelerations, constant for a time.</summary>
    /// <param name="body">Touches something, and leads into none of it.</param>
    /// <param name="netAcceleration">What the contacts leave of it without friction; receives what they leave with it.</param>
    /// <param name="duration">Seconds; receives the time until the body begins to roll, if that is sooner.</param>
    /// <param name="spinAcceleration">Receives the angular acceleration, radians per second².</param>
    public void Apply(Body body, ref Vector netAcceleration, ref double duration, out Vector spinAcceleration)
    {
        spinAcceleration = Vector.Zero;
        if (duration < MinDuration)
        {
            return;
        }

        _solver.Load(0, body);
        ref var solverBody = ref _solver.Bodies[0];
        var rows = _rows.AsSpan(0, body.Contacts.Count);
        for (var i = 0; i < rows.Length; i++)
        {
            rows[i] = CreateRow(body, in body.Contacts[i]);
            _solver.ComputeMasses(ref rows[i]);
        }

        if (rows.Length == 1)
        {
            LimitToSlide(body, in rows[0], netAcceleration, ref duration);
        }

        for (var i = 0; i < rows.Length; i++)
        {
            ref var row = ref rows[i];
            var minAcceleration = 0.0;
            if (body.Contacts[i].Kinematic is { } kinematic && kinematic.AngularVelocity != Vector.Zero)
            {
                // What turns has other velocities where the body will be.
                minAcceleration = kinematic.NormalAccelerationAt(body.Position, row.Normal, body.Velocity);
                var change = duration * Vector.Cross(kinematic.AngularVelocity, body.Velocity - kinematic.Velocity);
                row.SetSurface(row.SurfaceVelocity + change, kinematic.AngularVelocity);
            }

            // What is left of the acceleration along the normal, as without friction.
            minAcceleration = Math.Min(minAcceleration, Vector.Dot(netAcceleration, row.Normal));
            row.MinNormalVelocity = Vector.Dot(body.Velocity - row.SurfaceVelocity, row.Normal) + (duration * minAcceleration);
        }

        solverBody.Velocity += duration * body.FreeAcceleration;
        _ = _solver.Solve(rows);
        netAcceleration = (solverBody.Velocity - body.Velocity) / duration;
        spinAcceleration = (solverBody.Spin - body.AngularVelocity) / duration;
        var negligible = RestFraction * body.FreeAcceleration.Length();
        if (netAcceleration.MaxAbsComponent() <= negligible && spinAcceleration.MaxAbsComponent() * body.Radius <= negligible)
        {
            netAcceleration = Vector.Zero;
            spinAcceleration = Vector.Zero;
        }
    }

    private ContactRow CreateRow(Body body, in Contact contact)
    {
        var row = ContactRows.OfSurface(body, ball: 0, in contact);
        row.First = 0;
        if (contact.IsBody)
        {
            // One that moves would drive this body without being slowed down. Both are solved together in the next step.
            var other = bodies[contact.BodyIndex];
            row.Friction = other.IsAsleep ? Math.Min(row.Friction, other.Description.Friction) : 0;
        }

        return row;
    }

    /// <summary>Ends the time when friction has stopped the slip: |w + s·t| = f·t, as for a body that does not turn.</summary>
    private void LimitToSlide(Body body, in ContactRow row, Vector netAcceleration, ref double duration)
    {
        var slip = _solver.Slip(in row);
        _ = body.Contacts.CarryingVelocity(body.Position, out var surfaceAcceleration);
        var slipAcceleration = netAcceleration - (Vector.Dot(netAcceleration, row.Normal) * row.Normal) - surfaceAcceleration;
        var normalAcceleration = Math.Max(0, Vector.Dot(netAcceleration - body.FreeAcceleration, row.Normal));
        var deceleration = row.Friction * normalAcceleration * body.Description.Mass / row.FrictionMass;
        var excess = (deceleration * deceleration) - slipAcceleration.LengthSquared();
        var dot = Vector.Dot(slip, slipAcceleration);
        if (excess > 0 && slip != Vector.Zero)
        {
            var time = (dot + Math.Sqrt((dot * dot) + (excess * slip.LengthSquared()))) / excess;
            // A time that is lost in rounding makes no progress: the slip of so short a time is none.
            var minFraction = surfaceAcceleration == Vector.Zero ? MinFraction : MinFractionOnTurning;
            duration = time > minFraction * duration ? Math.Min(duration, time) : duration;
        }
    }
}
