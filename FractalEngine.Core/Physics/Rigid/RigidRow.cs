using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>A contact of two surfaces with what the solver of a step knows about it.</summary>
internal struct RigidRow
{
    /// <summary>Index of the state on the normal's side, which is a body.</summary>
    public int First;

    /// <summary>Index of the other state.</summary>
    public int Second;

    /// <summary>Unit vector from the second to the first.</summary>
    public Vector Normal;

    /// <summary>The contact relative to the first one's reference point, at the beginning.</summary>
    public Vector Arm1;

    /// <summary>The contact relative to the second one's reference point, at the beginning.</summary>
    public Vector Arm2;

    /// <summary>The contact relative to the first one's reference point, in the present substep.</summary>
    public Vector TurnedArm1;

    /// <summary>The contact relative to the second one's reference point, in the present substep.</summary>
    public Vector TurnedArm2;

    /// <summary>A unit vector along the face.</summary>
    public Vector Tangent1;

    /// <summary>The unit vector along the face at right angles to the first.</summary>
    public Vector Tangent2;

    /// <summary>The gap at the beginning less the one at which surfaces rest, scene units.</summary>
    public double Gap;

    /// <summary>The gap at which the surfaces rest, scene units.</summary>
    public double Distance;

    /// <summary>The least speed of approach that bounces.</summary>
    public double BounceSpeed;

    /// <summary>Coulomb's coefficient of friction.</summary>
    public double Friction;

    /// <summary>Fraction of the approach speed that a bounce keeps.</summary>
    public double Restitution;

    /// <summary>Largest torque against rolling, over the normal force.</summary>
    public double RollingArm;

    /// <summary>Largest torque about the normal, over the normal force.</summary>
    public double SpinningArm;

    /// <summary>Velocity of a belt along the second surface.</summary>
    public Vector Belt;

    /// <summary>Speed along the normal before the substep, negative on approach.</summary>
    public double SpeedBefore;

    /// <summary>One over the mobility along the normal.</summary>
    public double NormalMass;

    /// <summary>One over the mobility along the first tangent.</summary>
    public double TangentMass1;

    /// <summary>One over the mobility along the second tangent.</summary>
    public double TangentMass2;

    /// <summary>What has moved the two apart at the end of a part, as an impulse.</summary>
    public double Displacement;

    /// <summary>
    /// The gap in the present substep less the one at which surfaces rest, scene units; at the end of a part what it should be.
    /// </summary>
    public double CurrentGap;

    /// <summary>The impulse along the normal in the present substep.</summary>
    public double NormalImpulse;

    /// <summary>The sum of the impulses along the normal of all substeps.</summary>
    public double NormalImpulseSum;

    /// <summary>The impulse of friction in the present substep.</summary>
    public Vector FrictionImpulse;

    /// <summary>The angular impulse against rolling and spinning in the present substep.</summary>
    public Vector RollingImpulse;
}
