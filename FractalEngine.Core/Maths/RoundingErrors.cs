namespace FractalEngine.Core.Maths;

/// <summary>
/// Upper bounds of the rounding errors of computed lengths, for searches that must not miss what rounding hides. One operation in double
/// precision errs by at most 2⁻⁵³ ≈ 1.1e-16 of its result (IEEE 754); each bound holds for the number of operations that it states.
/// </summary>
internal static class RoundingErrors
{
    /// <summary>Error of a norm, a scale or the square of a unit vector, as a part of it: at most 9 operations.</summary>
    public const double Norm = 1e-15;

    /// <summary>
    /// Error of a point after one map, and of the centre and half the size of a box, as a part of the largest coordinate: at most 18
    /// operations.
    /// </summary>
    public const double MappedPoint = 2e-15;

    /// <summary>
    /// Error of a coordinate or a distance along a chain of maps whose parts are rounded, as a part of the largest coordinate met: at most
    /// 36 operations.
    /// </summary>
    public const double Coordinate = 4e-15;

    /// <summary>Error of a box or a norm after a chain of products, as a part of its size: at most 90 operations.</summary>
    public const double Chain = 1e-14;
}
