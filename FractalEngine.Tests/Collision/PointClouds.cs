using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Collision;

/// <summary>Sets of points of all the sorts that break convex hulls.</summary>
internal static class PointClouds
{
    public static IReadOnlyDictionary<string, Func<Random, Vector[]>> All { get; } = new Dictionary<string, Func<Random, Vector[]>>
    {
        ["ball"] = random => Repeat(200, () => random.NextDouble() * random.Direction()),
        ["sphere"] = random => Repeat(500, random.Direction),
        ["few"] = random => Repeat(random.Next(2, 8), () => random.Vector()),
        ["grid"] =
        _ => [.. from x in Enumerable.Range(0, 5) from y in Enumerable.Range(0, 5) from z in Enumerable.Range(0, 5) select new Vector(x, y,
        z)],
        ["turned grid"] = random => random.Orthogonal() switch
        {
            var turn =>
                [.. from x in Enumerable.Range(0, 5) from y in Enumerable.Range(0, 5) from z in Enumerable.Range(0, 5) select turn
                    * new Vector(x, y, z)],
        },
        ["flat"] = random => RandomOnPlane(random, 0),
        ["flat but for rounding"] = random => RandomOnPlane(random, 1e-15),
        ["almost flat"] = random => RandomOnPlane(random, Math.Pow(10, random.Between(-14, -8))),
        ["segment"] = random => RandomOnLine(random, 0),
        ["almost a segment"] = random => RandomOnLine(random, Math.Pow(10, random.Between(-14, -8))),
        ["clusters"] = random => Repeat(10, () => random.Vector()) switch
        {
            var centres => Repeat(300, () => centres[random.Next(10)] + random.Vector(1e-12)),
        },
        ["clusters on a cube"] =
        random => Repeat(300, () => new Vector(random.Next(2), random.Next(2), random.Next(2))
            + random.Vector(Math.Pow(10, random.Between(-16, -9)))),
        ["far from the origin"] = random => Repeat(100, () => random.Vector() + (1e5 * Vector.One)),
        ["needle"] = random => Repeat(100, () => random.Vector().Stretch(new(1, 1e-5, 1e-9))),
        ["twice"] = random => Repeat(50, () => random.Vector()) switch { var points => [.. points, .. points] },
    };

    /// <summary>Powers of ten.</summary>
    public static Vector[] Generate(string name, Random random) =>
        (All[name](random), random.Next(2) == 0 ? 1 : Math.Pow(10, random.Next(-30, 31))) switch
    {
        var (points, scale) => [.. points.Select(point => scale * point)],
    };

    /// <summary>The largest coordinate, which rounding is measured against.</summary>
    public static double MaxAbsCoordinate(Vector[] points) => points.Max(point => point.MaxAbsComponent());

    private static Vector[] RandomOnPlane(Random random, double noise)
    {
        var (u, v) = (random.Direction(), random.Direction());
        return Repeat(100, () => (random.Between(-1, 1) * u) + (random.Between(-1, 1) * v) + random.Vector(noise));
    }

    private static Vector[] RandomOnLine(Random random, double noise)
    {
        var along = random.Direction();
        return Repeat(60, () => (random.Between(-1, 1) * along) + random.Vector(noise));
    }

    private static Vector[] Repeat(int count, Func<Vector> draw) => [.. Enumerable.Range(0, count).Select(_ => draw())];
}
