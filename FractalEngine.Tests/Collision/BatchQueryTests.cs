using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Collision;

public class BatchQueryTests
{
    private static readonly HierarchyCollider Collider = new(CollisionMeshes.Soup(1, 2000, 0.1));

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(256)]
    [InlineData(5001)]
    public void FindClosest_OnAnyNumberOfThreads_AnswersAsOneByOne(int count)
    {
        var positions = Positions(count);
        var (expected, sum) = (new BatchResult[count], new QueryContext());
        for (var i = 0; i < count; i++)
        {
            var record = new QueryContext();
            var isFound = Collider.TryFindClosest(positions[i], 0.3, record, out var closest);
            expected[i] = new(isFound, closest, record.FaceTests, record.BoundTests);
            sum.FaceTests += record.FaceTests;
            sum.BoundTests += record.BoundTests;
        }

        foreach (var threads in new int?[] { null, 1, 2, 7 })
        {
            var (answers, record) = (new BatchResult[count], new QueryContext());
            BatchQuery.FindClosest(Collider, positions, answers, record, maxDistance: 0.3, threads: threads);
            Assert.Equal(expected, answers);
            Assert.Equal((sum.FaceTests, sum.BoundTests), (record.FaceTests, record.BoundTests));
        }

        Assert.True(count < 256 || (expected.Any(answer => answer.IsFound) && expected.Any(answer => !answer.IsFound)));
    }

    [Fact]
    public void FindClosest_OfManyPositions_AllocatesNoMoreThanOfFew()
    {
        var (few, many) = (Positions(1000), Positions(20_000));
        var (answers, record) = (new BatchResult[many.Length], new QueryContext());
        Allocated(few);
        // What starts the threads; a byte a position would be more. One thread, so that it is the one that is measured.
        Assert.InRange(Allocated(many) - Allocated(few), -10_000, 10_000);

        long Allocated(Vector[] positions)
        {
            var before = GC.GetAllocatedBytesForCurrentThread();
            BatchQuery.FindClosest(Collider, positions, answers.AsMemory(0, positions.Length), record, threads: 1);
            return GC.GetAllocatedBytesForCurrentThread() - before;
        }
    }

    [Fact]
    public void FindClosest_OfBadArguments_Throws()
    {
        var (answers, record) = (new BatchResult[3], new QueryContext());
        var positions = new Vector[3];
        Assert.Throws<ArgumentException>("results", () => BatchQuery.FindClosest(Collider, positions, answers.AsMemory(1), record));
        Assert.Throws<ArgumentOutOfRangeException>("maxDistance",
            () => BatchQuery.FindClosest(Collider, positions, answers, record, maxDistance: -1));
        Assert.Throws<ArgumentOutOfRangeException>("epsilon",
            () => BatchQuery.FindClosest(Collider, positions, answers, record, epsilon: double.NaN));
        Assert.Throws<ArgumentOutOfRangeException>("threads",
            () => BatchQuery.FindClosest(Collider, positions, answers, record, threads: 0));
        positions[2] = new(0, double.NaN, 0);
        var error =
            Assert.Throws<ArgumentOutOfRangeException>("positions", () => BatchQuery.FindClosest(Collider, positions, answers, record));
        Assert.StartsWith("expected finite coordinates at index 2", error.Message, StringComparison.Ordinal);
    }

    private static Vector[] Positions(int count) => new Random(count) switch
    {
        var random => [.. Enumerable.Range(0, count).Select(_ => 1.5 * NastyFace.Cube(random))],
    };
}
