using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Colliders;

/// <summary>The paper's octree: its exact costs, and how it errs.</summary>
public class BoundingBoxColliderTests
{
    public static TheoryData<string> Meshes => CollisionMeshes.Names;

    // Figures 17 and 18, whose depths are not whole: whole levels are within half a level of these.
    [Theory]
    [InlineData(277_654, 1736)]
    [InlineData(237_664, 1714)]
    [InlineData(168_070, 1666)]
    [InlineData(1_176_490, 1936)]
    [InlineData(38_400_000, 2419)]
    public void DefaultDepth_TimesTheCostPerLevel_IsThePapersCostToHalfALevel(int faces, int cost) =>
        Assert.InRange(BoundingBoxCollider.CostPerLevel * BoundingBoxCollider.DefaultDepth(faces), cost - 48, cost + 48);

    [Theory]
    [MemberData(nameof(Meshes))]
    public void TryFindClosest_OnAnyMesh_FindsAFaceNoCloserThanTheClosest(string name)
    {
        var mesh = CollisionMeshes.All[name]();
        var simple = new SimpleCollider(mesh);
        var boxes = new BoundingBoxCollider(mesh);
        var context = new QueryContext();
        Seeded.Run(100, random =>
        {
            var position = CollisionMeshes.RandomPosition(random, mesh);
            Assert.True(simple.TryFindClosest(position, double.PositiveInfinity, context, out var expected));
            Assert.True(boxes.TryFindClosest(position, double.PositiveInfinity, context, out var closest));
            Assert.True(closest.Distance >= expected.Distance);
            Assert.Equal(expected.Distance <= closest.Distance, boxes.TryFindClosest(position, closest.Distance, context, out _));
        });
        Assert.False(boxes.IsExact);
    }

    [Fact]
    public void TryFindClosest_OfDepthZero_IsExact()
    {
        var mesh = CollisionMeshes.TriangleSoup(1, 50, 0.5);
        var simple = new SimpleCollider(mesh);
        var boxes = new BoundingBoxCollider(mesh, depth: 0);
        var context = new QueryContext();
        Seeded.Run(100, random =>
        {
            var position = CollisionMeshes.RandomPosition(random, mesh);
            simple.TryFindClosest(position, double.PositiveInfinity, context, out var expected);
            boxes.TryFindClosest(position, double.PositiveInfinity, context, out var closest);
            // The collider promises nothing at other depths, so its error bound is the distance.
            Assert.Equal(expected with { ErrorBound = closest.Distance }, closest);
        });
        context.Statistics.Reset();
        boxes.TryFindClosest(Vector.Zero, 1, context, out _);
        Assert.Equal((50, 0), (context.Statistics.FaceTests, context.Statistics.BoundTests));
    }

    [Fact]
    public void TryFindClosest_OnASphere_CountsTwelveFacesForEachOfEightBoxesALevelAndTheLeaf()
    {
        var context = new QueryContext();
        var boxes = new BoundingBoxCollider(MeshGenerators.Create("icosphere", 1, 1280));
        Assert.Equal(10, boxes.Depth);
        boxes.TryFindClosest(2 * Vector.One, double.PositiveInfinity, context, out _);
        // The leaf has one face, since no two faces of the sphere share a centroid.
        Assert.Equal((8 * 12 * 10) + 1, context.Statistics.FaceTests);
        Assert.InRange(context.Statistics.BoundTests, 4, 8 * 10);
    }

    [Fact]
    public void TryFindClosest_OnATerrain_OftenMissesTheClosestFace()
    {
        var mesh = MeshGenerators.Create("terrain", 1, 5000);
        var simple = new SimpleCollider(mesh);
        var boxes = new BoundingBoxCollider(mesh);
        var context = new QueryContext();
        var missed = 0;
        Seeded.Run(200, random =>
        {
            var position = CollisionMeshes.RandomPosition(random, mesh);
            simple.TryFindClosest(position, double.PositiveInfinity, context, out var expected);
            boxes.TryFindClosest(position, double.PositiveInfinity, context, out var closest);
            missed += closest.Distance > expected.Distance + 1e-9 ? 1 : 0;
        });
        // The paper's octree misses faces, which is why it is not labelled exact.
        Assert.InRange(missed, 20, 200);
    }

    [Fact]
    public void TryFindClosest_WhereTheBoxOfThePositionIsEmpty_TakesTheClosestOccupiedBox()
    {
        // Two faces are in opposite corners; six of eight boxes are empty.
        var mesh = new Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9, 10, 9, 9, 9, 10, 9], [0, 1, 2, 3, 4, 5]);
        var boxes = new BoundingBoxCollider(mesh, depth: 3);
        Assert.True(boxes.TryFindClosest(new(9, 0, 0), double.PositiveInfinity, new(), out var closest));
        Assert.Equal(0, closest.FaceIndex);
    }

    [Fact]
    public void TryFindClosest_OnTheEmptyMesh_FindsNothing() =>
        Assert.False(new BoundingBoxCollider(Mesh.Empty).TryFindClosest(Vector.One, double.PositiveInfinity, new(), out _));

    [Theory]
    [InlineData(-1)]
    [InlineData(65)]
    public void Constructor_OfADepthOutOfRange_Throws(int depth) =>
        Assert.Throws<ArgumentOutOfRangeException>(nameof(depth), () => new BoundingBoxCollider(Mesh.Empty, depth));

    [Fact]
    public void TryFindClosest_AllocatesNothing()
    {
        var boxes = new BoundingBoxCollider(CollisionMeshes.TriangleSoup(1, 500, 0.1));
        var context = new QueryContext();
        Assert.Equal(0, Allocation.Measure(() =>
        {
            for (var i = 0; i < 100; i++)
            {
                boxes.TryFindClosest(new(i / 50.0, 0.3, 0.2), double.PositiveInfinity, context, out _);
            }
        }));
    }
}
