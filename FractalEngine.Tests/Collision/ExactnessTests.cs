using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Collision;

/// <summary>
/// Exact colliders against every face, on the fractals of the assets and on meshes, from positions that are hard to get right.
/// </summary>
public class ExactnessTests
{
    private const int SoakQueries = 1_900_000;

    /// <summary>Asset and depth: up to 300,000 faces.</summary>
    public static TheoryData<string, int> Expanded => new()
    {
        { "sierpinski", 4 }, { "tetrahedron", 5 }, { "menger", 2 }, { "appendix-b", 2 }, { "appendix-b-structure", 2 }, { "diamond", 2 },
        { "fern", 2 }, { "romanesco", 2 }, { "shell", 0 }, { "snowflake", 3 }, { "terrain", 5 }, { "tree", 4 }, { "tree-leaves", 4 },
        { "googol", 3 },
    };

    /// <summary>The same, deeper.</summary>
    public static TheoryData<string, int> ExpandedForSoak => new()
    {
        { "sierpinski", 5 }, { "tetrahedron", 7 }, { "menger", 3 }, { "appendix-b", 3 }, { "appendix-b-structure", 3 }, { "diamond", 2 },
        { "fern", 2 }, { "romanesco", 2 }, { "shell", 0 }, { "snowflake", 4 }, { "terrain", 7 }, { "tree", 6 }, { "tree-leaves", 5 },
        { "googol", 4 },
        { "sierpinski", 2 }, { "menger", 1 }, { "fern", 1 }, { "terrain", 3 }, { "tree", 2 },
    };

    public static TheoryData<string> MeshNames => ["stump", "soup", "soup far away", "needles", "sphere", "knot", "terrain", "points"];

    [Theory]
    [MemberData(nameof(Expanded))]
    public void TryFindClosest_OnAnAsset_EqualsEveryFace(string name, int depth)
    {
        var (probe, oracle, simple) = Load(name, depth);
        var context = new QueryContext();
        Seeded.Run(300, random =>
        {
            var position = FractalPositions.RandomPosition(random, probe.Fractal);
            var expected = oracle.ClosestDistance(position, context);
            if (random.Next(30) == 0)
            {
                probe.ThrowUnless(expected == simple.ClosestDistance(position, context), position,
                    $"the oracle says {expected:R}, not as every face does");
            }

            var closest = probe.CheckQuery(position, context, expected);
            probe.CheckMaxDistance(position, context, closest.Distance);
        });
    }

    [Theory]
    [MemberData(nameof(ExpandedForSoak))]
    [Trait("Category", "Soak")]
    public void TryFindClosest_OnAnAssetForLong_EqualsEveryFace(string name, int depth)
    {
        var (probe, oracle, simple) = Load(name, depth);
        Parallel.For(1, 1 + (SoakQueries / ExpandedForSoak.Count / 100), () => new QueryContext(), (seed, _, context) =>
        {
            Seeded.RunOne(seed, random =>
            {
                for (var query = 0; query < 100; query++)
                {
                    var position = FractalPositions.RandomPosition(random, probe.Fractal);
                    var expected = oracle.ClosestDistance(position, context);
                    var closest = probe.CheckQuery(position, context, expected);
                    if (query % 8 == 0)
                    {
                        probe.CheckMaxDistance(position, context, closest.Distance);
                    }
                }

                if (seed % 50 == 0)
                {
                    var position = FractalPositions.RandomPosition(random, probe.Fractal);
                    var expected = oracle.ClosestDistance(position, context);
                    probe.ThrowUnless(expected == simple.ClosestDistance(position, context), position,
                        $"the oracle says {expected:R}, not as every face does");
                }
            });
            return context;
        }, _ => { });
    }

    [Theory]
    [MemberData(nameof(MeshNames))]
    public void TryFindClosest_OnAMesh_EqualsEveryFace(string name)
    {
        var mesh = name == "stump" ? MeshGenerators.Create("tree-stump", 1, 3000) : CollisionMeshes.All[name]();
        var (hierarchy, simple, context) = (new HierarchyCollider(mesh), new SimpleCollider(mesh), new QueryContext());
        // On the surface nothing can be closer, and of a mesh of one point all positions are that.
        var minShare = mesh.Bounds.Diagonal == 0 ? 0 : 0.5;
        Seeded.RunMost(300, random =>
        {
            var position = CollisionMeshes.RandomPosition(random, mesh);
            Assert.True(hierarchy.TryFindClosest(position, double.PositiveInfinity, context, out var closest));
            var expected = simple.ClosestDistance(position, context);
            // The same kernel on the same face.
            Assert.Equal(expected, closest.Distance);
            Assert.True(hierarchy.TryFindClosest(position, expected, context, out _), $"nothing within {expected:R} of {position}");
            if (expected == 0)
            {
                return false;
            }

            Assert.False(hierarchy.TryFindClosest(position, expected * (1 - 1e-12), context, out _),
                $"within less than {expected:R} of {position}");
            return true;
        }, minShare);
    }

    private static (ExactColliderChecker Probe, Collider Oracle, Collider Simple) Load(string name, int depth)
    {
        var asset = AssetFractals.Load(name);
        var fractal = asset.Description.HasDepth ? asset.WithDepth(depth) : asset;
        Assert.True(fractal.InstanceCount > 0, name);
        // Copies that the identity makes many times over count here, but are one in the mesh.
        var mesh = FractalGenerator.Flatten(fractal, 4_000_000);
        Assert.InRange(mesh.FaceCount, 1, 300_000);
        return (new($"{name} of depth {depth}", fractal), new HierarchyCollider(mesh), new SimpleCollider(mesh));
    }
}
