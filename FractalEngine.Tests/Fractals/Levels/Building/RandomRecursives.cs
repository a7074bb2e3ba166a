using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals.Levels.Building;

/// <summary>Draws recursives: up to four that call each other, some of them without faces or calls.</summary>
internal static class RandomRecursives
{
    public static readonly Mesh[] Meshes = [Samples.Tetrahedron, RecursiveChecks.Roof, Samples.Triangle, Mesh.Empty];

    public static RecursiveSystem Create(Random random)
    {
        var isSimilar = random.Next(2) == 0;
        return Create(random, Meshes, () => CreateMap(random, isSimilar));
    }

    /// <summary>Draws recursives with other meshes and maps.</summary>
    public static RecursiveSystem Create(Random random, Mesh[] meshes, Func<AffineMap> createMap)
    {
        var count = random.Next(1, 5);
        return new(meshes, [.. Enumerable.Range(0, count).Select(_ => new FractalRecursive(
            random.Next(meshes.Length),
            [.. Enumerable.Range(0, random.Next(random.Next(8) == 0 ? 0 : 1, 4)).Select(_ => new RecursiveCall(
                createMap(), random.Next(count), random.Next(4) == 0 ? 2 : 1))]))]);
    }

    public static AffineMap CreateMap(Random random, bool isSimilar) => RecursiveChecks.MapOf(isSimilar
        ? new(random.Vector(1.5), random.Degrees(), random.Between(0.3, 0.8) * Vector.One)
        : random.Transformation());
}
