using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals;

/// <summary>
/// Draws positions around a fractal of any depth: far, near, exactly on it, at its centres of symmetry, and midway between instances.
/// </summary>
internal static class FractalPositions
{
    // Deeper chains end in points, smaller than any precision.
    private const int MaxLevels = 60;

    /// <summary>Draws a position for a query.</summary>
    public static Vector RandomPosition(Random random, Fractal fractal)
    {
        var box = fractal.Bounds;
        var mesh = fractal.BaseMesh;
        var levels = (int)Math.Min(fractal.LevelCount ?? MaxLevels, MaxLevels);
        var (a, b, c) = mesh.Face(random.Next(mesh.FaceCount));
        var (u, v) = random.Barycentrics();
        var inside = a + (u * (b - a)) + (v * (c - a));
        return random.Next(12) switch
        {
            0 => box.Centre + (Math.Pow(10, random.Between(0, 6)) * box.Diagonal * random.Direction()),
            1 => box.Centre,
            2 => RandomMap(random, fractal, 0, levels) * a,
            3 => RandomMap(random, fractal, 0, levels) * (random.Next(2) == 0 ? 0.5 * (a + b) : a + (u * (b - a))),
            4 => RandomMap(random, fractal, 0, levels) * inside,
            5 => (RandomMap(random, fractal, 0, levels) * inside) + (Math.Pow(10, random.Next(-14, 0)) * box.Diagonal * random.Direction()),
            6 => RandomMap(random, fractal, 0, random.Next(levels + 1)) * (random.Next(2) == 0 ? box.Centre : mesh.Bounds.Centre),
            7 => FixedPoint(random, fractal, levels),
            8 or 9 => BetweenSiblings(random, fractal, levels, inside),
            10 => box.Centre + (random.Between(0.5, 3) * box.Diagonal * random.Direction()),
            _ => RandomInBox(random, box, 1.2),
        };
    }

    /// <summary>Draws the map of an instance of some levels.</summary>
    /// <param name="random">Source of the random numbers.</param>
    /// <param name="fractal">The fractal.</param>
    /// <param name="first">The outermost level.</param>
    /// <param name="end">The level after the innermost one.</param>
    public static AffineMap RandomMap(Random random, Fractal fractal, int first, int end)
    {
        var map = AffineMap.Identity;
        for (var level = first; level < end; level++)
        {
            var maps = fractal.LevelAt(level).Maps;
            map *= maps[random.Next(maps.Length)];
        }

        return map;
    }

    /// <summary>Computes the largest of all coordinates and the fractal's size, which rounding is measured against.</summary>
    public static double Magnitude(Fractal fractal, Vector position) => Math.Max(
        position.MaxAbsComponent(),
        Math.Max(fractal.Bounds.Diagonal, Math.Max(fractal.Bounds.Minimum.MaxAbsComponent(), fractal.Bounds.Maximum.MaxAbsComponent())));

    private static Vector RandomInBox(Random random, BoundingBox box, double factor) =>
        box.Centre + box.Size.Stretch(factor * new Vector(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5));

    /// <summary>Computes the fixed point of a map under outer maps, or a point near it where the map does not shrink.</summary>
    private static Vector FixedPoint(Random random, Fractal fractal, int levels)
    {
        if (levels == 0)
        {
            return fractal.Bounds.Centre;
        }

        var level = random.Next(levels);
        var map = RandomMap(random, fractal, level, level + 1);
        var point = fractal.Bounds.Centre;
        for (var i = 0; i < 100 && (map * point).MaxAbsComponent() < 10 * Magnitude(fractal, Vector.Zero); i++)
        {
            point = map * point;
        }

        return RandomMap(random, fractal, 0, random.Next(level + 1)) * point;
    }

    /// <summary>
    /// Draws a position midway between the images of one point of the surface under two maps of a set, often equally close to both.
    /// </summary>
    private static Vector BetweenSiblings(Random random, Fractal fractal, int levels, Vector inside)
    {
        if (levels == 0)
        {
            return inside;
        }

        var level = random.Next(levels);
        var point = RandomMap(random, fractal, level + 1, levels) * inside;
        var middle = 0.5
            * ((RandomMap(random, fractal, level, level + 1) * point) + (RandomMap(random, fractal, level, level + 1) * point));
        return RandomMap(random, fractal, 0, level) * middle;
    }
}
