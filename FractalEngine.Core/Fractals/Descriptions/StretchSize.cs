using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>Sizes as whole numbers, so that they add up to the same in any order: −log₂ of a length, in units of 2⁻³².</summary>
/// <remarks>A larger number is a smaller size. That of a similarity is exact to 2⁻³³, and so is the stretch of other maps.</remarks>
internal static class StretchSize
{
    private const int FractionBits = 32;

    // Relative to 1 in the size: more than rounding of thousands of maps adds up to.
    private const double Tolerance = 1e-6;

    /// <summary>The size of a unit sphere under a map: of the longest vector that the map makes of a unit vector.</summary>
    public static long Of(Matrix linear) => OfLength(linear.OperatorNorm());

    /// <summary>The largest number of a stretch that still makes a length reach a limit, to a millionth of it.</summary>
    /// <param name="length">The length that is stretched; not negative.</param>
    /// <param name="limit">The limit; positive.</param>
    public static long LimitOf(double length, double limit) =>
        length > 0 ? (long)Math.Ceiling(Math.ScaleB(Math.Log2(length / limit) + (Tolerance / Math.Log(2)), FractionBits)) : long.MinValue;

    private static long OfLength(double length) => (long)Math.Round(Math.ScaleB(-Math.Log2(length), FractionBits));
}
