using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Collision;

namespace FractalEngine.Tests.Benchmarks;

public class AskedColliderTests
{
    [Fact]
    public void Counts_AreMeansOfTheQueriesAndDoNotGrowWithRounds()
    {
        var mesh = CollisionMeshes.Soup(1, 300, 0.1);
        var (hierarchy, record, random) = (new HierarchyCollider(mesh), new QueryContext(), new Random(1));
        Vector[] positions = [.. Enumerable.Range(0, 100).Select(_ => CollisionMeshes.Position(random, mesh))];
        var asked = new AskedCollider(hierarchy, positions);
        asked.Ask();
        asked.Ask();
        foreach (var position in positions)
        {
            hierarchy.TryFindClosest(position, double.PositiveInfinity, record, out _);
        }

        Assert.Equal((record.FaceTests / 100.0, record.BoundTests / 100.0, hierarchy.StorageBytes),
            (asked.FaceTests, asked.BoundTests, asked.Bytes));
        Assert.Equal(300, new AskedCollider(new SimpleCollider(mesh), positions).FaceTests);
    }

    [Fact]
    public void Microseconds_OfMoreFaces_AreMore()
    {
        var (small, large) = (Asked(20), Asked(20_000));
        Assert.Equal(double.PositiveInfinity, small.Microseconds);
        for (var round = 0; round < 3; round++)
        {
            small.Ask();
            large.Ask();
        }

        // A thousand times the work; that of a call is below a microsecond.
        Assert.InRange(small.Microseconds, 0.01, 1000);
        Assert.InRange(large.Microseconds / small.Microseconds, 10, 100_000);
    }

    [Fact]
    public void TakeTurns_OfActions_LetsEachRunOnceARoundAndKeepsTheBest()
    {
        var calls = new List<int>();
        var best = TakeTurns.Best([() => calls.Add(0), () => Wait(1, calls.Count < 4 ? 300 : 10)], 3);
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

    private static AskedCollider Asked(int faces) =>
        new(new SimpleCollider(CollisionMeshes.Soup(1, faces, 0.1)), [.. Enumerable.Range(0, 20).Select(i => i * Vector.One)]);
}
