using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Collision.Fractals;

/// <summary>Low levels that are searched as meshes, and which are.</summary>
public class ExpandedLevelsTests
{
    // docs/colliders.md: whatever the depth, for sets of up to 100 maps.
    private const long MaxColliderBytes = 256 * 1024;

    [Theory]
    [InlineData("shell")]
    [InlineData("tree")]
    [InlineData("tree-leaves")]
    public void For_ABaseWithAHierarchy_SelectsLevels(string name)
    {
        var fractal = AssetFractals.Load(name);
        Assert.InRange(Select(fractal).StorageBytes, 10_000, MaxColliderBytes);
        Assert.InRange(new ExactFractalCollider(fractal).StorageBytes, 10_000, MaxColliderBytes);
    }

    /// <summary>A small base, skewed maps, too many levels, too many faces: these are searched level by level.</summary>
    [Theory]
    [InlineData("menger", 4)]
    [InlineData("fern", 3)]
    [InlineData("terrain", 6)]
    [InlineData("tree", 65)]
    [InlineData("tree", null)]
    [InlineData("tree", 10)]
    public void For_OthersAndWhereLittleIsSaved_SelectsNone(string name, int? depth)
    {
        var fractal = AssetFractals.Load(name, depth);
        Assert.Same(ExpandedLevels.None, Select(fractal));
    }

    [Theory]
    [InlineData("shell")]
    [InlineData("tree")]
    [InlineData("tree-leaves")]
    public void For_TwoFractalsOfTheSameSteps_SelectsTheSame(string name)
    {
        var fractal = AssetFractals.Load(name);
        var other = new Fractal(fractal.Description, fractal.BaseMesh);
        var (levels1, levels2) = (Select(fractal), Select(other));
        Assert.Equal(levels1.Count, levels2.Count);
        Assert.All(Enumerable.Range(0, levels1.Count), level => Assert.Equal(
            levels1.At(level)?.Bvh.FaceCount, levels2.At(level)?.Bvh.FaceCount));
        Assert.Same(levels1, Select(fractal));
    }

    [Theory]
    [InlineData("shell", null)]
    [InlineData("tree", 5)]
    [InlineData("tree-leaves", 5)]
    public void TryFindClosest_WithExpandedLevels_EqualsTheExpansionAndNamesTheInstance(string name, int? depth)
    {
        var fractal = depth is null ? AssetFractals.Load(name) : AssetFractals.Load(name, depth);
        CheckAgainstTheExpansion(name, fractal, 300);
    }

    /// <summary>The identity makes children skip levels, so that paths to instances have several lengths.</summary>
    [Fact]
    public void TryFindClosest_WithIdentitiesAboveALargeBase_EqualsTheExpansionAndNamesTheInstance() => Seeded.Run(20, random =>
    {
        var mesh = MeshGenerators.Create("icosphere", 1, 80);
        var maps = Enumerable.Range(0, random.Next(1, 4)).Select(_ => RandomSimilarity(random)).Append(Transformation.Identity);
        CheckAgainstTheExpansion("identities", Fractal.Of(mesh).Repeat(maps, random.Next(1, 5)), 30);
    });

    private static void CheckAgainstTheExpansion(string name, Fractal fractal, int queries)
    {
        var checker = new ExactColliderChecker(name, fractal);
        var hierarchy = new HierarchyCollider(FractalGenerator.Flatten(fractal, 1_000_000));
        var random = new Random(3);
        var context = new QueryContext();
        var box = fractal.Bounds;
        for (var i = 0; i < queries; i++)
        {
            var inUnitCube = new Vector(random.NextDouble(), random.NextDouble(), random.NextDouble());
            var position = box.Centre + (1.2 * box.Size.Stretch(inUnitCube - (0.5 * Vector.One)));
            checker.CheckQuery(position, context, hierarchy.FindClosest(position).Distance);
        }
    }

    private static Transformation RandomSimilarity(Random random)
    {
        double Next(double range) => range * ((2 * random.NextDouble()) - 1);
        return new(
            new(Next(2), Next(2), Next(2)), new(Next(180), Next(180), Next(180)), (0.3 + (0.4 * random.NextDouble())) * Vector.One);
    }

    private static ExpandedLevels Select(Fractal fractal) =>
        ExpandedLevels.For(fractal.Hierarchy, TriangleBvh.For(fractal.BaseMesh));
}
