using System.Globalization;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry;

/// <summary>A sphere that holds a shape. Unlike a box it does not grow under a rotation.</summary>
/// <param name="Centre">Centre in the shape's frame, scene units.</param>
/// <param name="Radius">Radius in scene units, not negative.</param>
public readonly record struct BoundingSphere(Vector Centre, double Radius)
{
    /// <summary>
    /// Computes an upper bound of the operator norm, the factor by which a matrix can lengthen a vector.
    /// </summary>
    /// <remarks>
    /// It is the square root of Gershgorin's bound of the largest eigenvalue of AᵀA, and exact for multiples of rotations and mirrors.
    /// </remarks>
    public static double OperatorNormBound(Matrix m) => Math.Sqrt(Math.Max(
        GershgorinRowSum(m.V1, m.V2, m.V3), Math.Max(GershgorinRowSum(m.V2, m.V3, m.V1), GershgorinRowSum(m.V3, m.V1, m.V2))));

    /// <summary>Computes a sphere around the image of this sphere under a map.</summary>
    public BoundingSphere Transform(AffineMap map) =>
        new(map * Centre, Radius == 0 ? 0 : OperatorNormBound(map.Linear) * Radius);

    /// <summary>Formats centre and radius in the invariant culture.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"{Centre} ± {Radius:R}");

    private static double GershgorinRowSum(Vector column, Vector other1, Vector other2) =>
        column.LengthSquared() + Math.Abs(Vector.Dot(column, other1)) + Math.Abs(Vector.Dot(column, other2));
}
