using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Support;

/// <summary>Creates random inputs of tests.</summary>
internal static class RandomExtensions
{
    public static double Between(this Random random, double low, double high) => low + (random.NextDouble() * (high - low));

    /// <summary>Creates a vector with components from −<paramref name="size"/> to <paramref name="size"/>.</summary>
    public static Vector Vector(this Random random, double size = 1) =>
        new(random.Between(-size, size), random.Between(-size, size), random.Between(-size, size));

    /// <summary>Creates a vector of length 1, in any direction.</summary>
    public static Vector Direction(this Random random)
    {
        while (true)
        {
            var v = random.Vector();
            if (v.Length() is > 0.1 and < 1)
            {
                return v / v.Length();
            }
        }
    }

    /// <summary>Creates the barycentrics of the second and third vertex for a point of a triangle. All points are equally likely.</summary>
    public static (double U, double V) Barycentrics(this Random random)
    {
        var u = random.NextDouble();
        var v = random.NextDouble();
        return u + v > 1 ? (1 - u, 1 - v) : (u, v);
    }

    /// <summary>Creates Euler angles in degrees.</summary>
    public static Vector Degrees(this Random random) => random.Vector(180);

    /// <summary>Creates a rotation, in one of two cases with a mirror.</summary>
    public static Matrix Orthogonal(this Random random)
    {
        var rotation = random.Degrees().LocalAxesFromDegrees();
        return random.Next(2) == 0 ? rotation : new(-rotation.V1, rotation.V2, rotation.V3);
    }

    /// <summary>
    /// Creates a transformation, which is skewed when chained. One in four of the factors is negative, so that mirrors occur.
    /// </summary>
    public static Transformation Transformation(this Random random, double minScale = 0.3, double maxScale = 0.7) => new(
        random.Vector(2),
        random.Degrees(),
        new(Factor(random, minScale, maxScale), Factor(random, minScale, maxScale), Factor(random, minScale, maxScale)));

    private static double Factor(Random random, double min, double max) =>
        random.Between(min, max) * (random.Next(4) == 0 ? -1 : 1);
}
