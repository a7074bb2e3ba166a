using System.Globalization;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry;

/// <summary>A ball that holds a shape. Unlike a box it does not grow when a similarity turns it.</summary>
/// <param name="Centre">In the shape's frame, scene units.</param>
/// <param name="Radius">Scene units, not negative.</param>
public readonly record struct BoundingSphere(Vector Centre, double Radius)
{
    /// <summary>
    /// An upper bound of the factor by which a matrix can lengthen a vector: the square root of Gershgorin's bound of
    /// the largest eigenvalue of AᵀA. Exact for multiples of rotations and mirrors.
    /// </summary>
    public static double OperatorNormBound(Matrix m) => Math.Sqrt(Math.Max(
        GershgorinRowSum(m.V1, m.V2, m.V3), Math.Max(GershgorinRowSum(m.V2, m.V3, m.V1), GershgorinRowSum(m.V3, m.V1, m.V2))));

    /// <summary>A ball around the image of this ball.</summary>
    public BoundingSphere Transform(AffineMap map) =>
        new(map * Centre, Radius == 0 ? 0 : OperatorNormBound(map.Linear) * Radius);

    /// <summary>Centre and radius, invariant culture.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"{Centre} ± {Radius:R}");

    private static double GershgorinRowSum(Vector column, Vector other1, Vector other2) =>
        column.LengthSquared() + Math.Abs(Vector.Dot(column, other1)) + Math.Abs(Vector.Dot(column, other2));
}
