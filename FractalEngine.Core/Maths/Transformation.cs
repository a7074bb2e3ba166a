using System.Globalization;

namespace FractalEngine.Core.Maths;

/// <summary>A transformation as files write it, (position, rotation, scale): it scales first, then rotates, then moves.</summary>
/// <param name="Position">Translation in scene units.</param>
/// <param name="Rotation">Euler angles in degrees, see <see cref="Vector.LocalAxes"/>.</param>
/// <param name="Scale">Factors along x, y and z; negative ones mirror, 0 flattens.</param>
public readonly record struct Transformation(Vector Position, Vector Rotation, Vector Scale)
{
    /// <summary>The transformation without effect: position and rotation (0, 0, 0), scale (1, 1, 1).</summary>
    public static Transformation Identity => new(Vector.Zero, Vector.Zero, Vector.One);

    /// <summary>True for the transformation without effect.</summary>
    public bool IsIdentity => this == Identity;

    /// <summary>Makes a uniform scale about the origin, followed by a move.</summary>
    /// <param name="position">Where the origin goes, scene units.</param>
    /// <param name="scale">The factor of all lengths.</param>
    public static Transformation At(Vector position, double scale = 1) => new(position, Vector.Zero, scale * Vector.One);

    /// <summary>
    /// Composes two transformations component by component (paper §4.2.4): positions and rotations are added, scales multiplied.
    /// </summary>
    /// <remarks>This is commutative, and differs from applying one map after the other.</remarks>
    public static Transformation ComposeComponentwise(Transformation t1, Transformation t2) =>
        new(t1.Position + t2.Position, t1.Rotation + t2.Rotation, t1.Scale.Stretch(t2.Scale));

    /// <summary>Converts to the map v ↦ Position + LocalAxes(Rotation)·(v stretched by Scale).</summary>
    public AffineMap ToAffineMap() =>
        new(Rotation.LocalAxesFromDegrees() * Matrix.Diagonal(Scale), Position);

    /// <summary>True when no component is NaN or infinite.</summary>
    public bool IsFinite() => Position.IsFinite() && Rotation.IsFinite() && Scale.IsFinite();

    /// <summary>Formats the transformation as files write it, in the invariant culture.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"({Position}, {Rotation}, {Scale})");
}
