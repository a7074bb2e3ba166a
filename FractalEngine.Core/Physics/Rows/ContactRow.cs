using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rows;

/// <summary>One contact of an island: who touches whom and where, and the impulse that the solver has found for it.</summary>
internal struct ContactRow
{
    /// <summary>In place of a second body: a surface, or a body that does not give way.</summary>
    public const int Immovable = -1;

    // Above the bits of both indices, unless there are millions of bodies: then contacts may be taken for others, and begin badly.
    private const int FeatureShift = 52;

    /// <summary>Index of the body on the normal's side.</summary>
    public int First;

    /// <summary>Index of the other body, or <see cref="Immovable"/>.</summary>
    public int Second;

    /// <summary>Which balls touch: the index of the first body's, plus that of the second's times their maximum number.</summary>
    public int FeatureId;

    /// <summary>True for two balls, whose line of contact turns as they move; false for the plane of a surface.</summary>
    public bool IsBall;

    /// <summary>True for what will bounce when it touches, and gives no impulse before.</summary>
    public bool IsBouncingAhead;

    /// <summary>True for what does not touch yet, and may meet in this step.</summary>
    public bool IsAhead;

    /// <summary>True where one of them is a ball of a compound: then what happens along the normal turns it too.</summary>
    public bool HasArms { get; private set; }

    private bool _hasSurface;

    /// <summary>Vector between the centres, or from the surface's point, at the beginning of the step.</summary>
    public Vector Offset;

    /// <summary>Length that the offset must keep.</summary>
    public double MinDistance;

    /// <summary>Unit vector from the second to the first.</summary>
    public Vector Normal;

    /// <summary>Impulse along the normal, not negative.</summary>
    public double NormalImpulse;

    /// <summary>Smallest allowed relative velocity along the normal, units per second.</summary>
    public double MinNormalVelocity;

    /// <summary>Mass that an impulse along the normal moves, kilograms.</summary>
    public double NormalMass;

    /// <summary>Impulse across the normal.</summary>
    public Vector FrictionImpulse;

    /// <summary>Mass that an impulse across the normal moves, kilograms.</summary>
    public double FrictionMass;

    /// <summary>Coulomb's coefficient of this pair.</summary>
    public double Friction;

    /// <summary>Radius of the first body.</summary>
    public double FirstRadius;

    /// <summary>Radius of the second body; 0 where it does not turn.</summary>
    public double SecondRadius;

    /// <summary>Torque against rolling over the normal force, scene units.</summary>
    public double RollingArm;

    /// <summary>Torque about the normal over the normal force, scene units.</summary>
    public double SpinningArm;

    /// <summary>Restitution of this pair.</summary>
    public double Restitution;

    /// <summary>Moment of inertia against an angular impulse of this contact; infinite where nothing turns.</summary>
    public double TurnInertia;

    // What few contacts have is last, and read only where they have it: so it is not even cleared for all others.
    private Vector _firstArm;
    private Vector _secondArm;
    private Vector _turnShift;
    private Vector _turnImpulse;
    private Vector _surfaceVelocity;
    private Vector _surfaceSpin;

    /// <summary>Centre of the first ball relative to the first body's position.</summary>
    public readonly Vector FirstArm => HasArms ? _firstArm : Vector.Zero;

    /// <summary>Centre of the second ball relative to the second body's position.</summary>
    public readonly Vector SecondArm => HasArms ? _secondArm : Vector.Zero;

    /// <summary>How far the planned turns of both bodies change the offset, beyond what their velocities tell.</summary>
    public Vector TurnShift
    {
        readonly get => HasArms ? _turnShift : Vector.Zero;
        set => _turnShift = value;
    }

    /// <summary>True where something slows down rolling or spinning.</summary>
    public readonly bool IsSlowedDown => RollingArm + SpinningArm > 0;

    /// <summary>Angular impulse against rolling and spinning.</summary>
    public Vector TurnImpulse
    {
        readonly get => IsSlowedDown ? _turnImpulse : Vector.Zero;
        set
        {
            if (IsSlowedDown)
            {
                _turnImpulse = value;
            }
        }
    }

    /// <summary>Velocity of a surface that moves, at the touching point.</summary>
    public readonly Vector SurfaceVelocity => _hasSurface ? _surfaceVelocity : Vector.Zero;

    /// <summary>Angular velocity of a surface that turns.</summary>
    public readonly Vector SurfaceSpin => _hasSurface ? _surfaceSpin : Vector.Zero;

    /// <summary>True for the contact with a surface that moves or turns.</summary>
    public readonly bool IsOnMovingSurface => Second < 0 && (SurfaceVelocity != Vector.Zero || SurfaceSpin != Vector.Zero);

    /// <summary>
    /// True for a contact that meets in this step and pushes, or of which one side moves by itself: that pushes on those that were slower
    /// than itself, which then rebound from what they push.
    /// </summary>
    public readonly bool MayRebound => NormalImpulse > 0 && (IsAhead || SurfaceVelocity != Vector.Zero);

    /// <summary>Begins a contact of two balls in a place that may have been another one's.</summary>
    public static void Clear(ref ContactRow row)
    {
        row.IsBall = false;
        row.IsBouncingAhead = false;
        row.IsAhead = false;
        row.HasArms = false;
        row._hasSurface = false;
        row.FeatureId = 0;
        row.NormalImpulse = 0;
        row.FrictionImpulse = Vector.Zero;
    }

    /// <summary>Sets the centres of the touching balls relative to the positions of their bodies, of which one is a compound.</summary>
    public void SetArms(Vector first, Vector second)
    {
        HasArms = true;
        _firstArm = first;
        _secondArm = second;
        _turnShift = Vector.Zero;
    }

    /// <summary>Sets how the surface moves.</summary>
    public void SetSurface(Vector velocity, Vector spin)
    {
        _hasSurface = true;
        _surfaceVelocity = velocity;
        _surfaceSpin = spin;
    }

    /// <summary>Says which contact it is, from step to step: both indices, and which of their balls.</summary>
    public readonly long Key => (((long)First << 32) | (uint)(Second + 1)) ^ ((long)FeatureId << FeatureShift);
}
