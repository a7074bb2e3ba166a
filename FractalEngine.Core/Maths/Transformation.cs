using System.Globalization;

namespace FractalEngine.Core.Maths;

/// <summary>
/// What the files write as (position, rotation, scale): scale first, then rotate, then move.
/// </summary>
/// <param name="Position">Translation in scene units.</param>
/// <param name="Rotation">Euler angles in degrees, see <see cref="Vector.LocalAxes"/>.</param>
/// <param name="Scale">Factors along x, y and z; negative ones mirror, 0 flattens.</param>
public readonly record struct Transformation(Vector Position, Vector Rotation, Vector Scale)
{
    /// <summary>No transformation: position and rotation (0, 0, 0), scale (1, 1, 1).</summary>
    public static Transformation Identity => new(Vector.Zero, Vector.Zero, Vector.One);

    /// <summary>True for the transformation that changes nothing.</summary>
    public bool IsIdentity => this == Identity;

    /// <summary>Makes a uniform scale about the origin, followed by a move.</summary>
    /// <param name="position">Where the origin goes, scene units.</param>
    /// <param name="scale">The factor of all lengths.</param>
    public static Transformation At(Vector position, double scale = 1) => new(position, Vector.Zero, scale * Vector.One);

    /// <summary>
    /// Componentwise composition (paper §4.2.4): positions and rotations are added, scales multiplied. Commutative, and not
    /// what applying one map after the other does.
    /// </summary>
    public static Transformation ComposeComponentwise(Transformation t1, Transformation t2) =>
        new(t1.Position + t2.Position, t1.Rotation + t2.Rotation, t1.Scale.Stretch(t2.Scale));

    /// <summary>v ↦ Position + LocalAxes(Rotation)·(Scale stretched by v).</summary>
    public AffineMap ToAffineMap() =>
        new(Rotation.LocalAxesFromDegrees() * Matrix.Diagonal(Scale), Position);

    /// <summary>True when no component is NaN or infinite.</summary>
    public bool IsFinite() => Position.IsFinite() && Rotation.IsFinite() && Scale.IsFinite();

    /// <summary>As the files write it, invariant culture.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"({Position}, {Rotation}, {Scale})");
}
