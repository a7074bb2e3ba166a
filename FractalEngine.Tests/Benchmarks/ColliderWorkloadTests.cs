using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Colliders;

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
        hierarchy.SumDistances(positions, context);
        Assert.Equal(
            (context.Statistics.FaceTests / 100.0, context.Statistics.BoundTests / 100.0, hierarchy.StorageBytes),
            (workload.FaceTests, workload.BoundTests, workload.StorageBytes));
        Assert.Equal(300, new ColliderWorkload(new SimpleCollider(mesh), positions).FaceTests);
    }

    [Fact]
    public void MicrosecondsPerQuery_OfSeveralRounds_IsTheMeanOfEachRunsBest()
    {
        var clock = new ManualClock();
        var microseconds = 1000;
        // A query costs 30 µs of face tests by the workload's estimate, so a run has six positions, and twenty positions four runs.
        var simple = new SimpleCollider(CollisionMeshes.TriangleSoup(1, 1500, 0.1));
        var collider = new FaultyCollider(simple, isExact: true, distance =>
        {
            clock.Advance(microseconds);
            return distance;
        });
        Vector[] positions = [.. Enumerable.Range(0, 20).Select(i => i * Vector.One)];
        var workload = new ColliderWorkload(collider, positions, clock);
        // The queries that only count are not timed.
        Assert.Equal(double.PositiveInfinity, workload.MicrosecondsPerQuery);
        foreach (var (time, best) in ((int, double)[])[(300, 300), (200, 200), (500, 200)])
        {
            microseconds = time;
            workload.RunQueries();
            Assert.Equal(best, workload.MicrosecondsPerQuery, 1e-9);
        }
    }

    [Fact]
    public void MeasureBestSeconds_OfActions_RunsEachOnceARoundAndKeepsTheBest()
    {
        var clock = new ManualClock();
        var calls = new List<int>();
        var best = InterleavedTiming.MeasureBestSeconds([() => Run(0, 5, 7, 6), () => Run(1, 300, 20, 10)], 3, clock);
        Assert.Equal([0, 1, 0, 1, 0, 1], calls);
        Assert.Equal([5e-6, 10e-6], best);

        void Run(int action, params int[] microsecondsOfRounds)
        {
            clock.Advance(microsecondsOfRounds[calls.Count / 2]);
            calls.Add(action);
        }
    }
}
