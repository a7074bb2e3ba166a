using System.Runtime.CompilerServices;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Colliders;

namespace FractalEngine.Tests.Queries;

/// <summary>Batches of queries against single queries.</summary>
public class BatchQueryTests
{
    private static readonly HierarchyCollider Collider = new(CollisionMeshes.TriangleSoup(1, 2000, 0.1));

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(256)]
    [InlineData(257)]
    [InlineData(5001)]
    public void Run_OnAnyNumberOfThreads_EqualsSingleQueries(int count)
    {
        var positions = RandomPositions(count);
        var expected = new (bool, ClosestPoint, int)[count];
        var sum = new QueryContext();
        for (var i = 0; i < count; i++)
        {
            expected[i] = Find(positions[i], sum);
        }

        foreach (var threads in new int?[] { null, 1, 2, 7 })
        {
            var context = new QueryContext();
            context.Statistics.FaceTests = 1000;
            Assert.Equal(expected, BatchQuery.Run(positions, Find, context, threads));
            Assert.Equal(
                (1000 + sum.Statistics.FaceTests, sum.Statistics.BoundTests),
                (context.Statistics.FaceTests, context.Statistics.BoundTests));
        }

        Assert.True(count < 256 || (expected.Any(result => result.Item1) && expected.Any(result => !result.Item1)));

        static (bool, ClosestPoint, int) Find(Vector position, QueryContext context)
        {
            var isFound = Collider.TryFindClosest(position, 0.3, context, out var closest);
            return (isFound, closest, context.ObjectIndex);
        }
    }

    [Fact]
    public void Run_OfManyPositions_AllocatesTheAnswersOnly()
    {
        var few = RandomPositions(1000);
        var many = RandomPositions(20_000);
        MeasureAllocation(few);
        // The tolerance is what starting threads takes; a byte a position would be more. One thread, so that it is the one measured.
        var expected = (many.Length - few.Length) * Unsafe.SizeOf<ClosestPoint>();
        Assert.InRange(MeasureAllocation(many) - MeasureAllocation(few) - expected, -10_000, 10_000);

        static long MeasureAllocation(Vector[] positions)
        {
            var before = GC.GetAllocatedBytesForCurrentThread();
            BatchQuery.Run(positions, Find, threads: 1);
            return GC.GetAllocatedBytesForCurrentThread() - before;
        }

        static ClosestPoint Find(Vector position, QueryContext context)
        {
            Collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest);
            return closest;
        }
    }

    [Fact]
    public void Run_OfBadArguments_ThrowsWhatTheQuestionThrowsAlone()
    {
        var positions = new Vector[3];
        Assert.Throws<ArgumentOutOfRangeException>("threads", () => BatchQuery.Run(positions, FindClosest, threads: 0));
        Assert.Throws<ArgumentNullException>("inputs", () => BatchQuery.Run<Vector, ClosestHit>(null!, FindClosest));
        Assert.Throws<ArgumentNullException>("ask", () => BatchQuery.Run<Vector, ClosestHit>(positions, null!));
        positions[2] = new(0, double.NaN, 0);
        var alone = Assert.Throws<ArgumentOutOfRangeException>("position", () => Collider.FindClosest(positions[2]));
        var error = Assert.Throws<ArgumentOutOfRangeException>("position", () => BatchQuery.Run(positions, FindClosest));
        Assert.Equal(alone.Message, error.Message);

        static ClosestHit FindClosest(Vector position, QueryContext context) => Collider.FindClosest(position, context);
    }

    private static Vector[] RandomPositions(int count)
    {
        var random = new Random(count);
        return [.. Enumerable.Range(0, count).Select(_ => 1.5 * AdversarialTriangle.RandomInCube(random))];
    }
}
