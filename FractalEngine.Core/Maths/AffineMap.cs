using System.Globalization;

namespace FractalEngine.Core.Maths;

/// <summary>
/// A 3×4 affine map: v ↦ Linear·v + Translation. Chains of transformations are kept in this form, since a rotation
/// followed by a non-uniform scale is not one (position, rotation, scale).
/// </summary>
/// <param name="Linear">Matrix whose columns are the images of the axes.</param>
/// <param name="Translation">Image of the origin, in scene units.</param>
public readonly record struct AffineMap(Matrix Linear, Vector Translation)
{
    /// <summary>The map that leaves every point where it is.</summary>
    public static AffineMap Identity => new(Matrix.Identity, Vector.Zero);

    /// <summary>Creates the map v ↦ v + t (paper §4.2.3).</summary>
    /// <param name="translation">Scene units.</param>
    public static AffineMap Translate(Vector translation) => new(Matrix.Identity, translation);

    /// <summary>Creates a rotation about a pivot, v ↦ p + LocalAxes(r)·(v − p) (paper §4.2.3).</summary>
    /// <param name="rotation">Euler angles in degrees.</param>
    /// <param name="pivot">Point that stays where it is.</param>
    public static AffineMap Rotate(Vector rotation, Vector pivot) => AboutPivot(pivot, rotation.LocalAxesFromDegrees());

    /// <summary>Creates a scale about a pivot, v ↦ p + stretch(v − p, s) (paper §4.2.3).</summary>
    /// <param name="scale">Factors along x, y and z.</param>
    /// <param name="pivot">Point that stays where it is.</param>
    public static AffineMap Scale(Vector scale, Vector pivot) => AboutPivot(pivot, Matrix.Diagonal(scale));

    /// <summary>Maps a point from the source space to the target space.</summary>
    public static Vector operator *(AffineMap map, Vector point) => (map.Linear * point) + map.Translation;

    /// <summary>Composes two maps: <paramref name="map2"/> is applied first, then <paramref name="map1"/>.</summary>
    public static AffineMap operator *(AffineMap map1, AffineMap map2) =>
        new(map1.Linear * map2.Linear, map1 * map2.Translation);

    /// <summary>Computes the inverse map, from the target space back to the source space.</summary>
    /// <exception cref="SingularMatrixException">The linear part has no inverse.</exception>
    public AffineMap Inverse()
    {
        var inverse = Linear.Inverse();
        return new(inverse, -(inverse * Translation));
    }

    /// <summary>Applies the map so many times, in about log₂ of that many products.</summary>
    /// <param name="exponent">0 gives the identity, negative ones the powers of the inverse.</param>
    /// <exception cref="SingularMatrixException">The exponent is negative, and the map has no inverse.</exception>
    public AffineMap Power(int exponent)
    {
        var square = exponent < 0 ? Inverse() : this;
        var power = Identity;
        for (var left = Math.Abs((long)exponent); left > 0; left >>= 1)
        {
            power = (left & 1) != 0 ? power * square : power;
            square = left > 1 ? square * square : square;
        }

        return power;
    }

    /// <summary>Tells whether all entries are finite numbers.</summary>
    public bool IsFinite() => Linear.IsFinite() && Translation.IsFinite();

    /// <summary>Formats the linear part and the translation in the invariant culture.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"{Linear} + {Translation}");

    private static AffineMap AboutPivot(Vector pivot, Matrix linear) => new(linear, pivot - (linear * pivot));
}
