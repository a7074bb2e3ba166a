using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing;

/// <summary>
/// Scales that flatten space are refused where they are written: a map without an inverse has no normals, no local frame to
/// zoom into and nothing to pull a query back through (docs/decisions/0003-singular-scales.md).
/// </summary>
internal static class ScaleCheck
{
    // The product of three factors, and its inverse, have to stay within the range of a double.
    private const double Smallest = 1e-100;
    private const double Largest = 1e100;

    public static bool IsRegular(Vector scale) => IsRegular(scale.X) && IsRegular(scale.Y) && IsRegular(scale.Z);

    public static string Message(Vector scale) =>
        $"the scale {scale} is singular: each factor must lie between 1e-100 and 1e100 in size";

    private static bool IsRegular(double factor) => Math.Abs(factor) is >= Smallest and <= Largest;
}
