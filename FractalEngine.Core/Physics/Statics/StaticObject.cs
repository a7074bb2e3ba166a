using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Statics;

/// <summary>
/// A mesh or fractal that bodies collide with and that no force moves. Owned by a world: its scene declares the object, or
/// <c>PhysicsWorld.AddStatic</c> adds it.
/// </summary>
public sealed class StaticObject
{
    private readonly StaticObjectSet _set;
    private readonly PlacedModel _initial;
    private PlacedModel _placed;
    private RigidPose _placedPose;

    /// <summary>Creates the handle of an object at its initial placement.</summary>
    /// <param name="set">The world's static objects.</param>
    /// <param name="placed">The object's model and initial placement.</param>
    /// <param name="index">Index among them.</param>
    /// <param name="objectIndex">Index in the scene; null for an object that was added.</param>
    internal StaticObject(StaticObjectSet set, PlacedModel placed, int index, int? objectIndex)
    {
        _set = set;
        _initial = placed;
        _placed = placed;
        Reference = placed;
        Index = index;
        ObjectIndex = objectIndex;
    }

    /// <summary>Index among the static objects of the world, from 0.</summary>
    public int Index { get; }

    /// <summary>Index of the object in the world's scene, from 0; null for an object that was added.</summary>
    public int? ObjectIndex { get; }

    /// <summary>The mesh or fractal in its own frame, shared by all objects that show it.</summary>
    public Model Model => _initial.Model;

    /// <summary>Current placement in world space: the paper's global matrix m.</summary>
    public Transformation Placement => Placed.Declaration.Placement;

    /// <summary>The current placement as a map from the model's frame to world space.</summary>
    public AffineMap ObjectToWorld => Placed.ObjectToWorld;

    /// <summary>Layer of the object, from 0 to 31. Two things meet when the mask of each has the other's layer.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no such layer.</exception>
    /// <remarks>Setting another one wakes all bodies.</remarks>
    public int Layer
    {
        get;
        set
        {
            Layers.Require(value, nameof(Layer));
            field = value;
            _set.ChangeFilters();
        }
    }

    /// <summary>The layers that the object meets: bit n for layer n. Setting others wakes all bodies.</summary>
    public uint Mask
    {
        get;
        set
        {
            field = value;
            _set.ChangeFilters();
        }
    }

    = Layers.All;

    /// <summary>
    /// True for an object that stops nothing, and only reports the bodies that reach into it, see
    /// <c>PhysicsWorld.ContactEvents</c>. Setting it wakes all bodies.
    /// </summary>
    public bool IsTrigger
    {
        get;
        set
        {
            field = value;
            _set.ChangeFilters();
        }
    }

    /// <summary>Box that holds the object in world space.</summary>
    public BoundingBox Bounds => Placed.Bounds;

    /// <summary>The object as a scene would hold it, at its current placement.</summary>
    internal PlacedModel Placed
    {
        get
        {
            if (Kinematic is { Pose: var pose } && pose != _placedPose)
            {
                _placedPose = pose;
                _placed = PlaceAt(1);
            }

            return _placed;
        }
    }

    /// <summary>The object where its collider is, from which one that moves by itself may have gone.</summary>
    internal PlacedModel Reference { get; private set; }

    /// <summary>True for a closed solid, or what consists of such. What is behind its faces is then inside it.</summary>
    internal bool IsSolid
    {
        get
        {
            foreach (var part in Model.Parts)
            {
                if (!_set.IsSolid(part.Mesh))
                {
                    return false;
                }
            }

            return true;
        }
    }

    /// <summary>
    /// 1 where faces look out of the object as they are wound, −1 where its matrix mirrors it, 0 where its instances differ.
    /// </summary>
    internal int WindingSign =>
        Model is FractalModel { Fractal.PreservesOrientation: false }
            ? 0 : Math.Sign(Reference.ObjectToWorld.Linear.Determinant());

    /// <summary>
    /// Puts the object elsewhere at once, and its collider with it, without building the collider anew. Bodies that it then overlaps are
    /// pushed out in the next step; they are not given a speed. To push and carry bodies, see <see cref="SetMotion"/>, which this ends.
    /// </summary>
    /// <param name="placement">New placement in world space, finite and with a scale that has an inverse.</param>
    /// <exception cref="ArgumentException">A number is not finite, or the scale has no inverse.</exception>
    /// <remarks>
    /// Wakes all bodies. Cost O(log n) for n static objects, and O(v) for the bounds of a mesh of v vertices. Approximate colliders
    /// (<see cref="ColliderKind.Fractal"/>, <see cref="ColliderKind.BoundingBox"/>) of objects with a skewed matrix are built again
    /// at the next query.
    /// </remarks>
    public void MoveTo(Transformation placement)
    {
        ArgumentCheck.RequirePlacement(placement, nameof(placement));
        Place(new(_initial.Declaration with { Placement = placement }, Model));
        Kinematic?.Place(_set.Clock.Time);
        _set.InvalidateSurroundings(mayOverlap: true);
    }

    /// <summary>Returns to the initial placement. Its motion is left to the caller.</summary>
    internal void ResetPlacement()
    {
        if (!ReferenceEquals(Reference, _initial))
        {
            Place(_initial);
        }
    }

    private void Place(PlacedModel placed)
    {
        Reference = placed;
        _placed = placed;
        _set.Refresh(this);
    }

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
        Kinematic.SetMotion(velocity, angularVelocity, _set.Clock.Time);
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
        placement = map.Linear == Reference.ObjectToWorld.Linear ? placement
            : Orientation.Interpolate(Kinematic.PreviousPose.Orientation, Kinematic.Pose.Orientation, alpha).Turn(placement);
        return new(Reference.Declaration with { Placement = placement }, Model);
    }
}
