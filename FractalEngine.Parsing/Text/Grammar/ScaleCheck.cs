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

    private const double MaxTranslation = 1e300;

    // Less is the rounding of a few products.
    private const double MinVolume = 1e-13;

    public static bool IsInvertible(Vector scale) => IsInvertible(scale.X) && IsInvertible(scale.Y) && IsInvertible(scale.Z);

    public static string SingularScaleMessage(Vector scale) =>
        $"the scale {scale} is singular: each factor must lie between 1e-100 and 1e100 in size";

    /// <summary>Returns why a query can't be taken back through a map, as the end of a sentence about it; null where it can.</summary>
    public static string? FindFault(in AffineMap map)
    {
        var (x, y, z) = (map.Linear.V1.Length(), map.Linear.V2.Length(), map.Linear.V3.Length());
        if (!(Math.Max(x, Math.Max(y, z)) <= MaxFactor) || !(Math.Min(x, Math.Min(y, z)) >= MinFactor)
            || !(map.Translation.MaxAbsComponent() <= MaxTranslation))
        {
            return "is beyond all sizes: it must make the axes between 1e-100 and 1e100 long";
        }

        // The volume of what the axes become, if each were as long as before.
        var volume = new Matrix(map.Linear.V1 / x, map.Linear.V2 / y, map.Linear.V3 / z).Determinant();
        return Math.Abs(volume) >= MinVolume ? null : "is flat to rounding, so that it has no inverse";
    }

    private static bool IsInvertible(double factor) => Math.Abs(factor) is >= MinFactor and <= MaxFactor;
}
