using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>Random positions of queries around a shape. The same seed gives the same positions.</summary>
internal static class QueryPositions
{
    /// <summary>Creates a position anywhere in a box.</summary>
    public static Vector Uniform(Random random, BoundingBox box) => box.Minimum + box.Size.Stretch(RandomInUnitCube(random));

    /// <summary>Creates a position up to 1 % of the diagonal along each axis from a random point of a random face.</summary>
    public static Vector NearSurface(Random random, Mesh mesh) =>
        OnSurface(random, mesh) + RandomOffset(random, 0.01 * mesh.Bounds.Diagonal);

    /// <summary>Creates a position up to 1 % of the diagonal along each axis from a random point of a random instance.</summary>
    public static Vector NearSurface(Random random, Fractal fractal) =>
        OnSurface(random, fractal) + RandomOffset(random, 0.01 * fractal.Bounds.Diagonal);

    /// <summary>
    /// Creates a position in any direction, 1 to 1.5 diagonals from the centre of a box: so at least half a diagonal from the box.
    /// </summary>
    public static Vector Far(Random random, BoundingBox box)
    {
        while (true)
        {
            var direction = RandomOffset(random, 1);
            if (direction.Length() is > 0.1 and <= 1)
            {
                return box.Centre + ((1 + (0.5 * random.NextDouble())) * box.Diagonal * direction.UnitVector());
            }
        }
    }

    /// <summary>Creates a position on a random face of a random instance, by one random map a level.</summary>
    public static Vector OnSurface(Random random, Fractal fractal)
    {
        // Deeper levels move a point by less than a coordinate can hold.
        const int maxLevels = 120;
        var levels = (int)Math.Min(fractal.LevelCount ?? maxLevels, maxLevels);
        var point = OnSurface(random, fractal.BaseMesh);
        for (var level = levels - 1; level >= 0; level--)
        {
            var maps = fractal.LevelAt(level).Maps;
            point = maps[random.Next(maps.Length)] * point;
        }

        return point;
    }

    /// <summary>Creates a point of a triangle, all of which are equally likely.</summary>
    public static Vector InTriangle(Random random, Vector a, Vector b, Vector c)
    {
        var u = random.NextDouble();
        var v = random.NextDouble();
        (u, v) = u + v > 1 ? (1 - u, 1 - v) : (u, v);
        return a + (u * (b - a)) + (v * (c - a));
    }

    private static Vector OnSurface(Random random, Mesh mesh)
    {
        var (a, b, c) = mesh.Face(random.Next(mesh.FaceCount));
        return InTriangle(random, a, b, c);
    }

    private static Vector RandomOffset(Random random, double maxOffset) => maxOffset * ((2 * RandomInUnitCube(random)) - Vector.One);

    private static Vector RandomInUnitCube(Random random) => new(random.NextDouble(), random.NextDouble(), random.NextDouble());
}
