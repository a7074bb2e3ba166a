using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Descriptions;

/// <summary>The initial state and the constants of a body, as plain immutable data.</summary>
/// <param name="Position">Initial position of the centre of mass in world space, scene units.</param>
/// <param name="Radius">Initial radius in scene units, positive; for a compound that of its <see cref="CompoundShape.Radius"/>.</param>
public sealed record BodyDescription(Vector Position, double Radius)
{
    /// <summary>Describes a rigid body of several balls.</summary>
    /// <param name="position">Initial position of the centre of mass in world space, scene units.</param>
    /// <param name="shape">Its balls, and how its mass is spread.</param>
    public BodyDescription(Vector position, CompoundShape shape)
        : this(position, shape?.Radius ?? throw new ArgumentNullException(nameof(shape))) => Shape = shape;

    /// <summary>Describes a rigid body whose surface is a mesh or fractal, with the mass of its volume at a density of 1.</summary>
    /// <param name="position">Initial position of the centre of mass in world space, scene units.</param>
    /// <param name="mesh">Its surface, and how its mass is spread.</param>
    public BodyDescription(Vector position, MeshShape mesh)
        : this(position, mesh?.Radius ?? throw new ArgumentNullException(nameof(mesh)))
    {
        Mesh = mesh;
        Mass = mesh.Volume;
        LinearPart = mesh.Linear;
        ObjectOffset = -mesh.Centre;
    }

    /// <summary>The surface that collides; null for balls.</summary>
    public MeshShape? Mesh { get; init; }

    /// <summary>The balls of a compound; null for one ball.</summary>
    public CompoundShape? Shape { get; init; }

    /// <summary>Offset of the drawn object's origin from the centre of mass at the start, world space; zero for one ball.</summary>
    public Vector ObjectOffset { get; init; }

    /// <summary>Name for messages and tables; null for the body's index.</summary>
    public string? Name { get; init; }

    /// <summary>Initial velocity in units per second.</summary>
    public Vector Velocity { get; init; }

    /// <summary>Initial angular velocity in radians per second, about the world's axes.</summary>
    public Vector AngularVelocity { get; init; }

    /// <summary>Mass in kilograms, positive.</summary>
    public double Mass { get; init; } = 1;

    /// <summary>
    /// The paper's e: fraction of the speed along the normal that a collision preserves, from 0 to 1. Between two bodies the smaller one
    /// counts.
    /// </summary>
    public double Restitution { get; init; }

    /// <summary>Coulomb's coefficient of friction against surfaces and other bodies; at 0 a body slides for ever.</summary>
    public double Friction { get; init; }

    /// <summary>
    /// Moment of inertia over mass · radius²: 0.4 for a solid ball, 2/3 for a shell; positive and at most 2/3. A compound has its own.
    /// </summary>
    public double InertiaFactor { get; init; } = PhysicsObject.SolidInertiaFactor;

    /// <summary>True for a body that does not turn, so that friction makes it slide instead of roll.</summary>
    public bool IsRotationLocked { get; init; }

    /// <summary>Coefficient of rolling friction: the torque against rolling, over the normal force · radius.</summary>
    public double RollingFriction { get; init; }

    /// <summary>Coefficient of spinning friction: the torque about the normal, over the normal force · radius.</summary>
    public double SpinningFriction { get; init; }

    /// <summary>Rate at which the body loses speed, per second: v falls by exp(−rate·t).</summary>
    public double Damping { get; init; }

    /// <summary>Fraction of its initial size that the body loses per second (paper §5.5); 0 for none.</summary>
    public double Shrinkage { get; init; }

    /// <summary>Fraction of its initial size at which the body stops shrinking, above 0 and at most 1.</summary>
    public double MinScale { get; init; } = PhysicsObject.DefaultMinScale;

    /// <summary>Collider that finds what the body touches. Only exact ones miss nothing.</summary>
    public ColliderKind Collider { get; init; }

    /// <summary>Layer of the body, from 0 to 31. Two things meet when the mask of each has the other's layer.</summary>
    public int Layer { get; init; }

    /// <summary>The layers that the body meets: bit n for layer n.</summary>
    public uint Mask { get; init; } = Layers.All;

    /// <summary>Index in the world's scene of the object that moves with the body; null for none.</summary>
    public int? ObjectIndex { get; init; }

    /// <summary>Linear part (rotation and scale) of the paper's matrix m of the object at <see cref="ObjectIndex"/>.</summary>
    public Matrix LinearPart { get; init; } = Matrix.Identity;

    /// <summary>
    /// Creates the description of a physics object: the sphere about its position that holds all its vertices (paper §4.3.3), or the shape
    /// that the object states, fitted to its model.
    /// </summary>
    /// <param name="placed">The object with its model.</param>
    /// <param name="declared">What the scene declares of it.</param>
    /// <param name="index">Index of the object in the scene.</param>
    /// <exception cref="ArgumentException">The model is too long for a capsule, or none that collides itself.</exception>
    /// <remarks>An object whose model has no vertices gets the radius 0, which no world accepts.</remarks>
    public static BodyDescription FromPhysicsObject(PlacedModel placed, PhysicsObject declared, int index)
    {
        ArgumentCheck.Require(declared.Density is null || declared.Shape.IsMesh, "a density needs 'shape mesh'");
        ArgumentCheck.Require(declared.Density is null or > 0, "the density must be positive");
        var mesh = declared.Shape.IsMesh ? new MeshShape(placed.Model, placed.ObjectToWorld.Linear) : null;
        var shape = declared.Shape == BodyShape.Ball || mesh is not null ? null : CompoundFit.Fit(placed, declared.Shape);
        var centre = shape?.Centre ?? mesh?.Centre ?? Vector.Zero;
        var position = placed.ObjectToWorld.Translation;
        return new(centre == Vector.Zero ? position : position + centre, shape?.Radius ?? mesh?.Radius ?? BodyRadius.Compute(placed))
        {
            Shape = shape,
            Mesh = mesh,
            ObjectOffset = Vector.Zero - centre,
            Name = declared.Name,
            Velocity = declared.Velocity,
            Mass = mesh is null || (declared.IsMassStated && declared.Density is null)
                ? declared.Mass : (declared.Density ?? 1) * mesh.Volume,
            Restitution = declared.Restitution,
            Friction = declared.Friction,
            InertiaFactor = declared.InertiaFactor,
            IsRotationLocked = declared.IsRotationLocked,
            RollingFriction = declared.RollingFriction,
            SpinningFriction = declared.SpinningFriction,
            Damping = declared.Damping,
            Shrinkage = declared.Shrinkage,
            MinScale = declared.MinScale,
            Collider = declared.Collider,
            ObjectIndex = index,
            LinearPart = placed.ObjectToWorld.Linear,
        };
    }

    /// <summary>Throws for a description that no body can have.</summary>
    /// <exception cref="ArgumentException">A number is not finite, or outside its range; the message names it and the body.</exception>
    internal void Validate() =>
        ArgumentCheck.Require(FindFault() is null, $"{(Name is null ? "body without a name" : $"body {Name}")}: {FindFault()}");

    /// <summary>Describes the first number that no body can have; null for a valid description.</summary>
    internal string? FindFault() =>
        (Shape?.Radius ?? Mesh?.Radius) is { } own && own != Radius ? "the radius must be that of the shape"
        : Mesh is not null && Shape is not null ? "a body has one shape"
        : Mesh is not null && Shrinkage > 0 ? "a body with the shape of its mesh does not shrink"
        : !(Position.IsFinite() && Velocity.IsFinite()) ? "position and velocity must be finite"
        : !AngularVelocity.IsFinite() ? "the angular velocity must be finite"
        : !(LinearPart.IsFinite() && ObjectOffset.IsFinite()) ? "rotation and scale must be finite"
        : Layer is < 0 or >= Layers.Count ? "the layer must lie between 0 and 31"
        : Radius > 0 && !double.IsFinite(Radius) ? "the radius is beyond the range of a double"
        : !(Radius > 0) ? "the radius must be positive"
        : !(Mass > 0 && double.IsFinite(Mass)) ? "the mass must be positive"
        : !(Restitution is >= 0 and <= 1) ? "the coefficient of restitution must lie between 0 and 1"
        : !(Friction >= 0 && double.IsFinite(Friction)) ? "the friction must not be negative"
        : !(InertiaFactor is > 0 and <= PhysicsObject.ShellInertiaFactor) ? "the inertia must be positive and at most 2/3"
        : !(RollingFriction >= 0 && double.IsFinite(RollingFriction)) ? "the rolling friction must not be negative"
        : !(SpinningFriction >= 0 && double.IsFinite(SpinningFriction)) ? "the spinning friction must not be negative"
        : !(Damping >= 0 && double.IsFinite(Damping)) ? "the damping must not be negative"
        : !(Shrinkage >= 0 && double.IsFinite(Shrinkage)) ? "the shrinkage must not be negative"
        : !Enum.IsDefined(Collider) ? "there is no such kind of collider"
        : !(MinScale is > 0 and <= 1) ? "the minimum scale must lie between 0 and 1"
        : null;
}
