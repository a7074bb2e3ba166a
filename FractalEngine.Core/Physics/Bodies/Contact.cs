using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>An obstacle that the centre of a sphere must keep a distance from.</summary>
/// <param name="FixedPoint">
/// The closest point of a surface, or the centre of another sphere; world space, or that of the reference placement of
/// <see cref="Kinematic"/>.
/// </param>
/// <param name="CombinedRadius">The distance to keep: the sphere's radius, or the sum of both radii.</param>
/// <param name="SphereOffset">Offset of the touching sphere's centre from the mover's position.</param>
/// <param name="BodyIndex">Index of the other body; <see cref="NoBody"/> for a surface or the character.</param>
/// <param name="IsFlat">True inside a face, where the surface near the point is a plane.</param>
internal readonly record struct Contact(Vector FixedPoint, double CombinedRadius, Vector SphereOffset, int BodyIndex, bool IsFlat)
{
    /// <summary>The index that means no body.</summary>
    public const int NoBody = -1;

    /// <summary>The kinematic object whose surface it is; null for everything else.</summary>
    public KinematicObject? Kinematic { get; init; }

    /// <summary>Index of the other body's ball; 0 for what is no body.</summary>
    public byte BodyBall { get; init; }

    /// <summary>The closest point of a surface, or the centre of another sphere, where it is now; world space.</summary>
    public Vector Point => Kinematic is null ? FixedPoint : Kinematic.ToWorld(FixedPoint);

    /// <summary>True when the obstacle is another body, which moves and gives way.</summary>
    public bool IsBody => BodyIndex >= 0;

    /// <summary>Unit normal at the moment when the contact was added or updated.</summary>
    public Vector CachedNormal { get; init; }

    /// <summary>Vector from the contact point to the centre of the touching sphere.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    public Vector PointToCentre(Vector position) => position + SphereOffset - Point;

    /// <summary>Free distance between sphere and obstacle: 0 when they touch, negative when they overlap.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    public double Gap(Vector position) => PointToCentre(position).Length() - CombinedRadius;

    /// <summary>Velocity of the surface at the point; zero for what stands, and for bodies.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    public Vector SurfaceVelocity(Vector position) =>
        Kinematic is null ? Vector.Zero : Kinematic.SurfaceVelocityAt(Point, Normal(position));

    /// <summary>Velocity of the touched ball's centre.</summary>
    /// <param name="other">The other body.</param>
    public Vector VelocityOf(Body other) => other.VelocityAt(other.BallOffset(BodyBall));

    /// <summary>Unit vector away from the obstacle; zero where the centre is on it.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    public Vector Normal(Vector position) => PointToCentre(position).UnitVectorOrZero();
}
