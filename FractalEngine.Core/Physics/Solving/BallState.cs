using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;

namespace FractalEngine.Core.Physics.Solving;

/// <summary>What the substeps of an island change of a ball; or a surface, which has infinite mass.</summary>
internal struct BallState
{
    /// <summary>Velocity of the centre, units per second.</summary>
    public Vector256<double> Velocity;

    /// <summary>Angular velocity, radians per second.</summary>
    public Vector256<double> Spin;

    /// <summary>From where the step began.</summary>
    public Vector256<double> Displacement;

    /// <summary>What gravity and forces add to the velocity in a substep.</summary>
    public Vector256<double> Gain;

    /// <summary>1/kg; 0 for what gives way to nothing.</summary>
    public double InverseMass;

    /// <summary>1/(kg·unit²); 0 for what does not turn, and for compounds: see <see cref="TurnedBody"/>.</summary>
    public double InverseInertia;

    /// <summary>Creates the state of a ball at the beginning of a step.</summary>
    /// <param name="body">The ball.</param>
    /// <param name="substep">Seconds.</param>
    public BallState(Body body, double substep)
    {
        Velocity = SimdAffineMap.ToVector256(body.Velocity);
        Spin = SimdAffineMap.ToVector256(body.AngularVelocity);
        Gain = SimdAffineMap.ToVector256(substep * body.FreeAcceleration);
        InverseMass = 1 / body.Description.Mass;
        InverseInertia = body.IsCompound ? 0 : body.InverseInertia;
    }

    /// <summary>Creates a surface that moves.</summary>
    public BallState(Vector velocity, Vector spin)
    {
        Velocity = SimdAffineMap.ToVector256(velocity);
        Spin = SimdAffineMap.ToVector256(spin);
    }
}
