using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Statics;

/// <summary>
/// A static object that moves by itself, or whose surface does: a lift, a turntable, a belt. Its collider stays at a reference placement,
/// and queries are taken there from where the object is at the time of the set.
/// </summary>
/// <remarks>During a step velocity and angular velocity are constant. At its end the object is exactly where its motion leads.</remarks>
internal sealed class KinematicObject
{
    private readonly KinematicSet _set;
    private ObjectMotion? _path;
    private BoundingBox _bounds;
    private double _radius;
    private RigidPose _origin;
    private double _originTime;
    private RigidPose _end;
    private RigidPose _now;
    private double _nowTime;

    /// <summary>Creates an object at its reference placement, with the motion that the scene declares.</summary>
    /// <param name="set">Has the time within the step.</param>
    /// <param name="target">The object in the world.</param>
    public KinematicObject(KinematicSet set, StaticObject target)
    {
        _set = set;
        Target = target;
        Reset(0);
    }

    /// <summary>The object of the world that moves by itself, or whose surface does.</summary>
    public StaticObject Target { get; }

    /// <summary>The object where its collider is.</summary>
    public PlacedModel Reference => Target.Reference;

    /// <summary>Where it is at the beginning of the step, or between steps.</summary>
    public RigidPose Pose { get; private set; }

    /// <summary>Where it was before the last step.</summary>
    public RigidPose PreviousPose { get; private set; }

    /// <summary>Velocity of its origin during the step, units per second.</summary>
    public Vector Velocity { get; private set; }

    /// <summary>Angular velocity, radians per second about the world's axes.</summary>
    public Vector AngularVelocity { get; private set; }

    /// <summary>Velocity of its surface besides its motion, in the axes of the reference placement.</summary>
    public Vector Belt { get; set; }

    /// <summary>Upper bound on the speed of its points, units per second.</summary>
    public double MaxSpeed { get; private set; }

    /// <summary>Box that holds it during the whole step, world space.</summary>
    public BoundingBox SweptBounds { get; private set; }

    /// <summary>True while the object itself moves.</summary>
    public bool IsMoving => Velocity != Vector.Zero || AngularVelocity != Vector.Zero;

    /// <summary>True while it carries what lies on it.</summary>
    public bool IsCarrying => IsMoving || Belt != Vector.Zero;

    private RigidPose Now
    {
        get
        {
            if (_nowTime != _set.Time)
            {
                _nowTime = _set.Time;
                _now = new(Pose.Position + (_nowTime * Velocity), Pose.Orientation.TurnedBy(_nowTime * AngularVelocity));
            }

            return _now;
        }
    }

    /// <summary>Returns to the beginning, and to the motion that the scene declares.</summary>
    /// <param name="time">The world's time, which may be later: then the object is where that motion has led.</param>
    public void Reset(double time)
    {
        var motion = Reference.Declaration.Motion ?? new();
        Belt = Reference.Declaration.Belt;
        Place(0);
        // The angles of placements turn the other way than angular velocities do.
        SetMotion(motion.Velocity, -Math.PI / 180 * motion.Spin, 0);
        _path = motion.From is null ? null : motion;
        _end = PoseAt(time);
        EndPart();
        PreviousPose = Pose;
    }

    /// <summary>Puts the object at the reference placement, at rest. Its surface moves on.</summary>
    /// <param name="time">The world's time.</param>
    public void Place(double time)
    {
        _bounds = Reference.Bounds;
        var origin = Reference.ObjectToWorld.Translation;
        var corner = Vector.Max((_bounds.Maximum - origin).Absolute(), (_bounds.Minimum - origin).Absolute());
        _radius = _bounds.IsEmpty ? 0 : corner.Length();
        Pose = new(origin, Orientation.Identity);
        PreviousPose = Pose;
        SetMotion(Vector.Zero, Vector.Zero, time);
    }

    /// <summary>Lets the object move straight on from where it is, and turn.</summary>
    /// <param name="velocity">Units per second.</param>
    /// <param name="angularVelocity">Radians per second.</param>
    /// <param name="time">The world's time.</param>
    public void SetMotion(Vector velocity, Vector angularVelocity, double time)
    {
        _origin = Pose;
        _originTime = time;
        _path = null;
        AngularVelocity = angularVelocity;
        Velocity = velocity;
        _nowTime = double.NaN;
    }

    /// <summary>Saves where the object is before a step.</summary>
    public void BeginStep() => PreviousPose = Pose;

    /// <summary>Finds how the object moves in a part of a step, from where it is.</summary>
    /// <param name="time">The world's time at the beginning of the part.</param>
    /// <param name="seconds">Length of the part.</param>
    public void PlanPart(double time, double seconds)
    {
        _end = PoseAt(time + seconds);
        Velocity = _path is null ? Velocity : (_end.Position - Pose.Position) / seconds;
        MaxSpeed = Velocity.Length() + (AngularVelocity.Length() * _radius);
        var bounds = BoundsAt(Pose);
        SweptBounds = IsMoving ? BoundingBox.Union(bounds, BoundsAt(_end)) : bounds;
        _nowTime = double.NaN;
    }

    /// <summary>Moves the object to where it is at the end of the part.</summary>
    public void EndPart()
    {
        Pose = _end;
        _nowTime = double.NaN;
    }

    /// <summary>Puts the object where a body is that it is the surface of.</summary>
    public void Follow(in RigidPose pose)
    {
        Pose = pose;
        Velocity = Vector.Zero;
        AngularVelocity = Vector.Zero;
        _end = pose;
        _nowTime = double.NaN;
    }

    /// <summary>Lets the object go evenly to where that body is at the end of a part of a step.</summary>
    /// <param name="end">Where it is then.</param>
    /// <param name="seconds">Length of the part.</param>
    public void Follow(in RigidPose end, double seconds)
    {
        Velocity = (end.Position - Pose.Position) / seconds;
        AngularVelocity = end.Orientation.After(Pose.Orientation.Inverse()).RotationVector / seconds;
        _end = end;
        _nowTime = double.NaN;
    }

    /// <summary>Finds the closest point of the object where it is now.</summary>
    /// <param name="collider">Its collider at the reference placement.</param>
    /// <param name="point">World space.</param>
    /// <param name="maxDistance">Largest distance of interest; none is found where it is negative.</param>
    /// <param name="context">Lends its memory, and counts.</param>
    /// <param name="closest">The closest point, if there is one.</param>
    public bool TryFindClosest(
        ColliderInstance collider, Vector point, double maxDistance, QueryContext context, out ClosestPoint closest)
    {
        var local = ToReference(point);
        closest = default;
        if (!(maxDistance >= 0) || !IsNear(local, maxDistance)
            || !collider.TryFindClosest(local, maxDistance, context, out closest, epsilon: 0))
        {
            return false;
        }

        closest = ToWorld(in closest);
        return true;
    }

    /// <summary>Upper bound on the speed of its points as what moves along with a velocity sees them.</summary>
    public double MaxSpeedBeside(Vector velocity) => (Velocity - velocity).Length() + (AngularVelocity.Length() * _radius);

    /// <summary>Where a point of the reference placement is now.</summary>
    public Vector ToWorld(Vector reference)
    {
        var now = Now;
        var origin = Reference.ObjectToWorld.Translation;
        return now.Orientation == Orientation.Identity
            ? reference + (now.Position - origin) : now.Position + now.Orientation.Rotate(reference - origin);
    }

    /// <summary>Where a closest point of the reference placement is now.</summary>
    public ClosestPoint ToWorld(in ClosestPoint reference) =>
        reference with { Point = ToWorld(reference.Point), Normal = Rotate(reference.Normal) };

    /// <summary>Where a point of the world is at the reference placement.</summary>
    public Vector ToReference(Vector world)
    {
        var now = Now;
        var origin = Reference.ObjectToWorld.Translation;
        return now.Orientation == Orientation.Identity
            ? world - (now.Position - origin) : origin + RotateBack(world - now.Position);
    }

    /// <summary>The present direction of a vector of the reference placement.</summary>
    public Vector Rotate(Vector reference) =>
        Now.Orientation == Orientation.Identity ? reference : Now.Orientation.Rotate(reference);

    /// <summary>The direction at the reference placement of a vector of the world.</summary>
    public Vector RotateBack(Vector world) =>
        Now.Orientation == Orientation.Identity ? world : Now.Orientation.RotateBack(world);

    /// <summary>True where a point of the reference placement is no farther from its box than a distance.</summary>
    public bool IsNear(Vector reference, double maxDistance) =>
        _bounds.DistanceSquared(reference) <= maxDistance * maxDistance || double.IsPositiveInfinity(maxDistance);

    /// <summary>Velocity of the object's material at a point of the world, now.</summary>
    public Vector VelocityAt(Vector point) => AngularVelocity == Vector.Zero
        ? Velocity : Velocity + Vector.Cross(AngularVelocity, point - Now.Position);

    /// <summary>Acceleration along the normal of a face that turns, as a point at a height above it follows it.</summary>
    /// <param name="point">World space.</param>
    /// <param name="normal">Unit normal of the face.</param>
    /// <param name="velocity">Velocity of the point.</param>
    public double NormalAccelerationAt(Vector point, Vector normal, Vector velocity)
    {
        var along = VelocityAt(point);
        return Vector.Dot(normal, Vector.Cross(AngularVelocity, (2 * (velocity - along)) + (along - Velocity)));
    }

    /// <summary>Velocity of the surface at a point of the world: that of the material, and of a belt along the surface.</summary>
    /// <param name="point">On the surface, world space.</param>
    /// <param name="normal">Unit normal there.</param>
    public Vector SurfaceVelocityAt(Vector point, Vector normal)
    {
        var velocity = VelocityAt(point);
        if (Belt == Vector.Zero)
        {
            return velocity;
        }

        var belt = Rotate(Belt);
        return velocity + belt - (Vector.Dot(belt, normal) * normal);
    }

    private RigidPose PoseAt(double time)
    {
        var elapsed = time - _originTime;
        return new(
            _path?.PositionAt(_origin.Position, elapsed) ?? _origin.Position + (elapsed * Velocity),
            _origin.Orientation.TurnedBy(elapsed * AngularVelocity));
    }

    private BoundingBox BoundsAt(in RigidPose pose)
    {
        if (_bounds.IsEmpty)
        {
            return _bounds;
        }

        if (AngularVelocity != Vector.Zero || pose.Orientation != Orientation.Identity)
        {
            // Whatever it turns to.
            return new(pose.Position - (_radius * Vector.One), pose.Position + (_radius * Vector.One));
        }

        var shift = pose.Position - Reference.ObjectToWorld.Translation;
        return new(_bounds.Minimum + shift, _bounds.Maximum + shift);
    }
}
