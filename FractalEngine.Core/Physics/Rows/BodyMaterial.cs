using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rows;

/// <summary>What of a body's description counts where it touches another one.</summary>
/// <param name="Friction">Coulomb's coefficient.</param>
/// <param name="Restitution">Coefficient of restitution, from 0 to 1.</param>
/// <param name="RollingFriction">Torque against rolling over the normal force, in radii.</param>
/// <param name="SpinningFriction">Torque about the normal over the normal force, in radii.</param>
internal readonly record struct BodyMaterial(double Friction, double Restitution, double RollingFriction, double SpinningFriction)
{
    /// <summary>Copies the coefficients of a description.</summary>
    public BodyMaterial(BodyDescription body)
        : this(body.Friction, body.Restitution, body.RollingFriction, body.SpinningFriction)
    {
    }
}
