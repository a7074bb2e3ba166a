using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>A body, or an object that no force moves, as the solver of a step sees it.</summary>
internal struct RigidState
{
    /// <summary>Velocity of the reference point, units per second.</summary>
    public Vector Velocity;

    /// <summary>Angular velocity, radians per second.</summary>
    public Vector Spin;

    /// <summary>Acceleration by gravity and forces.</summary>
    public Vector Acceleration;

    /// <summary>Torque that callers exert.</summary>
    public Vector Torque;

    /// <summary>How far the reference point has gone since the beginning of the part.</summary>
    public Vector Travel;

    /// <summary>How the body has turned since the beginning of the part.</summary>
    public Orientation Turn;

    /// <summary>How far the reference point had gone before the present substep.</summary>
    public Vector TravelBefore;

    /// <summary>How the body had turned before the present substep.</summary>
    public Orientation TurnBefore;

    /// <summary>How far the reference point had gone before it was moved apart from others.</summary>
    public Vector TravelMoved;

    /// <summary>How the body had turned before it was moved apart from others.</summary>
    public Orientation TurnMoved;

    /// <summary>Orientation at the beginning of the part.</summary>
    public Orientation Orientation;

    /// <summary>One over the mass; 0 for what no force moves.</summary>
    public double InverseMass;

    /// <summary>Inverse inertia tensor about the world's axes; zero for what does not turn.</summary>
    public Matrix InverseInertia;

    /// <summary>Inertia tensor in the axes of the body.</summary>
    public Matrix LocalInertia;

    /// <summary>Inverse inertia tensor in the axes of the body; zero for what does not turn.</summary>
    public Matrix LocalInverseInertia;

    /// <summary>Rate of damping, per second.</summary>
    public double Damping;

    /// <summary>The contact with what moves by itself that is left most slowly, relative to the reference point; zero for none.</summary>
    public Vector Pivot;

    /// <summary>How fast it is left, units per second.</summary>
    public double PivotSpeed;

    /// <summary>True for a body with contacts, which goes with the others in small steps.</summary>
    public bool HasContacts;

    /// <summary>True for a body that was stopped at once in the last substep: in this one it is only moved apart from others.</summary>
    public bool IsHeld;

    /// <summary>Work of gravity and forces in the present substep, joules; infinite for what something carries.</summary>
    public double Work;

    /// <summary>True for a body that forces move.</summary>
    public readonly bool IsDynamic => InverseMass > 0;

    /// <summary>Energy of motion of a body that forces move, joules.</summary>
    public readonly double KineticEnergy
    {
        get
        {
            var spin = Turn.After(Orientation).RotateBack(Spin);
            return 0.5 * ((Velocity.LengthSquared() / InverseMass) + Vector.Dot(spin, LocalInertia * spin));
        }
    }

    /// <summary>Computes the velocity of a point of the body.</summary>
    /// <param name="arm">The point relative to the reference point.</param>
    public readonly Vector VelocityAt(Vector arm) => Velocity + Vector.Cross(Spin, arm);

    /// <summary>How far a point has gone since the beginning of the part.</summary>
    /// <param name="arm">The point relative to the reference point then.</param>
    public readonly Vector TravelOf(Vector arm) => Travel + Turn.Rotate(arm) - arm;

    /// <summary>Changes the velocities by an impulse at a point.</summary>
    public void ApplyImpulse(Vector arm, Vector impulse)
    {
        Velocity += InverseMass * impulse;
        Spin += InverseInertia * Vector.Cross(arm, impulse);
    }

    /// <summary>Begins a substep where the last one has ended.</summary>
    public void BeginSubstep()
    {
        TravelBefore = Travel;
        TurnBefore = Turn;
        Pivot = Vector.Zero;
        PivotSpeed = double.PositiveInfinity;
    }

    /// <summary>Makes a contact with what moves by itself the pivot, if it is left more slowly than the present one.</summary>
    public void SetPivot(Vector arm, double speed)
    {
        if (speed < PivotSpeed)
        {
            Pivot = arm;
            PivotSpeed = speed;
        }
    }

    /// <summary>Takes back a part of what it has moved in the substep, by no force.</summary>
    /// <param name="kept">The part that stays, from 0 to 1.</param>
    public void Shorten(double kept)
    {
        if (kept < 1)
        {
            Travel = TravelBefore + (kept * (Travel - TravelBefore));
            Turn = TurnBefore.TurnedBy(kept * Turn.After(TurnBefore.Inverse()).RotationVector);
        }
    }

    /// <summary>Slows the body down where it has more energy of motion than it can have.</summary>
    /// <param name="maxEnergy">Joules; what is negative counts as 0.</param>
    public void LimitEnergy(double maxEnergy)
    {
        var energy = KineticEnergy;
        if (energy > Math.Max(0, maxEnergy))
        {
            var scale = Math.Sqrt(Math.Max(0, maxEnergy) / energy);
            Velocity *= scale;
            Spin *= scale;
        }
    }

    /// <summary>Moves and turns the body as an impulse at a point would in a unit of time, if it stood.</summary>
    public void Displace(Vector arm, Vector impulse)
    {
        if (IsDynamic)
        {
            Travel += InverseMass * impulse;
            Turn = Turn.TurnedBy(InverseInertia * Vector.Cross(arm, impulse));
        }
    }

    /// <summary>What an impulse at a point changes of the velocity there, along its direction.</summary>
    public readonly double Mobility(Vector arm, Vector direction)
    {
        var angular = Vector.Cross(arm, direction);
        return InverseMass + Vector.Dot(angular, InverseInertia * angular);
    }

    /// <summary>Turns the body without time: its spin turns with it, so that the energy of rotation stays.</summary>
    /// <param name="turn">How it is turned since the beginning of the step then.</param>
    /// <param name="before">How it was turned when its spin was as it is now.</param>
    public void TurnTo(in Orientation turn, in Orientation before)
    {
        // In this order: either of the two may be the turn of this state itself.
        Spin = turn.After(before.Inverse()).Rotate(Spin);
        Turn = turn;
        UpdateInertia();
    }

    /// <summary>
    /// Moves on by the present velocities. The angular momentum stays as it is, unless energy of rotation would be gained by that.
    /// </summary>
    public void Move(double seconds)
    {
        Travel += seconds * Velocity;
        if (Spin == Vector.Zero)
        {
            return;
        }

        var orientation = Turn.After(Orientation);
        var momentum = orientation.Rotate(LocalInertia * orientation.RotateBack(Spin));
        Turn = Turn.TurnedBy(seconds * Spin);
        if (IsDynamic && LocalInverseInertia != default)
        {
            var energy = Vector.Dot(Spin, momentum);
            UpdateInertia();
            Spin = InverseInertia * momentum;
            var energyNow = Vector.Dot(Spin, momentum);
            Spin *= energyNow > energy ? Math.Sqrt(energy / energyNow) : 1;
        }
    }

    /// <summary>Computes the inverse inertia tensor about the world's axes.</summary>
    public void UpdateInertia()
    {
        var rotation = Turn.After(Orientation).ToMatrix();
        InverseInertia = rotation * LocalInverseInertia * rotation.Transpose();
    }
}
