using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>An object that falls, bounces and rests (paper §4.4.1).</summary>
/// <param name="File">As the scene names it.</param>
/// <param name="Placement">Where it starts.</param>
/// <param name="Restitution">The paper's e, from 0 (steel) to 1 (rubber).</param>
public sealed record PhysicsObject(string File, Transformation Placement, double Restitution) : SceneObject(File, Placement)
{
    /// <summary>Initial velocity in units a second.</summary>
    public Vector Velocity { get; init; }

    /// <summary>Mass in kilograms, positive.</summary>
    public double Mass { get; init; } = 1;

    /// <summary>Coulomb's coefficient; 0 for the paper's bodies, which keep their speed along a surface.</summary>
    public double Friction { get; init; }

    /// <summary>Which part of its speed the body loses a second, as a rate: v falls by exp(−rate·t).</summary>
    public double Damping { get; init; }

    /// <summary>Which part of its first size the body loses a second (paper §5.5); 0 for none.</summary>
    public double Shrinkage { get; init; }

    /// <summary>The part of its first size at which shrinking ends.</summary>
    public double MinimumScale { get; init; } = DefaultMinimumScale;

    /// <summary>Where shrinking ends unless the scene says so.</summary>
    public const double DefaultMinimumScale = 0.05;

    /// <summary>How the body finds what it touches.</summary>
    public ColliderKind Collider { get; init; }
}
