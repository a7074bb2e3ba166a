using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// Where a rigid surface is, and how it moves on from there: a reference point on a straight line, and about that at a constant angular
/// velocity, both evenly until they stop.
/// </summary>
internal readonly struct SurfaceMotion
{
    // Relative to the radius: a body that turns about a farther axis goes straight on.
    private const double MaxAxisDistance = 100;

    /// <summary>Makes a motion on which a reference point goes straight on.</summary>
    /// <param name="position">The reference point at the beginning: the centre of mass of a body, the position of an object.</param>
    /// <param name="orientation">How the surface has turned about it.</param>
    /// <param name="scale">Factor by which it has shrunk.</param>
    /// <param name="travel">How far the reference point goes in a unit of time.</param>
    /// <param name="turn">Rotation vector of the turn in a unit of time, radians.</param>
    /// <param name="arm">The origin of the surface's frame relative to the reference point; zero where that goes straight itself.</param>
    public SurfaceMotion(Vector position, Orientation orientation, double scale, Vector travel, Vector turn, Vector arm = default)
    {
        Position = position;
        Arm = arm;
        Orientation = orientation;
        Scale = scale;
        Travel = travel;
        Turn = turn;
        Angle = turn.Length();
        Rotation = orientation.ToMatrix();
        Map = new(scale * Rotation, position + arm);
    }

    /// <summary>The reference point at the beginning, which goes straight on.</summary>
    public Vector Position { get; }

    /// <summary>The origin of the surface's frame relative to the reference point, at the beginning.</summary>
    public Vector Arm { get; }

    /// <summary>The origin of the surface's frame at the beginning.</summary>
    public Vector Origin => Position + Arm;

    /// <summary>The orientation at the beginning.</summary>
    public Orientation Orientation { get; }

    /// <summary>The size, relative to the frame of the surface.</summary>
    public double Scale { get; }

    /// <summary>How far the reference point goes in a unit of time.</summary>
    public Vector Travel { get; }

    /// <summary>Rotation vector of the turn in a unit of time, radians.</summary>
    public Vector Turn { get; }

    /// <summary>Radians that the surface turns in a unit of time.</summary>
    public double Angle { get; }

    /// <summary>True for what does not stay where it is.</summary>
    public bool IsMoving => Angle > 0 || Travel != Vector.Zero;

    /// <summary>The rotation at the beginning.</summary>
    public Matrix Rotation { get; }

    /// <summary>From the frame of the surface to the world, at the beginning.</summary>
    public AffineMap Map { get; }

    /// <summary>
    /// The motion between the same ends as a screw (Chasles): what turns about a point of contact does so all the way, and does not dip
    /// into what is there.
    /// </summary>
    /// <param name="radius">Radius of the surface about its origin, scene units.</param>
    public SurfaceMotion AsScrew(double radius)
    {
        if (!(Angle > 0))
        {
            return this;
        }

        var axis = Turn / Angle;
        var across = Travel - (Vector.Dot(axis, Travel) * axis);
        var toAxis = 0.5 * (across + (Vector.Cross(axis, across) / Math.Tan(0.5 * Angle)));
        return toAxis.Length() <= MaxAxisDistance * radius
            ? new(Position + toAxis, Orientation, Scale, Travel - across, Turn, -toAxis) : this;
    }

    /// <summary>The motion between the same ends on which another point goes straight on.</summary>
    /// <param name="pivot">The point relative to the reference point.</param>
    public SurfaceMotion About(Vector pivot) => new(
        Position + pivot, Orientation, Scale, Travel + Orientation.Identity.TurnedBy(Turn).Rotate(pivot) - pivot, Turn, Arm - pivot);

    /// <summary>The same motion from a later time on.</summary>
    /// <param name="time">In units of the motion.</param>
    public SurfaceMotion From(double time)
    {
        if (time == 0)
        {
            return this;
        }

        var turned = Orientation.Identity.TurnedBy(time * Turn);
        return new(Position + (time * Travel), turned.After(Orientation), Scale, Travel, Turn, turned.Rotate(Arm));
    }

    /// <summary>A part of the motion, which takes a unit of time itself.</summary>
    /// <param name="time">When it begins.</param>
    /// <param name="duration">How long it takes.</param>
    public SurfaceMotion Slice(double time, double duration)
    {
        var from = From(time);
        return new(from.Position, from.Orientation, Scale, duration * Travel, duration * Turn, from.Arm);
    }

    /// <summary>The same motion with coordinates relative to a point.</summary>
    public SurfaceMotion RelativeTo(Vector origin) => new(Position - origin, Orientation, Scale, Travel, Turn, Arm);

    /// <summary>The motion at the beginning as it is seen from another surface.</summary>
    public SurfaceMotion SeenFrom(in SurfaceMotion other) =>
        new(Position, Orientation, Scale, Travel - other.VelocityAt(Position), Turn - other.Turn, Arm);

    /// <summary>The motion of what stays where it is.</summary>
    public SurfaceMotion Stopped => new(Position, Orientation, Scale, Vector.Zero, Vector.Zero, Arm);

    /// <summary>Velocity of a point of the surface at the beginning, in units of the motion.</summary>
    public Vector VelocityAt(Vector point) => Angle == 0 ? Travel : Travel + Vector.Cross(Turn, point - Position);
}
