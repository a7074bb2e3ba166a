using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Tests.Colliders;

namespace FractalEngine.Tests.SceneQueries;

/// <summary>Batches of queries against single queries.</summary>
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
        var positions = RandomPositions(count);
        var expected = new BatchResult[count];
        var sum = new QueryContext();
        for (var i = 0; i < count; i++)
        {
            var context = new QueryContext();
            var isFound = Collider.TryFindClosest(positions[i], 0.3, context, out var closest);
            expected[i] = new(isFound, closest, context.Statistics.FaceTests, context.Statistics.BoundTests, isFound ? 0 : -1);
            sum.Statistics.FaceTests += context.Statistics.FaceTests;
            sum.Statistics.BoundTests += context.Statistics.BoundTests;
        }

        foreach (var threads in new int?[] { null, 1, 2, 7 })
        {
            var results = new BatchResult[count];
            var context = new QueryContext();
            BatchQuery.FindClosest(Collider, positions, results, context, maxDistance: 0.3, threads: threads);
            Assert.Equal(expected, results);
            Assert.Equal(sum.Statistics.FaceTests, context.Statistics.FaceTests);
            Assert.Equal(sum.Statistics.BoundTests, context.Statistics.BoundTests);
        }

        Assert.True(count < 256 || (expected.Any(result => result.IsFound) && expected.Any(result => !result.IsFound)));
    }

    [Fact]
    public void FindClosest_OfManyPositions_AllocatesNoMoreThanOfFew()
    {
        var few = RandomPositions(1000);
        var many = RandomPositions(20_000);
        var results = new BatchResult[many.Length];
        var context = new QueryContext();
        MeasureAllocation(few);
        // The tolerance is what starting threads takes; a byte a position would be more. One thread, so that it is the one measured.
        Assert.InRange(MeasureAllocation(many) - MeasureAllocation(few), -10_000, 10_000);

        long MeasureAllocation(Vector[] positions)
        {
            var before = GC.GetAllocatedBytesForCurrentThread();
            BatchQuery.FindClosest(Collider, positions, results.AsMemory(0, positions.Length), context, threads: 1);
            return GC.GetAllocatedBytesForCurrentThread() - before;
        }
    }

    [Fact]
    public void FindClosest_OfBadArguments_Throws()
    {
        var results = new BatchResult[3];
        var context = new QueryContext();
        var positions = new Vector[3];
        Assert.Throws<ArgumentException>("results", () => BatchQuery.FindClosest(Collider, positions, results.AsMemory(1), context));
        Assert.Throws<ArgumentOutOfRangeException>("maxDistance",
            () => BatchQuery.FindClosest(Collider, positions, results, context, maxDistance: -1));
        Assert.Throws<ArgumentOutOfRangeException>("epsilon",
            () => BatchQuery.FindClosest(Collider, positions, results, context, epsilon: double.NaN));
        Assert.Throws<ArgumentOutOfRangeException>("threads",
            () => BatchQuery.FindClosest(Collider, positions, results, context, threads: 0));
        positions[2] = new(0, double.NaN, 0);
        var error = Assert.Throws<ArgumentOutOfRangeException>(
            "positions", () => BatchQuery.FindClosest(Collider, positions, results, context));
        Assert.StartsWith("expected finite coordinates at index 2", error.Message, StringComparison.Ordinal);
    }

    private static Vector[] RandomPositions(int count)
    {
        var random = new Random(count);
        return [.. Enumerable.Range(0, count).Select(_ => 1.5 * AdversarialTriangle.RandomInCube(random))];
    }
}
