using FractalEngine.Core.Bvh;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Queries.Closest;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Queries.Closest;

/// <summary>Low levels that are searched as meshes, and which are.</summary>
public class ExpandedLevelsTests
{
    // docs/colliders.md: whatever the depth, for sets of up to 100 maps.
    private const long MaxColliderBytes = 256 * 1024;

    [Fact]
    public void For_ALargeBaseWithCloseInstances_SelectsLevels()
    {
        foreach (var fractal in Selected)
        {
            Assert.InRange(Select(fractal).StorageBytes, 10_000, MaxColliderBytes);
            Assert.InRange(new ExactFractalCollider(fractal).StorageBytes, 10_000, MaxColliderBytes);
        }
    }

    /// <summary>Small bases, skewed maps, too many levels, and where little is saved: these are searched level by level.</summary>
    [Theory]
    [InlineData("menger", 4, 0)]
    [InlineData("tree", 7, 0)]
    [InlineData("fern", 3, 80)]
    [InlineData("tree", 65, 80)]
    [InlineData("tree", null, 80)]
    [InlineData("tetrahedron", 5, 80)]
    public void For_Others_SelectsNone(string name, int? depth, int baseFaces)
    {
        var fractal = AssetFractals.Load(name, depth);
        fractal = baseFaces == 0 ? fractal : OfSphere(fractal, baseFaces);
        Assert.Same(ExpandedLevels.None, Select(fractal));
    }

    [Fact]
    public void For_TwoFractalsOfTheSameSteps_SelectsTheSame()
    {
        foreach (var fractal in Selected)
        {
            var other = new Fractal(fractal.Description, fractal.BaseMesh);
            var (levels1, levels2) = (Select(fractal), Select(other));
            Assert.Equal(levels1.Count, levels2.Count);
            Assert.All(Enumerable.Range(0, levels1.Count), level => Assert.Equal(
                levels1.At(level)?.Bvh.Mesh.FaceCount, levels2.At(level)?.Bvh.Mesh.FaceCount));
            Assert.Same(levels1, Select(fractal));
        }
    }

    [Fact]
    public void TryFindClosest_WithExpandedLevels_EqualsTheExpansionAndNamesTheInstance()
    {
        foreach (var fractal in Selected)
        {
            CheckAgainstTheExpansion("expanded", fractal, 300);
        }
    }

    /// <summary>The identity makes children skip levels, so that paths to instances have several lengths.</summary>
    [Fact]
    public void TryFindClosest_WithIdentitiesAboveALargeBase_EqualsTheExpansionAndNamesTheInstance() => Seeded.Run(20, random =>
    {
        var mesh = MeshGenerators.Create("icosphere", 1, 80);
        var maps = Enumerable.Range(0, random.Next(1, 4)).Select(_ => RandomSimilarity(random)).Append(Transformation.Identity);
        CheckAgainstTheExpansion("identities", Fractal.Of(mesh).Repeat(maps, random.Next(1, 5)), 30);
    });

    private static Fractal[] Selected => [OldForms.Load("shell"), OfSphere(AssetFractals.Load("snowflake", 3), 80)];

    private static Fractal OfSphere(Fractal fractal, int faces) =>
        new(fractal.Description, MeshGenerators.Create("icosphere", 1, faces));

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
