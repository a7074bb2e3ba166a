using System.Globalization;

namespace FractalEngine.Core.Maths;

/// <summary>
/// A 3×4 affine map: v ↦ Linear·v + Translation. Chains of transformations are kept in this form, because a
/// non-uniform scale followed by a rotation shears and no longer is one (position, rotation, scale).
/// </summary>
/// <param name="Linear">Columns are the images of the axes.</param>
/// <param name="Translation">The image of the origin, in scene units.</param>
public readonly record struct AffineMap(Matrix Linear, Vector Translation)
{
    /// <summary>The neutral map.</summary>
    public static AffineMap Identity => new(Matrix.Identity, Vector.Zero);

    /// <summary>v ↦ v + t (paper §4.2.3).</summary>
    public static AffineMap Translate(Vector translation) => new(Matrix.Identity, translation);

    /// <summary>v ↦ p + LocalAxes(r)·(v − p): a rotation about a pivot (paper §4.2.3).</summary>
    /// <param name="rotation">Euler angles in degrees.</param>
    /// <param name="pivot">The point that stays where it is.</param>
    public static AffineMap Rotate(Vector rotation, Vector pivot) => AboutPivot(pivot, rotation.LocalAxesFromDegrees());

    /// <summary>v ↦ p + stretch(v − p, s): a scale about a pivot (paper §4.2.3).</summary>
    /// <param name="scale">Factors along x, y and z.</param>
    /// <param name="pivot">The point that stays where it is.</param>
    public static AffineMap Scale(Vector scale, Vector pivot) => AboutPivot(pivot, Matrix.Diagonal(scale));

    /// <summary>The image of a point.</summary>
    public static Vector operator *(AffineMap map, Vector point) => (map.Linear * point) + map.Translation;

    /// <summary>Composition: <paramref name="map2"/> first, then <paramref name="map1"/>.</summary>
    public static AffineMap operator *(AffineMap map1, AffineMap map2) =>
        new(map1.Linear * map2.Linear, map1 * map2.Translation);

    /// <summary>The map that undoes this one.</summary>
    /// <exception cref="SingularMatrixException">The linear part has no inverse.</exception>
    public AffineMap Inverse() => Linear.Inverse() switch { var inverse => new(inverse, -(inverse * Translation)) };

    /// <summary>True when no entry is NaN or infinite.</summary>
    public bool IsFinite() => Linear.IsFinite() && Translation.IsFinite();

    /// <summary>Linear part and translation, invariant culture.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"{Linear} + {Translation}");

    private static AffineMap AboutPivot(Vector pivot, Matrix linear) => new(linear, pivot - (linear * pivot));
}
