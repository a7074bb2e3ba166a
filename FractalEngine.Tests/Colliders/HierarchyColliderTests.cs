using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Colliders;

/// <summary>The hierarchy against every triangle.</summary>
public class HierarchyColliderTests
{
    public static TheoryData<string> Meshes => CollisionMeshes.Names;

    [Theory]
    [MemberData(nameof(Meshes))]
    public void TryFindClosest_OnAnyMesh_EqualsTheSimpleCollider(string name) => Compare(CollisionMeshes.All[name](), 400);

    [Theory]
    [Trait("Category", "Soak")]
    [MemberData(nameof(Meshes))]
    public void TryFindClosest_OnAnyMeshManyTimes_EqualsTheSimpleCollider(string name) => Compare(CollisionMeshes.All[name](), 40_000);

    /// <summary>Sizes and places at which products of floats, and in the end of doubles, over- or underflow.</summary>
    [Theory]
    [InlineData(1e-300, 0)]
    [InlineData(1e-150, 0)]
    [InlineData(1e-60, 0)]
    [InlineData(1e-44, 0)]
    [InlineData(1e-38, 1e-20)]
    [InlineData(1e-9, 1)]
    [InlineData(1e-13, 1)]
    [InlineData(1, 1e9)]
    [InlineData(1, 1e14)]
    [InlineData(1e38, 0)]
    [InlineData(1e44, 0)]
    [InlineData(1e60, 0)]
    [InlineData(1e100, 0)]
    public void TryFindClosest_OfAnySizeAndPlace_EqualsTheSimpleCollider(double size, double offset)
    {
        var isInKernelsRange = size is >= 1e-30 and <= 1e30;
        var soup = CollisionMeshes.TriangleSoup(13, 300, 0.1);
        Compare(soup.Transform(v => (size * v) + (offset * new Vector(1, -0.7, 0.3))), 150, isInKernelsRange);
        Compare(CollisionMeshes.All["needles"]().Transform(v => (size * v) + (offset * Vector.One)), 150, isInKernelsRange);
    }

    /// <summary>A vertex that no face uses makes the box of the mesh a billion times as large as its faces.</summary>
    [Fact]
    public void TryFindClosest_BesideAnUnusedVertex_EqualsTheSimpleCollider()
    {
        var mesh = CollisionMeshes.TriangleSoup(14, 300, 0.1);
        Compare(new([.. mesh.Positions, 1e9, 1e9, 1e9], mesh.VertexIndices), 150);
    }

    [Theory]
    [MemberData(nameof(Meshes))]
    public void FindClosestTransformed_UnderAnyMap_EqualsTheSimpleCollider(string name)
    {
        var mesh = CollisionMeshes.All[name]();
        var simple = new SimpleCollider(mesh);
        var hierarchy = new HierarchyCollider(mesh);
        var context = new QueryContext();
        Seeded.Run(60, random =>
        {
            var linear = new Matrix(
                AdversarialTriangle.RandomInCube(random),
                AdversarialTriangle.RandomInCube(random),
                AdversarialTriangle.RandomInCube(random));
            var map = new AffineMap(linear, mesh.Bounds.Diagonal * AdversarialTriangle.RandomInCube(random));
            var position = map * CollisionMeshes.RandomPosition(random, mesh);
            Assert.True(simple.FindClosestTransformed(position, map, double.PositiveInfinity, 0, context, out var expected));
            Assert.True(hierarchy.FindClosestTransformed(position, map, double.PositiveInfinity, 0, context, out var actual));
            Assert.Equal((expected.Distance, expected.FaceIndex), (actual.Distance, actual.FaceIndex));
            Assert.True(hierarchy.FindClosestTransformed(position, map, expected.Distance, 0, context, out var within));
            Assert.Equal(expected.Distance, within.Distance);
        });
    }

    [Theory]
    [MemberData(nameof(Meshes))]
    public void TryFindClosest_WithEpsilonAndMaxDistance_FindsWhatIsWithinIt(string name)
    {
        var mesh = CollisionMeshes.All[name]();
        var simple = new SimpleCollider(mesh);
        var hierarchy = new HierarchyCollider(mesh);
        var context = new QueryContext();
        Seeded.Run(60, random =>
        {
            var position = CollisionMeshes.RandomPosition(random, mesh);
            Assert.True(simple.TryFindClosest(position, double.PositiveInfinity, context, out var expected));
            Assert.True(hierarchy.TryFindClosest(position, expected.Distance, context, out var closest, 0.1));
            Assert.Equal(expected.Distance, closest.Distance);
        });
    }

    [Theory]
    [InlineData("spaceship-interior", 20_000)]
    public void TryFindClosest_OnALargeMesh_EqualsTheSimpleCollider(string generator, int faces) =>
        Compare(MeshGenerators.Create(generator, 1, faces), 60);

    [Theory]
    [InlineData("tree-stump", 70_000)]
    [InlineData("terrain", 30_000)]
    [Trait("Category", "Soak")]
    public void TryFindClosest_OnALargeMeshInOtherCases_EqualsTheSimpleCollider(string generator, int faces) =>
        TryFindClosest_OnALargeMesh_EqualsTheSimpleCollider(generator, faces);

    [Theory]
    [MemberData(nameof(Meshes))]
    public void TryFindClosest_WithMaxDistance_FindsPointsUpToIt(string name)
    {
        var mesh = CollisionMeshes.All[name]();
        var simple = new SimpleCollider(mesh);
        var hierarchy = new HierarchyCollider(mesh);
        var context = new QueryContext();
        Seeded.Run(40, random =>
        {
            var position = CollisionMeshes.RandomPosition(random, mesh);
            Assert.True(simple.TryFindClosest(position, double.PositiveInfinity, context, out var expected));
            // On the surface nothing is below the distance.
            var below = Math.Max(0, Math.BitDecrement(expected.Distance));
            foreach (var maxDistance in
                new[] { 0, below, expected.Distance, Math.BitIncrement(expected.Distance), 2 * expected.Distance })
            {
                var isFound = hierarchy.TryFindClosest(position, maxDistance, context, out var closest);
                Assert.Equal((maxDistance, expected.Distance <= maxDistance), (maxDistance, isFound));
                Assert.True(!isFound || closest.Distance == expected.Distance);
            }
        });
    }

    [Theory]
    [MemberData(nameof(Meshes))]
    public void TryFindClosest_WithEpsilon_IsWithinTheFactor(string name)
    {
        var mesh = CollisionMeshes.All[name]();
        var simple = new SimpleCollider(mesh);
        var hierarchy = new HierarchyCollider(mesh);
        var context = new QueryContext();
        Seeded.Run(60, random =>
        {
            var position = CollisionMeshes.RandomPosition(random, mesh);
            var epsilon = random.Next(4) switch { 0 => 1e-6, 1 => 0.01, 2 => 1, _ => double.PositiveInfinity };
            Assert.True(simple.TryFindClosest(position, double.PositiveInfinity, context, out var expected));
            Assert.True(hierarchy.TryFindClosest(position, double.PositiveInfinity, context, out var closest, epsilon));
            Assert.True(closest.Distance >= expected.Distance);
            Assert.True(closest.Distance <= ((1 + epsilon) * expected.Distance) || expected.Distance == 0 || double.IsInfinity(epsilon),
                $"{closest.Distance}, exactly {expected.Distance}, ε {epsilon}");
        });
    }

    [Fact]
    public void TryFindClosest_WithEpsilon_CostsLess()
    {
        var mesh = MeshGenerators.Create("terrain", 1, 20_000);
        var exact = new QueryContext();
        var rough = new QueryContext();
        var hierarchy = new HierarchyCollider(mesh);
        Seeded.Run(200, random =>
        {
            var position = mesh.Bounds.Centre + (mesh.Bounds.Diagonal * AdversarialTriangle.RandomInCube(random));
            hierarchy.TryFindClosest(position, double.PositiveInfinity, exact, out _);
            hierarchy.TryFindClosest(position, double.PositiveInfinity, rough, out _, 0.1);
        });
        Assert.InRange(rough.Statistics.FaceTests, 1, exact.Statistics.FaceTests - 1);
    }

    [Fact]
    public void TryFindClosest_OnALargeMesh_TestsFewFaces()
    {
        var mesh = MeshGenerators.Create("icosphere", 1, 20_480);
        var context = new QueryContext();
        var hierarchy = new HierarchyCollider(mesh);
        Seeded.Run(200, random =>
        {
            var position = 1.05 * AdversarialTriangle.RandomInCube(random).UnitVector();
            hierarchy.TryFindClosest(position, double.PositiveInfinity, context, out _);
        });
        Assert.InRange(context.Statistics.FaceTests, 200, 200 * 60);
    }

    [Fact]
    public void TryFindClosest_OnTheEmptyMesh_FindsNothing()
    {
        var hierarchy = new HierarchyCollider(Mesh.Empty);
        Assert.False(hierarchy.TryFindClosest(Vector.One, double.PositiveInfinity, new(), out _));
        Assert.Equal(0, hierarchy.StorageBytes);
    }

    [Fact]
    public void TryFindClosest_OfInvalidArguments_Throws()
    {
        var hierarchy = new HierarchyCollider(CollisionMeshes.TriangleSoup(1, 10, 1));
        foreach (var bad in new[] { double.NaN, double.PositiveInfinity, double.NegativeInfinity })
        {
            Assert.Throws<ArgumentOutOfRangeException>(() => hierarchy.TryFindClosest(new(0, bad, 0), 1, new(), out _));
        }

        foreach (var bad in new[] { double.NaN, -1, double.NegativeInfinity })
        {
            Assert.Throws<ArgumentOutOfRangeException>(() => hierarchy.TryFindClosest(Vector.Zero, bad, new(), out _));
            Assert.Throws<ArgumentOutOfRangeException>(() => hierarchy.TryFindClosest(Vector.Zero, 1, new(), out _, bad));
        }
    }

    [Theory]
    [InlineData(8)]
    [InlineData(40)]
    [InlineData(2000)]
    public void TryFindClosest_AllocatesNothing(int faces)
    {
        var mesh = CollisionMeshes.TriangleSoup(1, faces, 0.1);
        var hierarchy = new HierarchyCollider(mesh);
        var context = new QueryContext();
        var random = new Random(1);
        var positions = Enumerable.Range(0, 200).Select(_ => CollisionMeshes.RandomPosition(random, mesh)).ToArray();
        var first = RunAllQueries();
        var last = 0.0;
        Assert.Equal(0, Allocation.Measure(() => last = RunAllQueries()));
        Assert.Equal(first, last);

        double RunAllQueries()
        {
            var distances = 0.0;
            foreach (var position in positions)
            {
                hierarchy.TryFindClosest(position, double.PositiveInfinity, context, out var closest);
                distances += closest.Distance;
            }

            return distances;
        }
    }

    [Theory]
    [InlineData(2000)]
    [InlineData(200_000)]
    public void StorageBytes_OfALargeMesh_IsBelow68AFace(int faces)
    {
        var mesh = MeshGenerators.Create("terrain", 1, faces);
        Assert.InRange(new HierarchyCollider(mesh).StorageBytes, 4L * mesh.FaceCount, 68L * mesh.FaceCount);
    }

    /// <summary>A mesh of the benchmarks and others, from positions that are hard to get right.</summary>
    [Theory]
    [InlineData("stump")]
    [InlineData("soup")]
    [InlineData("soup far away")]
    [InlineData("needles")]
    [InlineData("sphere")]
    [InlineData("knot")]
    [InlineData("terrain")]
    [InlineData("points")]
    public void TryFindClosest_WithinTheDistanceOrLittleLess_FindsOrMissesThePoint(string name)
    {
        var mesh = name == "stump" ? MeshGenerators.Create("tree-stump", 1, 3000) : CollisionMeshes.All[name]();
        var simple = new SimpleCollider(mesh);
        var hierarchy = new HierarchyCollider(mesh);
        var context = new QueryContext();
        Seeded.Run(300, random =>
        {
            var position = CollisionMeshes.RandomPosition(random, mesh);
            Assert.True(simple.TryFindClosest(position, double.PositiveInfinity, context, out var expected));
            Assert.True(hierarchy.TryFindClosest(position, double.PositiveInfinity, context, out var closest));
            // The kernel and the triangle are the same.
            Assert.Equal(expected.Distance, closest.Distance);
            var distance = expected.Distance;
            Ensure.That(hierarchy.TryFindClosest(position, distance, context, out _), $"nothing within {distance:R} of {position}");
            var isFoundCloser = hierarchy.TryFindClosest(position, distance * (1 - 1e-12), context, out _);
            Ensure.That(!isFoundCloser || !(distance > 0), $"within less than {distance:R} of {position}");
        });
    }

    /// <summary>Compares the hierarchy with every triangle.</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="queries">Number of random positions.</param>
    /// <param name="isInKernelsRange">False where products of coordinates over- or underflow: there the kernel is inaccurate.</param>
    private static void Compare(Mesh mesh, int queries, bool isInKernelsRange = true)
    {
        var simple = new SimpleCollider(mesh);
        var hierarchy = new HierarchyCollider(mesh);
        var context = new QueryContext();
        Seeded.Run(queries, random =>
        {
            var position = CollisionMeshes.RandomPosition(random, mesh);
            Assert.True(simple.TryFindClosest(position, double.PositiveInfinity, context, out var expected));
            Assert.True(hierarchy.TryFindClosest(position, double.PositiveInfinity, context, out var actual));
            // The kernel and the triangle are the same, and so are the bits; of triangles equally close the first is right.
            Ensure.That(
                (expected.Distance, expected.FaceIndex) == (actual.Distance, actual.FaceIndex),
                $"{position}: {actual.Distance:R} at face {actual.FaceIndex}, not {expected.Distance:R} at face {expected.FaceIndex}");
            Assert.True(!isInKernelsRange || Math.Abs(actual.Distance - (position - actual.Point).Length())
                <= 1e-12 * (position.MaxAbsComponent() + mesh.Bounds.Diagonal));
        });
    }
}
