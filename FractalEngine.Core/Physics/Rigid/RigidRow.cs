using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>A contact of two surfaces with what the solver of a step knows about it.</summary>
internal struct RigidRow
{
    // Cosine of the angle between the normals of the same contact.
    private const double MinCosine = 0.95;

    // Relative to the radius of the smaller body: how far a contact may have moved.
    private const double MaxDistance = 0.03;

    /// <summary>Index of the state on the normal's side, which is a body.</summary>
    public int First;

    /// <summary>Index of the other state.</summary>
    public int Second;

    /// <summary>Unit vector from the second to the first.</summary>
    public Vector Normal;

    /// <summary>The contact relative to the first one's reference point, as that was turned at the beginning of the step.</summary>
    public Vector Arm1;

    /// <summary>The contact relative to the second one's reference point, as that was turned at the beginning of the step.</summary>
    public Vector Arm2;

    /// <summary>How much farther the second point had gone than the first one, from the step's beginning until it was found.</summary>
    public Vector Offset;

    /// <summary>The contact in the axes of the first body.</summary>
    public Vector LocalArm1;

    /// <summary>The contact relative to the first one's reference point, in the present substep.</summary>
    public Vector TurnedArm1;

    /// <summary>The contact relative to the second one's reference point, in the present substep.</summary>
    public Vector TurnedArm2;

    /// <summary>A unit vector along the face.</summary>
    public Vector Tangent1;

    /// <summary>The unit vector along the face at right angles to the first.</summary>
    public Vector Tangent2;

    /// <summary>The gap when the contact was found less the one at which surfaces rest, scene units.</summary>
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

    /// <summary>Gives the contact the impulses of the nearest one that there was.</summary>
    /// <param name="before">The contacts of the pair before this one was found.</param>
    /// <param name="radius">Radius of the smaller body.</param>
    public void WarmStart(ReadOnlySpan<RigidRow> before, double radius)
    {
        var nearest = MaxDistance * radius;
        foreach (ref readonly var row in before)
        {
            var distance = row.NormalImpulse > 0 ? (row.LocalArm1 - LocalArm1).Length() : double.PositiveInfinity;
            if (distance < nearest && Vector.Dot(row.Normal, Normal) > MinCosine)
            {
                nearest = distance;
                NormalImpulse = row.NormalImpulse;
                FrictionImpulse = row.FrictionImpulse - (Vector.Dot(row.FrictionImpulse, Normal) * Normal);
                RollingImpulse = row.RollingImpulse;
            }
        }
    }

    /// <summary>From the first one's point of the contact to the second one's, which were one when it was found.</summary>
    /// <param name="first">State of the first one.</param>
    /// <param name="second">State of the second one.</param>
    public readonly Vector Between(in RigidState first, in RigidState second) =>
        second.TravelOf(Arm2) - first.TravelOf(Arm1) - Offset;

    /// <summary>Ends a step: what is relative to its beginning becomes relative to that of the next one.</summary>
    /// <param name="first">State of the first one.</param>
    /// <param name="second">State of the second one.</param>
    public void EndStep(in RigidState first, in RigidState second)
    {
        Offset = -Between(in first, in second);
        Arm1 = first.Turn.Rotate(Arm1);
        Arm2 = second.Turn.Rotate(Arm2);
        NormalImpulseSum = 0;
    }
}
