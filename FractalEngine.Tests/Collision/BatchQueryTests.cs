using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Collision;

public class BatchQueryTests
{
    private static readonly HierarchyCollider Collider = new(CollisionMeshes.TriangleSoup(1, 2000, 0.1));

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(256)]
    [InlineData(5001)]
    public void FindClosest_OnAnyNumberOfThreads_EqualsSingleQueries(int count)
    {
        var positions = Positions(count);
        var (expected, sum) = (new BatchResult[count], new QueryContext());
        for (var i = 0; i < count; i++)
        {
            var context = new QueryContext();
            var isFound = Collider.TryFindClosest(positions[i], 0.3, context, out var closest);
            expected[i] = new(isFound, closest, context.Statistics.FaceTests, context.Statistics.BoundTests);
            sum.Statistics.FaceTests += context.Statistics.FaceTests;
            sum.Statistics.BoundTests += context.Statistics.BoundTests;
        }

        foreach (var threads in new int?[] { null, 1, 2, 7 })
        {
            var (results, context) = (new BatchResult[count], new QueryContext());
            BatchQuery.FindClosest(Collider, positions, results, context, maxDistance: 0.3, threads: threads);
            Assert.Equal(expected, results);
            Assert.Equal((sum.Statistics.FaceTests, sum.Statistics.BoundTests), (context.Statistics.FaceTests, context.Statistics.BoundTests));
        }

        Assert.True(count < 256 || (expected.Any(result => result.IsFound) && expected.Any(result => !result.IsFound)));
    }

    [Fact]
    public void FindClosest_OfManyPositions_AllocatesNoMoreThanOfFew()
    {
        var (few, many) = (Positions(1000), Positions(20_000));
        var (results, context) = (new BatchResult[many.Length], new QueryContext());
        Allocated(few);
        // What starts the threads; a byte a position would be more. One thread, so that it is the one that is measured.
        Assert.InRange(Allocated(many) - Allocated(few), -10_000, 10_000);

        long Allocated(Vector[] positions)
        {
            var before = GC.GetAllocatedBytesForCurrentThread();
            BatchQuery.FindClosest(Collider, positions, results.AsMemory(0, positions.Length), context, threads: 1);
            return GC.GetAllocatedBytesForCurrentThread() - before;
        }
    }

    [Fact]
    public void FindClosest_OfBadArguments_Throws()
    {
        var (results, context) = (new BatchResult[3], new QueryContext());
        var positions = new Vector[3];
        Assert.Throws<ArgumentException>("results", () => BatchQuery.FindClosest(Collider, positions, results.AsMemory(1), context));
        Assert.Throws<ArgumentOutOfRangeException>("maxDistance",
            () => BatchQuery.FindClosest(Collider, positions, results, context, maxDistance: -1));
        Assert.Throws<ArgumentOutOfRangeException>("epsilon",
            () => BatchQuery.FindClosest(Collider, positions, results, context, epsilon: double.NaN));
        Assert.Throws<ArgumentOutOfRangeException>("threads",
            () => BatchQuery.FindClosest(Collider, positions, results, context, threads: 0));
        positions[2] = new(0, double.NaN, 0);
        var error =
            Assert.Throws<ArgumentOutOfRangeException>("positions", () => BatchQuery.FindClosest(Collider, positions, results, context));
        Assert.StartsWith("expected finite coordinates at index 2", error.Message, StringComparison.Ordinal);
    }

    private static Vector[] Positions(int count) => new Random(count) switch
    {
        var random => [.. Enumerable.Range(0, count).Select(_ => 1.5 * AdversarialTriangle.RandomInCube(random))],
    };
}
