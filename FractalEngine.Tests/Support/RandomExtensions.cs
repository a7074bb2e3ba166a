using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Support;

/// <summary>Random inputs.</summary>
internal static class RandomExtensions
{
    public static double Between(this Random random, double low, double high) => low + (random.NextDouble() * (high - low));

    /// <summary>Components from −<paramref name="size"/> to <paramref name="size"/>.</summary>
    public static Vector Vector(this Random random, double size = 1) =>
        new(random.Between(-size, size), random.Between(-size, size), random.Between(-size, size));

    /// <summary>A direction of length 1.</summary>
    public static Vector Direction(this Random random) => random.Vector() switch
    {
        var v when v.Length() is > 0.1 and < 1 => v / v.Length(),
        _ => random.Direction(),
    };

    /// <summary>Euler angles in degrees.</summary>
    public static Vector Degrees(this Random random) => random.Vector(180);

    /// <summary>A rotation, and with probability one half a mirror too.</summary>
    public static Matrix Orthogonal(this Random random) => (random.Degrees().LocalAxesFromDegrees(), random.Next(2)) switch
    {
        var (rotation, mirrored) => mirrored == 0 ? rotation : new(-rotation.V1, rotation.V2, rotation.V3),
    };

    /// <summary>Skewed when chained; half of the factors are negative, so that mirrors occur.</summary>
    public static Transformation Transformation(this Random random, double minScale = 0.3, double maxScale = 0.7) => new(
        random.Vector(2), random.Degrees(),
        new(Factor(random, minScale, maxScale), Factor(random, minScale, maxScale),
        Factor(random, minScale, maxScale)));

    private static double Factor(Random random, double min, double max) =>
        random.Between(min, max) * (random.Next(4) == 0 ? -1 : 1);
}
