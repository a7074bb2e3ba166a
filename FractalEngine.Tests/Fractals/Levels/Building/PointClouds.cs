using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals.Levels.Building;

/// <summary>Generates sets of points of all the sorts that break convex hulls.</summary>
internal static class PointClouds
{
    /// <summary>The sets by names that say what is unusual about them.</summary>
    public static IReadOnlyDictionary<string, Func<Random, Vector[]>> All { get; } = new Dictionary<string, Func<Random, Vector[]>>
    {
        ["ball"] = random => Repeat(200, () => random.NextDouble() * random.Direction()),
        ["sphere"] = random => Repeat(500, random.Direction),
        ["few"] = random => Repeat(random.Next(2, 8), () => random.Vector()),
        ["grid"] = _ => Grid(Matrix.Identity),
        ["rotated grid"] = random => Grid(random.Orthogonal()),
        ["flat"] = random => RandomOnPlane(random, 0),
        ["flat but for rounding"] = random => RandomOnPlane(random, 1e-15),
        ["almost flat"] = random => RandomOnPlane(random, Math.Pow(10, random.Between(-14, -8))),
        ["segment"] = random => RandomOnLine(random, 0),
        ["almost a segment"] = random => RandomOnLine(random, Math.Pow(10, random.Between(-14, -8))),
        ["clusters"] = RandomClusters,
        ["clusters on a cube"] = RandomAtCubeVertices,
        ["far from the origin"] = random => Repeat(100, () => random.Vector() + (1e5 * Vector.One)),
        ["needle"] = random => Repeat(100, () => random.Vector().Stretch(new(1, 1e-5, 1e-9))),
        ["twice"] = RandomPairs,
        ["flat, far from the origin"] = random => RandomFarPlane(random, 6),
        ["flat, one point far away"] = random => [.. RandomFarPlane(random, 6), 1e6 * random.Direction()],
    };

    /// <summary>Generates a set of points, half of the time scaled by a power of ten from 1e-30 to 1e30.</summary>
    /// <param name="name">A name of <see cref="All"/>.</param>
    /// <param name="random">Source of the random numbers.</param>
    public static Vector[] Generate(string name, Random random)
    {
        var points = All[name](random);
        var scale = random.Next(2) == 0 ? 1 : Math.Pow(10, random.Next(-30, 31));
        return [.. points.Select(point => scale * point)];
    }

    /// <summary>Computes the largest absolute coordinate, which rounding is measured against.</summary>
    public static double MaxAbsCoordinate(Vector[] points) => points.Max(point => point.MaxAbsComponent());

    private static Vector[] Grid(Matrix rotation) =>
        [.. from x in Enumerable.Range(0, 5)
            from y in Enumerable.Range(0, 5)
            from z in Enumerable.Range(0, 5)
            select rotation * new Vector(x, y, z)];

    private static Vector[] RandomClusters(Random random)
    {
        var centres = Repeat(10, () => random.Vector());
        return Repeat(300, () => centres[random.Next(10)] + random.Vector(1e-12));
    }

    private static Vector[] RandomAtCubeVertices(Random random) => Repeat(300, () =>
        new Vector(random.Next(2), random.Next(2), random.Next(2)) + random.Vector(Math.Pow(10, random.Between(-16, -9))));

    private static Vector[] RandomPairs(Random random)
    {
        var points = Repeat(50, () => random.Vector());
        return [.. points, .. points];
    }

    private static Vector[] RandomOnPlane(Random random, double noise)
    {
        var u = random.Direction();
        var v = random.Direction();
        return Repeat(100, () => (random.Between(-1, 1) * u) + (random.Between(-1, 1) * v) + random.Vector(noise));
    }

    /// <summary>Generates a few points of a plane, which rounding at their place puts off it.</summary>
    private static Vector[] RandomFarPlane(Random random, int count)
    {
        var offset = 1e6 * random.Direction();
        return [.. RandomOnPlane(random, 0)[..count].Select(point => point + offset)];
    }

    private static Vector[] RandomOnLine(Random random, double noise)
    {
        var along = random.Direction();
        return Repeat(60, () => (random.Between(-1, 1) * along) + random.Vector(noise));
    }

    private static Vector[] Repeat(int count, Func<Vector> draw) => [.. Enumerable.Range(0, count).Select(_ => draw())];
}
