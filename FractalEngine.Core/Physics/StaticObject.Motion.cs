using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Kinematics;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <content>Objects that move by themselves: they push and carry bodies, and nothing stops them.</content>
public sealed partial class StaticObject
{
    private RigidPose _placedPose;

    /// <summary>Velocity in units per second, see <see cref="SetMotion"/>; on a path the mean of the last step.</summary>
    public Vector Velocity => Kinematic?.Velocity ?? Vector.Zero;

    /// <summary>Angular velocity in radians per second about the world's axes, see <see cref="SetMotion"/>.</summary>
    public Vector AngularVelocity => Kinematic?.AngularVelocity ?? Vector.Zero;

    /// <summary>Velocity of the surface along itself, see <see cref="SetBelt"/>.</summary>
    public Vector Belt => Kinematic?.Belt ?? Vector.Zero;

    /// <summary>Lets the object move straight on from where it is, and turn about its position, whatever is in its way.</summary>
    /// <param name="velocity">Units per second.</param>
    /// <param name="angularVelocity">Radians per second about the world's axes.</param>
    /// <exception cref="ArgumentException">A coordinate is not finite.</exception>
    /// <remarks>
    /// It replaces the motion that the scene declares, until <c>PhysicsWorld.Reset</c>. Bodies that the object meets are pushed, and
    /// those that lie on it are carried along by friction. Wakes all bodies.
    /// </remarks>
    public void SetMotion(Vector velocity, Vector angularVelocity = default)
    {
        ArgumentCheck.RequireFinite(velocity, nameof(velocity));
        ArgumentCheck.RequireFinite(angularVelocity, nameof(angularVelocity));
        Kinematic ??= _set.AddKinematic(this);
        Kinematic.SetMotion(velocity, angularVelocity, _set.Time);
        _set.InvalidateSurroundings(mayOverlap: false);
    }

    /// <summary>Lets the object's surface move along itself, as that of a belt, and carry what lies on it by friction.</summary>
    /// <param name="velocity">
    /// Units per second along the axes of the world, which turn with the object. On each face the part along the face counts.
    /// </param>
    /// <exception cref="ArgumentException">A coordinate is not finite.</exception>
    /// <remarks>Wakes all bodies.</remarks>
    public void SetBelt(Vector velocity)
    {
        ArgumentCheck.RequireFinite(velocity, nameof(velocity));
        Kinematic ??= _set.AddKinematic(this);
        Kinematic.Belt = velocity;
        _set.InvalidateSurroundings(mayOverlap: false);
    }

    /// <summary>Map that draws the object between its last two states, as <c>Body.InterpolatedMap</c> does for bodies.</summary>
    /// <param name="alpha">Fraction of the last step that has passed, from 0 to 1.</param>
    public AffineMap InterpolatedMap(double alpha)
    {
        if (Kinematic is not { } kinematic)
        {
            return ObjectToWorld;
        }

        var orientation = Orientation.Interpolate(kinematic.PreviousPose.Orientation, kinematic.Pose.Orientation, alpha);
        var from = kinematic.PreviousPose.Position;
        return new(
            orientation == Orientation.Identity ? Reference.ObjectToWorld.Linear : orientation.ToMatrix() * Reference.ObjectToWorld.Linear,
            from + (alpha * (kinematic.Pose.Position - from)));
    }

    /// <summary>How the object moves; null until it moves for the first time.</summary>
    internal KinematicObject? Kinematic { get; set; }

    /// <summary>The object as a scene would hold it where it is drawn.</summary>
    /// <param name="alpha">Fraction of the last step that has passed, from 0 to 1.</param>
    internal PlacedModel PlaceAt(double alpha)
    {
        if (Kinematic is null)
        {
            return _placed;
        }

        var map = InterpolatedMap(alpha);
        var placement = Reference.Declaration.Placement with { Position = map.Translation };
        if (map.Linear != Reference.ObjectToWorld.Linear)
        {
            var orientation = Orientation.Interpolate(Kinematic.PreviousPose.Orientation, Kinematic.Pose.Orientation, alpha);
            var axes = orientation.ToMatrix() * placement.Rotation.LocalAxesFromDegrees();
            placement = placement with { Rotation = 180 / Math.PI * axes.EulerAngles() };
        }

        return new(Reference.Declaration with { Placement = placement }, Model);
    }

    private PlacedModel PlaceKinematic()
    {
        var pose = Kinematic!.Pose;
        if (pose != _placedPose)
        {
            _placedPose = pose;
            _placed = PlaceAt(1);
        }

        return _placed;
    }
}
