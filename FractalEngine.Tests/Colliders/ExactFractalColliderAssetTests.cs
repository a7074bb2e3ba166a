using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Fractals;
using FractalEngine.Tests.Queries.Closest;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Colliders;

/// <summary>
/// The exact fractal collider against every face, on the fractals of the assets, from positions that are hard to get right.
/// </summary>
public class ExactFractalColliderAssetTests
{
    private const int SoakQueries = 1_900_000;

    /// <summary>Assets and depths with up to 300,000 faces.</summary>
    public static TheoryData<string, int> ExpandedFractals => new()
    {
        { "sierpinski", 4 }, { "tetrahedron", 5 }, { "menger", 2 }, { "appendix-b", 2 }, { "appendix-b-structure", 2 }, { "diamond", 2 },
        { "fern", 2 }, { "romanesco", 2 }, { "shell", 0 }, { "snowflake", 3 }, { "terrain", 5 }, { "tree", 4 }, { "tree-leaves", 4 },
        { "googol", 3 },
    };

    /// <summary>Assets and greater depths with up to 300,000 faces.</summary>
    public static TheoryData<string, int> DeeperFractals => new()
    {
        { "sierpinski", 5 }, { "tetrahedron", 7 }, { "menger", 3 }, { "appendix-b", 3 }, { "appendix-b-structure", 3 }, { "diamond", 2 },
        { "fern", 2 }, { "romanesco", 2 }, { "shell", 0 }, { "snowflake", 4 }, { "terrain", 7 }, { "tree", 6 }, { "tree-leaves", 5 },
        { "googol", 4 },
        { "sierpinski", 2 }, { "menger", 1 }, { "fern", 1 }, { "terrain", 3 }, { "tree", 2 },
    };

    [Theory]
    [MemberData(nameof(ExpandedFractals))]
    public void TryFindClosest_OnAnAsset_EqualsEveryFace(string name, int depth)
    {
        var (checker, oracle, simple) = Load(name, depth);
        var context = new QueryContext();
        Seeded.Run(300, random =>
        {
            var position = FractalPositions.RandomPosition(random, checker.Fractal);
            var expected = ClosestDistance(oracle, position, context);
            if (random.Next(30) == 0)
            {
                checker.ThrowUnless(expected == ClosestDistance(simple, position, context), position,
                    $"the hierarchy finds {expected:R}, unlike the test of every face");
            }

            var closest = checker.CheckQuery(position, context, expected);
            checker.CheckMaxDistance(position, context, closest.Distance);
        });
    }

    [Theory]
    [MemberData(nameof(DeeperFractals))]
    [Trait("Category", "Soak")]
    public void TryFindClosest_OnAnAssetForLong_EqualsEveryFace(string name, int depth)
    {
        var (checker, oracle, simple) = Load(name, depth);
        Parallel.For(1, 1 + (SoakQueries / DeeperFractals.Count / 100), () => new QueryContext(), (seed, _, context) =>
        {
            Seeded.RunOne(seed, random =>
            {
                for (var query = 0; query < 100; query++)
                {
                    var position = FractalPositions.RandomPosition(random, checker.Fractal);
                    var expected = ClosestDistance(oracle, position, context);
                    var closest = checker.CheckQuery(position, context, expected);
                    if (query % 8 == 0)
                    {
                        checker.CheckMaxDistance(position, context, closest.Distance);
                    }
                }

                if (seed % 50 == 0)
                {
                    var position = FractalPositions.RandomPosition(random, checker.Fractal);
                    var expected = ClosestDistance(oracle, position, context);
                    checker.ThrowUnless(expected == ClosestDistance(simple, position, context), position,
                        $"the hierarchy finds {expected:R}, unlike the test of every face");
                }
            });
            return context;
        }, _ => { });
    }

    private static (ExactColliderChecker Checker, Collider Oracle, Collider Simple) Load(string name, int depth)
    {
        var asset = AssetFractals.Load(name);
        var fractal = asset.Description.HasDepth ? asset.WithDepth(depth) : asset;
        Assert.True(fractal.InstanceCount > 0, name);
        // Duplicates by the identity count here, but are one in the mesh.
        var mesh = FractalGenerator.Flatten(fractal, 4_000_000);
        Assert.InRange(mesh.FaceCount, 1, 300_000);
        return (new($"{name} of depth {depth}", fractal), new HierarchyCollider(mesh), new SimpleCollider(mesh));
    }

    private static double ClosestDistance(Collider collider, Vector position, QueryContext context) =>
        collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest) ? closest.Distance : double.PositiveInfinity;
}
