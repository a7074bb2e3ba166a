using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>A body or an object in a part of a step: its surface, where it is and how it moves.</summary>
internal sealed class RigidSurface
{
    // Relative to the radius, and to the way: how much farther than without contacts a body may get in the rest of a step.
    private const double ReachRadii = 0.1;
    private const double ReachFraction = 0.5;

    // Radians: on a larger turn about a point of its surface a centre leaves its straight way by more than pairs are apart.
    private const double MaxPivotAngle = 0.4;

    private BoundingBox _centres;
    private (Vector Position, Orientation Orientation, double Scale, Vector Belt) _end;

    /// <summary>Makes the surface of a body.</summary>
    public RigidSurface(Body body, RigidShape shape)
    {
        Body = body;
        Shape = shape;
    }

    /// <summary>Makes the surface of an object.</summary>
    public RigidSurface(StaticObject target, RigidShape shape)
    {
        Target = target;
        Shape = shape;
        Linear = target.Reference.ObjectToWorld.Linear;
    }

    /// <summary>Makes the surface of a character: a capsule that nothing moves.</summary>
    public RigidSurface(CharacterController character)
    {
        Character = character;
        var offsets = character.Capsule.SphereOffsets;
        Shape = RigidShape.CreateCapsule(offsets[0], offsets[^1], character.Description.Radius);
    }

    /// <summary>The body; null for an object.</summary>
    public Body? Body { get; }

    /// <summary>The object; null for a body.</summary>
    public StaticObject? Target { get; }

    /// <summary>The character; null for bodies and objects.</summary>
    public CharacterController? Character { get; }

    /// <summary>The tree of its surface.</summary>
    public RigidShape Shape { get; }

    /// <summary>What moves by itself and carries it along, whatever else acts; null for none. Such an object carries itself.</summary>
    public RigidSurface? Carrier { get; set; }

    /// <summary>How often what moves by itself, or is carried by that, has met it in the part of the step.</summary>
    public int PushCount { get; set; }

    /// <summary>Where it is and how it moves in the present substep, which takes a unit of time.</summary>
    public SurfaceMotion Motion { get; set; }

    /// <summary>How an object moves in the rest of the step, which takes a unit of time.</summary>
    public SurfaceMotion PartMotion { get; set; }

    /// <summary>A box that holds it during the part, world space.</summary>
    public BoundingBox SweptBounds { get; set; }

    /// <summary>The part of its motion that it makes, from 0 to 1.</summary>
    public double Fraction { get; set; } = 1;

    /// <summary>True where a body has come to the end of the box in which what it may meet was looked for.</summary>
    public bool IsReachDue { get; set; }

    /// <summary>True where something else than the last step has moved it, or changed its size or its belt.</summary>
    public bool IsMovedByOthers { get; private set; } = true;

    /// <summary>True for a body that is awake.</summary>
    public bool IsAwake => Body is { IsAsleep: false };

    /// <summary>Radius of a ball about the reference point that holds it; only for bodies.</summary>
    public double Radius => Body!.Radius;

    /// <summary>The motion from a time on, at which it may have stopped.</summary>
    /// <param name="time">No later than it stops.</param>
    public SurfaceMotion MotionAfter(double time) => Fraction == time ? Motion.From(time).Stopped : Motion.From(time);

    /// <summary>The linear part of an object's placement when its tree was made.</summary>
    public Matrix Linear { get; }

    /// <summary>True for an object that has been turned or made larger since its tree was made.</summary>
    public bool IsShapeOld => Target is not null && Target.Reference.ObjectToWorld.Linear != Linear;

    /// <summary>Compares where it is at the beginning of a step with the end of the last one.</summary>
    public void BeginStep() => IsMovedByOthers = _end != Placement || Target?.Kinematic is { IsMoving: true };

    /// <summary>Keeps where it is at the end of a step.</summary>
    public void EndStep() => _end = Placement;

    /// <summary>How far the boxes of two surfaces are apart along an axis of the world; infinite where there is nothing.</summary>
    public double GapTo(RigidSurface other)
    {
        var gap = Vector.Max(other.SweptBounds.Minimum - SweptBounds.Maximum, SweptBounds.Minimum - other.SweptBounds.Maximum);
        return other.SweptBounds.IsEmpty ? double.PositiveInfinity : Math.Max(gap.X, Math.Max(gap.Y, gap.Z));
    }

    /// <summary>Sets how a body moves in the rest of the step without contacts.</summary>
    /// <param name="travel">How far its centre goes.</param>
    /// <param name="turn">Rotation vector of its turn.</param>
    /// <returns>True where that is farther than what it may meet has been looked for.</returns>
    public bool SetRest(Vector travel, Vector turn)
    {
        Motion = CreateMotion(travel, turn);
        Fraction = 1;
        var isReachNew = IsReachDue;
        if (isReachNew)
        {
            SetReach(travel);
        }

        return isReachNew;
    }

    /// <summary>Sets where a body may get to in the rest of the step: what it may meet is looked for there.</summary>
    private void SetReach(Vector travel)
    {
        IsReachDue = false;
        var slack = ((ReachRadii * Radius) + (ReachFraction * travel.Length())) * Vector.One;
        _centres = new(
            Vector.Min(Body!.Position, Body.Position + travel) - slack, Vector.Max(Body.Position, Body.Position + travel) + slack);
        SweptBounds = new(_centres.Minimum - (Radius * Vector.One), _centres.Maximum + (Radius * Vector.One));
    }

    /// <summary>Sets the motion of an object or character that stays where it is.</summary>
    public void Stand()
    {
        PartMotion = new(Placement.Position, Orientation.Identity, 1, Vector.Zero, Vector.Zero);
        Motion = PartMotion;
        var reach = 0.5 * (Character?.Description.Height ?? 0) * Vector.One;
        SweptBounds = Target?.Bounds ?? new(Placement.Position - reach, Placement.Position + reach);
    }

    /// <summary>Stops at a part of the motion.</summary>
    /// <returns>True where it went on until now.</returns>
    public bool Stop(double fraction)
    {
        if (!IsAwake || fraction >= Fraction)
        {
            return false;
        }

        Fraction = fraction;
        return true;
    }

    /// <summary>Sets the motion of a body in a substep. It stops where what it may meet has not been looked for.</summary>
    /// <param name="travel">How far its centre goes.</param>
    /// <param name="turn">Rotation vector of its turn.</param>
    /// <param name="pivot">Where what moves by itself touches it, relative to its centre; zero where nothing does.</param>
    public void SetMotion(Vector travel, Vector turn, Vector pivot)
    {
        var motion = CreateMotion(travel, turn);
        SetMotion(pivot != Vector.Zero && motion.Angle <= MaxPivotAngle ? motion.About(pivot) : motion.AsScrew(Radius), travel);
    }

    /// <summary>Sets the motion of a body that is carried.</summary>
    /// <param name="carrier">How what carries it moves in the substep.</param>
    public void SetCarriedMotion(in SurfaceMotion carrier)
    {
        var body = CreateMotion(Vector.Zero, Vector.Zero);
        var motion = new SurfaceMotion(
            carrier.Position, body.Orientation, body.Scale, carrier.Travel, carrier.Turn, body.Position - carrier.Position);
        SetMotion(in motion, motion.From(1).Origin - motion.Origin);
    }

    private void SetMotion(in SurfaceMotion motion, Vector travel)
    {
        Motion = motion;
        // A screw leads farther out than its ends.
        var detour = 1 + Motion.Angle;
        Fraction = Math.Min(
            FractionWithin(Body!.Position.X, detour * travel.X, _centres.Minimum.X, _centres.Maximum.X),
            Math.Min(
                FractionWithin(Body.Position.Y, detour * travel.Y, _centres.Minimum.Y, _centres.Maximum.Y),
                FractionWithin(Body.Position.Z, detour * travel.Z, _centres.Minimum.Z, _centres.Maximum.Z)));
        IsReachDue = Fraction < 1;
    }

    private (Vector Position, Orientation Orientation, double Scale, Vector Belt) Placement => Body is null
        ? (Target?.ObjectToWorld.Translation ?? Character!.Position, Orientation.Identity, 1, Target?.Belt ?? Vector.Zero)
        : (Body.Position, Body.Orientation, Body.Scale, Vector.Zero);

    private static double FractionWithin(double position, double travel, double minimum, double maximum) =>
        position + travel > maximum ? Math.Max(0, (maximum - position) / travel)
        : position + travel < minimum ? Math.Max(0, (minimum - position) / travel)
        : 1;

    private SurfaceMotion CreateMotion(Vector travel, Vector turn)
    {
        // A ball looks the same whichever way it has turned.
        var isBall = Body!.Description is { Shape: null, Mesh: null };
        return new(
            Body.Position, isBall ? Orientation.Identity : Body.Orientation, isBall ? Body.Radius : Body.Scale, travel,
            isBall ? Vector.Zero : turn);
    }
}
