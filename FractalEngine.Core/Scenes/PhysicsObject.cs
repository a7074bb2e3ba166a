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

    /// <summary>How the body finds what it touches.</summary>
    public ColliderKind Collider { get; init; }
}
