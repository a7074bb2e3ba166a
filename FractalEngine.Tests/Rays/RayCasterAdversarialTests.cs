using FractalEngine.Core.Fractals;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Queries.Closest;
using FractalEngine.Tests.Queries.Regions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>Rays at meshes and fractals that break bounds, against all their faces.</summary>
public class RayCasterAdversarialTests
{
    private const int RaysPerFractal = 100;

    /// <summary>Names of fractals that are unusual in one way each, and have up to 50,000 faces.</summary>
    public static TheoryData<string> Unusual =>
        [.. AdversarialFractals.All.Where(pair => pair.Value().FaceCount <= 50_000).Select(pair => pair.Key)];

    /// <summary>Names of all of them.</summary>
    public static TheoryData<string> AllUnusual => [.. AdversarialFractals.All.Keys];

    [Theory]
    [MemberData(nameof(Unusual))]
    public void TryFindNearest_OnAnUnusualFractal_EqualsEveryFace(string name) =>
        Seeded.RunOne(1, random => CheckRays(random, name, AdversarialFractals.All[name](), 300));

    [Theory]
    [MemberData(nameof(AllUnusual))]
    [Trait("Category", "Soak")]
    public void TryFindNearest_OnAnUnusualFractalForLong_EqualsEveryFace(string name) =>
        Seeded.RunOne(2, random => CheckRays(random, name, AdversarialFractals.All[name](), 10_000));

    [Theory]
    [MemberData(nameof(CollisionMeshes.Names), MemberType = typeof(CollisionMeshes))]
    public void TryFindNearest_OnAMesh_EqualsEveryFace(string name) => Seeded.RunOne(1, random =>
    {
        var mesh = CollisionMeshes.All[name]();
        CheckRays(random, name, RayCaster.For(mesh), new(Fractal.Of(mesh)), 600);
    });

    [Fact]
    public void TryFindNearest_OnRandomFractals_EqualsEveryFace() => CheckRandom(1, 150);

    [Fact]
    [Trait("Category", "Soak")]
    public void TryFindNearest_OnManyRandomFractals_EqualsEveryFace() => CheckRandom(1_000_000, 20_000);

    private static void CheckRandom(int firstSeed, int fractals) =>
        Parallel.For(firstSeed, firstSeed + fractals, seed => Seeded.RunOne(seed, random =>
        {
            var fractal = random.Next(3) == 0 ? RandomFractals.Create(random) : RandomShapes.Create(random);
            if (fractal.InstanceCount > 0)
            {
                CheckRays(random, "random", fractal, RaysPerFractal);
            }
        }));

    private static void CheckRays(Random random, string name, Fractal fractal, int rays) =>
        CheckRays(random, name, RayCaster.For(fractal), new(fractal), rays);

    private static void CheckRays(Random random, string name, RayCaster caster, ShapeExpansion shape, int rays)
    {
        var checker = RayChecker.For(name, caster, shape);
        var source = new RandomRays(random, checker.Oracle);
        var context = new QueryContext();
        for (var i = 0; i < rays; i++)
        {
            var ray = random.Next(2) == 0 ? source.Draw(random, checker.Oracle) : source.DrawAtEdge(random, checker.Oracle);
            checker.Check(ray, context);
            if (i % 5 == 0)
            {
                checker.CheckLimits(ray, context);
            }
        }
    }
}
