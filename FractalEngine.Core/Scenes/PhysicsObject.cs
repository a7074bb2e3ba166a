using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>An object that falls, bounces and rests (paper §4.4.1).</summary>
public sealed record PhysicsObject : SceneObject
{
    /// <summary>Makes a body that shows a model.</summary>
    /// <param name="model">What the body shows; its bounding sphere collides, unless <see cref="Shape"/> is another.</param>
    /// <param name="restitution">The paper's e, from 0 (steel) to 1 (rubber).</param>
    public PhysicsObject(Model model, double restitution = 0)
        : base(model) => Restitution = restitution;

    /// <summary>Makes a body that shows what a file holds, which is not loaded yet.</summary>
    /// <param name="file">As the scene names it.</param>
    /// <param name="placement">Where the body starts.</param>
    /// <param name="restitution">The paper's e, from 0 (steel) to 1 (rubber).</param>
    public PhysicsObject(string file, Transformation placement, double restitution)
        : base(file, placement) => Restitution = restitution;

    /// <summary>The paper's coefficient of restitution e, from 0 (steel) to 1 (rubber).</summary>
    public double Restitution { get; init; }

    /// <summary>Initial velocity in units a second.</summary>
    public Vector Velocity { get; init; }

    /// <summary>
    /// Mass in kilograms, positive: 1 unless stated, or the volume times <see cref="Density"/> for a body with the shape of its model.
    /// </summary>
    public double Mass
    {
        get;
        init
        {
            field = value;
            IsMassStated = true;
        }
    }

    = 1;

    /// <summary>True where the mass has been set.</summary>
    public bool IsMassStated { get; private init; }

    /// <summary>
    /// Kilograms in a cubic unit of a body with the shape of its model, positive; null for 1 where no mass is stated.
    /// </summary>
    public double? Density { get; init; }

    /// <summary>Coulomb's coefficient of friction; 0 for the paper's bodies, which keep their speed along a surface.</summary>
    public double Friction { get; init; }

    /// <summary>The inertia of a solid ball: 2/5.</summary>
    public const double SolidInertiaFactor = 0.4;

    /// <summary>The inertia of a thin shell, the largest that a ball can have: 2/3.</summary>
    public const double ShellInertiaFactor = 2.0 / 3;

    /// <summary>What of the object collides.</summary>
    public BodyShape Shape { get; init; }

    /// <summary>Moment of inertia of a ball over mass · radius²: positive, and at most <see cref="ShellInertiaFactor"/>.</summary>
    public double InertiaFactor { get; init; } = SolidInertiaFactor;

    /// <summary>True for a body that does not turn, so that friction makes it slide instead of roll.</summary>
    public bool IsRotationLocked { get; init; }

    /// <summary>Coefficient of rolling friction: the torque against rolling, over the normal force · radius.</summary>
    public double RollingFriction { get; init; }

    /// <summary>Coefficient of spinning friction: the torque about the normal, over the normal force · radius.</summary>
    public double SpinningFriction { get; init; }

    /// <summary>Rate of damping in 1/s: the speed falls by the factor exp(−rate·t).</summary>
    public double Damping { get; init; }

    /// <summary>Fraction of its first size that the body loses a second (paper §5.5); 0 for none.</summary>
    public double Shrinkage { get; init; }

    /// <summary>Fraction of its first size at which shrinking ends.</summary>
    public double MinScale { get; init; } = DefaultMinScale;

    /// <summary>Fraction of the first size at which shrinking ends unless stated otherwise.</summary>
    public const double DefaultMinScale = 0.05;

    /// <summary>The collider that finds what the body touches.</summary>
    public ColliderKind Collider { get; init; }
}
