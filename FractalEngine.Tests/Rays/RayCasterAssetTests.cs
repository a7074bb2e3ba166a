using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>Rays at the fractals of the assets against all their faces.</summary>
public class RayCasterAssetTests
{
    private const int Rays = 2000;
    private const int SoakRays = 8_000_000;

    // The decimals of its file leave gaps of 3e-13 between its parts, wider than rounding.
    private const string WithGaps = "shell";

    /// <summary>Assets and depths with up to 30,000 faces.</summary>
    public static TheoryData<string, int> ExpandedFractals => new()
    {
        { "sierpinski", 3 }, { "tetrahedron", 5 }, { "menger", 2 }, { "appendix-b", 1 }, { "appendix-b-structure", 1 }, { "diamond", 1 },
        { "fern", 1 }, { "romanesco", 1 }, { "shell", 0 }, { "snowflake", 2 }, { "terrain", 5 }, { "tree", 3 }, { "tree-leaves", 3 },
        { "googol", 3 },
    };

    /// <summary>Assets and greater depths with up to 300,000 faces.</summary>
    public static TheoryData<string, int> DeeperFractals => new()
    {
        { "sierpinski", 4 }, { "tetrahedron", 7 }, { "menger", 3 }, { "appendix-b", 2 }, { "appendix-b-structure", 2 }, { "diamond", 2 },
        { "fern", 2 }, { "romanesco", 2 }, { "shell", 0 }, { "snowflake", 3 }, { "terrain", 7 }, { "tree", 5 }, { "tree-leaves", 5 },
        { "googol", 4 },
        { "sierpinski", 2 }, { "menger", 1 }, { "fern", 1 }, { "terrain", 3 }, { "tree", 2 },
    };

    [Theory]
    [MemberData(nameof(ExpandedFractals))]
    public void TryFindNearest_OnAnAsset_EqualsEveryFace(string name, int depth) => CheckAll(name, depth, 1, Rays);

    [Theory]
    [MemberData(nameof(DeeperFractals))]
    [Trait("Category", "Soak")]
    public void TryFindNearest_OnAnAssetForLong_EqualsEveryFace(string name, int depth) =>
        CheckAll(name, depth, 1_000_000, SoakRays / DeeperFractals.Count);

    /// <summary>Half of the rays are aimed at edges, where nothing may leak. At least a tenth of the others certainly hit.</summary>
    private static void CheckAll(string name, int depth, int firstSeed, int rays)
    {
        const int raysPerSeed = 100;
        var asset = AssetFractals.Load(name);
        var fractal = asset.Description.HasDepth ? asset.WithDepth(depth) : asset;
        Assert.InRange((double)fractal.FaceCount!, 1, 300_000);
        var checker = RayChecker.For(FormattableString.Invariant($"{name} of depth {depth}"), RayCaster.For(fractal), new(fractal));
        var certain = 0;
        Parallel.For(firstSeed, firstSeed + (rays / raysPerSeed), () => new QueryContext(), (seed, _, context) =>
        {
            Seeded.RunOne(seed, random =>
            {
                var source = new RandomRays(random, checker.Oracle);
                for (var i = 0; i < raysPerSeed / 2; i++)
                {
                    var edgeRay = source.DrawAtEdge(random, checker.Oracle);
                    if (name == WithGaps)
                    {
                        checker.Check(edgeRay, context);
                    }
                    else
                    {
                        checker.CheckEdge(edgeRay, context);
                    }

                    var ray = source.Draw(random, checker.Oracle);
                    if (checker.Check(ray, context))
                    {
                        Interlocked.Increment(ref certain);
                    }

                    if (i % 5 == 0)
                    {
                        checker.CheckLimits(ray, context);
                    }
                }
            });
            return context;
        }, _ => { });
        Seeded.AssertMost(certain, rays / 2, 0.1);
    }
}
