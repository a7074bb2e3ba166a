using System.Globalization;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Text.Grammar;

/// <summary>Recognises rotations that are probably given in the other unit. They are valid, so that they cause a warning at most.</summary>
internal static class RotationUnits
{
    // The angles that people choose are multiples of 15 degrees.
    private const double CommonAngle = Math.PI / 12;

    // Rounding to three digits, as in 1.57, changes a number by less.
    private const double RelativeTolerance = 1e-3;

    /// <summary>Describes a rotation in degrees that looks like radians: only multiples of π/12, as 1.5708 is.</summary>
    /// <returns>Null for any other rotation.</returns>
    public static string? DescribeRadians(Vector degrees)
    {
        // Without allocation, since each call of a transformation is looked at.
        var (x, y, z) = degrees;
        var first = x != 0 ? x : y != 0 ? y : z;
        return first != 0 && IsZeroOrCommonRadian(x) && IsZeroOrCommonRadian(y) && IsZeroOrCommonRadian(z)
            ? Describe(degrees, "radians", "degrees", first, Math.Round(first * 180 / Math.PI))
            : null;
    }

    /// <summary>Describes a rotation in radians that looks like degrees: an angle is more than a whole turn.</summary>
    /// <returns>Null for any other rotation.</returns>
    public static string? DescribeDegrees(Vector radians)
    {
        var angle = Components(radians).FirstOrDefault(static angle => Math.Abs(angle) > 2 * Math.PI * (1 + RelativeTolerance));
        return angle == 0 ? null : Describe(radians, "degrees", "radians", angle, Math.Round(angle / 180 * Math.PI, 4));
    }

    private static string Describe(Vector rotation, string likely, string unit, double angle, double converted) => string.Create(
        CultureInfo.InvariantCulture,
        $"the rotation {rotation} looks like {likely}, but is in {unit} here: {angle:R} {likely} are {converted:R} {unit}");

    private static bool IsZeroOrCommonRadian(double angle)
    {
        if (angle == 0)
        {
            return true;
        }

        var multiple = Math.Round(angle / CommonAngle) * CommonAngle;
        return multiple != 0 && Math.Abs(angle) <= 2 * Math.PI * (1 + RelativeTolerance)
            && Math.Abs(angle - multiple) <= RelativeTolerance * Math.Abs(multiple);
    }

    private static double[] Components(Vector vector) => [vector.X, vector.Y, vector.Z];
}
