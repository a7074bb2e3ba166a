using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <summary>What a body is at first.</summary>
/// <param name="Position">Of its centre, world space, scene units.</param>
/// <param name="Radius">Scene units, positive.</param>
public sealed record BodyDescription(Vector Position, double Radius)
{
    /// <summary>For messages and tables; null for its number.</summary>
    public string? Name { get; init; }

    /// <summary>Units a second.</summary>
    public Vector Velocity { get; init; }

    /// <summary>Kilograms, positive.</summary>
    public double Mass { get; init; } = 1;

    /// <summary>The paper's e: which part of the speed along the normal a collision leaves, from 0 to 1.</summary>
    public double Restitution { get; init; }

    /// <summary>Coulomb's coefficient against surfaces and other bodies; 0 slides for ever.</summary>
    public double Friction { get; init; }

    /// <summary>Which part of its speed the body loses a second, as a rate: v falls by exp(−rate·t).</summary>
    public double Damping { get; init; }

    /// <summary>Which part of its first size the body loses a second (paper §5.5); 0 for none.</summary>
    public double Shrinkage { get; init; }

    /// <summary>Of its first size, where shrinking ends.</summary>
    public double MinimumScale { get; init; } = PhysicsObject.DefaultMinimumScale;

    /// <summary>How the body finds what it touches. Only the exact ones can't miss.</summary>
    public ColliderKind Collider { get; init; }

    /// <summary>The object of the scene that moves with it, −1 for none.</summary>
    public int ObjectIndex { get; init; } = -1;

    /// <summary>The linear part of that object's matrix m: turn and scale.</summary>
    public Matrix LinearPart { get; init; } = Matrix.Identity;

    /// <summary>The body of a physics object: the ball about m's position that holds all vertices (paper §4.3.3).</summary>
    /// <param name="placed">The object with its model.</param>
    /// <param name="declared">What the scene says of it.</param>
    /// <param name="index">Its place in the scene.</param>
    /// <exception cref="ArgumentException">The object has no size.</exception>
    public static BodyDescription FromPhysicsObject(PlacedModel placed, PhysicsObject declared, int index) =>
        new(placed.ObjectToWorld.Translation, BodyRadius.Compute(placed))
    {
        Name = declared.Name,
        Velocity = declared.Velocity,
        Mass = declared.Mass,
        Restitution = declared.Restitution,
        Friction = declared.Friction,
        Damping = declared.Damping,
        Shrinkage = declared.Shrinkage,
        MinimumScale = declared.MinimumScale,
        Collider = declared.Collider,
        ObjectIndex = index,
        LinearPart = placed.ObjectToWorld.Linear,
    };

    /// <summary>Throws for what no body can be.</summary>
    /// <exception cref="ArgumentException">A number is not finite, or outside of its range; the message names it.</exception>
    internal void Validate()
    {
        Require(Position.IsFinite() && Velocity.IsFinite() && LinearPart.IsFinite(), "position, velocity and axes must be finite");
        Require(Radius > 0 && double.IsFinite(Radius), "the radius must be positive");
        Require(Mass > 0 && double.IsFinite(Mass), "the mass must be positive");
        Require(Restitution is >= 0 and <= 1, "the coefficient of restitution must lie between 0 and 1");
        Require(Friction >= 0 && double.IsFinite(Friction), "the friction must not be negative");
        Require(Damping >= 0 && double.IsFinite(Damping), "the damping must not be negative");
        Require(Shrinkage >= 0 && double.IsFinite(Shrinkage), "the shrinkage must not be negative");
        Require(MinimumScale is > 0 and <= 1, "the least scale must lie between 0 and 1");
    }

    private void Require(bool condition, string message)
    {
        if (!condition)
        {
            throw new ArgumentException($"body {Name ?? "without a name"}: {message}");
        }
    }
}
