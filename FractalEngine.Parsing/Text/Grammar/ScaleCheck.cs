using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Text.Grammar;

/// <summary>
/// Rejects scales that flatten space where they are written (docs/decisions/0003-singular-scales.md). A map without an inverse
/// has no normals, no local frame to zoom into and no way to pull a query back.
/// </summary>
internal static class ScaleCheck
{
    // The product of three factors and the inverse of that product must stay within the range of a double.
    private const double MinFactor = 1e-100;
    private const double MaxFactor = 1e100;

    public static bool IsInvertible(Vector scale) => IsInvertible(scale.X) && IsInvertible(scale.Y) && IsInvertible(scale.Z);

    public static string SingularScaleMessage(Vector scale) =>
        $"the scale {scale} is singular: each factor must lie between 1e-100 and 1e100 in size";

    /// <summary>Tells the same of a map by its columns.</summary>
    public static bool IsInvertible(Matrix linear)
    {
        try
        {
            return linear.MaxAbsEntry() <= MaxFactor && linear.Inverse().MaxAbsEntry() <= 1 / MinFactor;
        }
        catch (SingularMatrixException)
        {
            return false;
        }
    }

    private static bool IsInvertible(double factor) => Math.Abs(factor) is >= MinFactor and <= MaxFactor;
}
