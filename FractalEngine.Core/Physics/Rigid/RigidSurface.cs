using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>A body or an object in a part of a step: its surface, where it is and how it moves.</summary>
internal sealed class RigidSurface
{
    // Relative to the radius, and to the way: how much farther than without contacts a body may get in the rest of a step.
    private const double ReachRadii = 0.1;
    private const double ReachFraction = 0.5;

    private BoundingBox _centres;

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
    }

    /// <summary>The body; null for an object.</summary>
    public Body? Body { get; }

    /// <summary>The object; null for a body.</summary>
    public StaticObject? Target { get; }

    /// <summary>The tree of its surface.</summary>
    public RigidShape Shape { get; set; }

    /// <summary>Where it is and how it moves in the present substep, which takes a unit of time.</summary>
    public SurfaceMotion Motion { get; set; }

    /// <summary>How an object moves in the rest of the step, which takes a unit of time.</summary>
    public SurfaceMotion PartMotion { get; set; }

    /// <summary>A box that holds it during the part, world space.</summary>
    public BoundingBox SweptBounds { get; set; }

    /// <summary>The part of its motion that it makes, from 0 to 1.</summary>
    public double Fraction { get; set; } = 1;

    /// <summary>True for a body that is awake.</summary>
    public bool IsAwake => Body is { IsAsleep: false };

    /// <summary>Radius of a ball about the reference point that holds it; only for bodies.</summary>
    public double Radius => Body!.Radius;

    /// <summary>The motion from a time on, at which it may have stopped.</summary>
    /// <param name="time">No later than it stops.</param>
    public SurfaceMotion MotionAfter(double time) => Fraction == time ? Motion.From(time).Stopped : Motion.From(time);

    /// <summary>Sets where a body may get to in the rest of the step: what it may meet is looked for there.</summary>
    /// <param name="travel">How far its centre goes without contacts.</param>
    /// <param name="turn">Rotation vector of its turn.</param>
    public void SetReach(Vector travel, Vector turn)
    {
        Motion = CreateMotion(travel, turn);
        Fraction = 1;
        var slack = ((ReachRadii * Radius) + (ReachFraction * travel.Length())) * Vector.One;
        _centres = new(
            Vector.Min(Body!.Position, Body.Position + travel) - slack, Vector.Max(Body.Position, Body.Position + travel) + slack);
        SweptBounds = new(_centres.Minimum - (Radius * Vector.One), _centres.Maximum + (Radius * Vector.One));
    }

    /// <summary>Sets the motion of a body in a substep. It stops where it would leave the box of <see cref="SetReach"/>.</summary>
    /// <param name="travel">How far its centre goes.</param>
    /// <param name="turn">Rotation vector of its turn.</param>
    public void SetMotion(Vector travel, Vector turn)
    {
        Motion = CreateMotion(travel, turn).AsScrew(Radius);
        // A screw leads farther out than its ends.
        var detour = 1 + Motion.Angle;
        Fraction = Math.Min(
            FractionWithin(Body!.Position.X, detour * travel.X, _centres.Minimum.X, _centres.Maximum.X),
            Math.Min(
                FractionWithin(Body.Position.Y, detour * travel.Y, _centres.Minimum.Y, _centres.Maximum.Y),
                FractionWithin(Body.Position.Z, detour * travel.Z, _centres.Minimum.Z, _centres.Maximum.Z)));
    }

    private static double FractionWithin(double position, double travel, double minimum, double maximum) =>
        position + travel > maximum ? Math.Max(0, (maximum - position) / travel)
        : position + travel < minimum ? Math.Max(0, (minimum - position) / travel)
        : 1;

    private SurfaceMotion CreateMotion(Vector travel, Vector turn)
    {
        // A ball looks the same whichever way it has turned.
        var isBall = Body!.Description is { Shape: null, Mesh: null };
        return new(
            Body.Position, isBall ? Descriptions.Orientation.Identity : Body.Orientation, isBall ? Body.Radius : Body.Scale, travel,
            isBall ? Vector.Zero : turn);
    }
}
