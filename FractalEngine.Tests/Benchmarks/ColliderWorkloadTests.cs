using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Collision;

namespace FractalEngine.Tests.Benchmarks;

public class ColliderWorkloadTests
{
    [Fact]
    public void Counts_AreMeansOfTheQueriesAndDoNotGrowWithRounds()
    {
        var mesh = CollisionMeshes.TriangleSoup(1, 300, 0.1);
        var (hierarchy, context, random) = (new HierarchyCollider(mesh), new QueryContext(), new Random(1));
        Vector[] positions = [.. Enumerable.Range(0, 100).Select(_ => CollisionMeshes.RandomPosition(random, mesh))];
        var workload = new ColliderWorkload(hierarchy, positions);
        workload.RunQueries();
        workload.RunQueries();
        foreach (var position in positions)
        {
            hierarchy.TryFindClosest(position, double.PositiveInfinity, context, out _);
        }

        Assert.Equal((context.FaceTests / 100.0, context.BoundTests / 100.0, hierarchy.StorageBytes),
            (workload.FaceTests, workload.BoundTests, workload.StorageBytes));
        Assert.Equal(300, new ColliderWorkload(new SimpleCollider(mesh), positions).FaceTests);
    }

    [Fact]
    public void MicrosecondsPerQuery_OfMoreFaces_AreMore()
    {
        var (small, large) = (CreateWorkload(20), CreateWorkload(20_000));
        Assert.Equal(double.PositiveInfinity, small.MicrosecondsPerQuery);
        for (var round = 0; round < 3; round++)
        {
            small.RunQueries();
            large.RunQueries();
        }

        // A thousand times the work; that of a call is below a microsecond.
        Assert.InRange(small.MicrosecondsPerQuery, 0.01, 1000);
        Assert.InRange(large.MicrosecondsPerQuery / small.MicrosecondsPerQuery, 10, 100_000);
    }

    [Fact]
    public void InterleavedTiming_OfActions_RunsEachOnceARoundAndKeepsTheBest()
    {
        var calls = new List<int>();
        var best = InterleavedTiming.MeasureBestSeconds([() => calls.Add(0), () => Wait(1, calls.Count < 4 ? 300 : 10)], 3);
        Assert.Equal([0, 1, 0, 1, 0, 1], calls);
        // The last round waits for 10 ms, those before for more; a timer may be a little early.
        Assert.InRange(best[1], 0.005, 0.29);
        Assert.True(best[0] < best[1]);

        void Wait(int action, int milliseconds)
        {
            calls.Add(action);
            Thread.Sleep(milliseconds);
        }
    }

    private static ColliderWorkload CreateWorkload(int faces) =>
        new(new SimpleCollider(CollisionMeshes.TriangleSoup(1, faces, 0.1)), [.. Enumerable.Range(0, 20).Select(i => i * Vector.One)]);
}
