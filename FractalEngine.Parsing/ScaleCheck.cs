using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing;

/// <summary>
/// Scales that flatten space are refused where they are written: a map without an inverse has no normals, no local frame to
/// zoom into and nothing to pull a query back through (docs/decisions/0003-singular-scales.md).
/// </summary>
internal static class ScaleCheck
{
    // The product of three factors, and its inverse, have to stay within the range of a double.
    private const double MinFactor = 1e-100;
    private const double MaxFactor = 1e100;

    public static bool IsInvertible(Vector scale) => IsInvertible(scale.X) && IsInvertible(scale.Y) && IsInvertible(scale.Z);

    public static string SingularScaleMessage(Vector scale) =>
        $"the scale {scale} is singular: each factor must lie between 1e-100 and 1e100 in size";

    private static bool IsInvertible(double factor) => Math.Abs(factor) is >= MinFactor and <= MaxFactor;
}
