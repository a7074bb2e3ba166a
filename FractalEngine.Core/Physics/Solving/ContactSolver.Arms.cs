using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <content>Contacts of compounds, which an impulse turns wherever it points.</content>
internal sealed partial class ContactSolver
{
    private Matrix[] _inverseInertias = [];

    /// <summary>Sets the velocities and inverse masses of a body.</summary>
    public void Load(int index, Body body)
    {
        _bodies[index] = new()
        {
            Velocity = body.Velocity, Spin = body.AngularVelocity, InverseMass = 1 / body.Description.Mass,
            InverseInertia = body.InverseInertia, IsCompound = body.IsCompound,
        };
        if (body.IsCompound)
        {
            _inverseInertias[index] = body.InverseInertiaTensor;
        }
    }

    /// <summary>Change of a body's angular velocity by an angular impulse.</summary>
    private Vector SpinChange(int body, Vector turn) =>
        _bodies[body].IsCompound ? _inverseInertias[body] * turn : _bodies[body].InverseInertia * turn;

    private void ComputeMassesOfArms(ref ContactRow row)
    {
        var alongNormal = _bodies[row.First].InverseMass + InverseInertiaAlong(row.First, row.FirstArm, row.Normal);
        var inverseInertia = _bodies[row.First].InverseInertia;
        var tangent = Vector.Cross(row.Normal, Math.Abs(row.Normal.X) < 0.5 ? Vector.I : Vector.J).UnitVector();
        var bitangent = Vector.Cross(row.Normal, tangent);
        var across = AcrossMatrix(row.First, row.FirstArm - (row.FirstRadius * row.Normal), tangent, bitangent);
        if (row.Second >= 0)
        {
            alongNormal += _bodies[row.Second].InverseMass + InverseInertiaAlong(row.Second, row.SecondArm, row.Normal);
            inverseInertia += _bodies[row.Second].InverseInertia;
            across += AcrossMatrix(row.Second, row.SecondArm + (row.SecondRadius * row.Normal), tangent, bitangent);
        }

        row.NormalMass = 1 / alongNormal;
        row.TurnInertia = 1 / inverseInertia;
        // Friction is as heavy in one direction as in the other only for balls. The lighter one keeps each change from going too far.
        row.FrictionMass = 1 / ((0.5 * (across.X + across.Z)) + double.Hypot(0.5 * (across.X - across.Z), across.Y));
    }

    private double InverseInertiaAlong(int body, Vector arm, Vector direction)
    {
        var torque = Vector.Cross(arm, direction);
        return Vector.Dot(torque, SpinChange(body, torque));
    }

    /// <summary>
    /// The symmetric 2 × 2 matrix of inverse masses across the normal: both diagonal entries, and in between the other one.
    /// </summary>
    private Vector AcrossMatrix(int body, Vector arm, Vector tangent, Vector bitangent)
    {
        var first = Vector.Cross(arm, tangent);
        var second = Vector.Cross(arm, bitangent);
        var change = SpinChange(body, first);
        var inverseMass = _bodies[body].InverseMass;
        return new(
            inverseMass + Vector.Dot(first, change),
            Vector.Dot(second, change),
            inverseMass + Vector.Dot(second, SpinChange(body, second)));
    }

    /// <summary>Velocity of the first ball's centre relative to the second's.</summary>
    private Vector RelativeVelocityOfArms(in ContactRow row)
    {
        ref readonly var first = ref _bodies[row.First];
        var velocity = first.Velocity + Vector.Cross(first.Spin, row.FirstArm);
        if (row.Second >= 0)
        {
            ref readonly var second = ref _bodies[row.Second];
            return velocity - second.Velocity - Vector.Cross(second.Spin, row.SecondArm);
        }

        return velocity - row.SurfaceVelocity;
    }

    /// <summary>Gives both bodies an impulse where they touch.</summary>
    private void ApplyToArms(in ContactRow row, Vector impulse)
    {
        ref var first = ref _bodies[row.First];
        first.Velocity += first.InverseMass * impulse;
        first.Spin += SpinChange(row.First, Vector.Cross(row.FirstArm - (row.FirstRadius * row.Normal), impulse));
        if (row.Second >= 0)
        {
            ref var second = ref _bodies[row.Second];
            second.Velocity -= second.InverseMass * impulse;
            second.Spin -= SpinChange(row.Second, Vector.Cross(row.SecondArm + (row.SecondRadius * row.Normal), impulse));
        }
    }
}
