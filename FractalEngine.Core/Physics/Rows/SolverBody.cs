using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rows;

/// <summary>Velocities and inverse masses of a body, which is all that the solver needs of it.</summary>
internal struct SolverBody
{
    /// <summary>Velocity of the centre, units per second.</summary>
    public Vector Velocity;

    /// <summary>Angular velocity, radians per second.</summary>
    public Vector Spin;

    /// <summary>Inverse of the mass, 1/kg.</summary>
    public double InverseMass;

    /// <summary>True for a compound, whose inverse inertia is a tensor, and at most <see cref="InverseInertia"/> about any axis.</summary>
    public bool IsCompound;

    /// <summary>Inverse moment of inertia; 0 for a body that does not turn.</summary>
    public double InverseInertia;
}
