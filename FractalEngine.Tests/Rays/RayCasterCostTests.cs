using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Queries.Regions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>Tests what rays cost: memory, time to build, tests of faces; and that threads don't change what they find.</summary>
[Collection(TimedTests.Name)]
public class RayCasterCostTests
{
    private const long MaxStorageBytes = 256 << 10;

    /// <summary>The fractals of the assets.</summary>
    public static TheoryData<string> Assets =>
        [.. Directory.GetFiles(AssetFractals.Folder, "*.fdo").Select(file => Path.GetFileNameWithoutExtension(file)).Order()];

    [Theory]
    [MemberData(nameof(Assets))]
    public void StorageBytes_OfAnAsset_AreKilobytes(string name) =>
        Assert.InRange(RayCaster.For(AssetFractals.Load(name)).StorageBytes, 1, MaxStorageBytes);

    [Theory]
    [InlineData("menger")]
    [InlineData("tree")]
    [InlineData("sierpinski")]
    [InlineData("romanesco")]
    [InlineData("fern")]
    public void For_AFractalOfDepth60_TakesMillisecondsAndKilobytes(string name)
    {
        var fractal = AssetFractals.Load(name, 60);
        // Some milliseconds; the limit is above the hundredths of a second that processor time is counted in.
        var caster = ProcessorTime.RunWithin(0.4, () => RayCaster.For(fractal));
        Assert.InRange(caster.StorageBytes, 1, MaxStorageBytes);
    }

    [Theory]
    [InlineData("menger", 4)]
    [InlineData("terrain", 8)]
    [InlineData("tree", 40)]
    [InlineData("infinite-menger", null)]
    public void Rays_WithAContext_AllocateNothing(string name, int? depth)
    {
        var caster = RayCaster.For(AssetFractals.Load(name, depth));
        var rays = CreateRays(AssetFractals.Load(name, 2), 2000);
        var context = new QueryContext();
        var hits = Cast();
        var before = hits;
        Assert.Equal(0, Allocation.Measure(() => hits = Cast()));
        Assert.Equal(before, hits);
        Assert.InRange(hits, 100, 3999);

        int Cast()
        {
            var count = 0;
            foreach (var ray in rays)
            {
                count += caster.TryFindNearest(ray, context, out _) ? 1 : 0;
                count += caster.HitsAny(ray, context, 1e-6, 10) ? 1 : 0;
            }

            return count;
        }
    }

    [Fact]
    public void FindNearest_WithoutAContext_AllocatesNothingOnceWarm()
    {
        var caster = RayCaster.For(Samples.Tetrahedron);
        var ray = new Ray(new(0.1, 0.1, 9), -Vector.K);
        Assert.NotNull(caster.FindNearest(ray));
        Assert.Equal(0, Allocation.Measure(() => caster.FindNearest(ray)));
    }

    [Theory]
    [InlineData(2)]
    [InlineData(5)]
    public void Rays_OnManyThreads_FindTheSame(int threads)
    {
        var fractal = AssetFractals.Load("menger", 4);
        var caster = RayCaster.For(fractal);
        var rays = CreateRays(AssetFractals.Load("menger", 2), 8000);
        var expected = Cast(1);
        Assert.InRange(expected.Count(result => result.Hit is not null), 1000, 7999);
        Assert.Equal(expected, Cast(threads));

        (RayHit? Hit, bool Any, string Path)[] Cast(int threadCount)
        {
            var results = new (RayHit?, bool, string)[rays.Length];
            Parallel.For(0, rays.Length, new() { MaxDegreeOfParallelism = threadCount }, () => new QueryContext(), (i, _, context) =>
            {
                RayHit? hit = caster.TryFindNearest(rays[i], context, out var found) ? found : null;
                var path = context.InstancePath.ToArray();
                results[i] = (hit, caster.HitsAny(rays[i], context), string.Join(' ', path));
                Assert.Equal(hit is { } nearest ? nearest with { InstancePath = [.. path] } : null, caster.FindNearest(rays[i]));
                return context;
            }, _ => { });
            return results;
        }
    }

    [Fact]
    public void Statistics_OfRays_CountFewTestsOfFaces()
    {
        var caster = RayCaster.For(AssetFractals.Load("menger", 5));
        var rays = CreateRays(AssetFractals.Load("menger", 2), 1000);
        var context = new QueryContext();
        foreach (var ray in rays)
        {
            caster.TryFindNearest(ray, context, out _);
        }

        // The hierarchy stands for 38,400,000 faces.
        Assert.InRange(context.Statistics.FaceTests, 1000, 200 * 1000);
        Assert.InRange(context.Statistics.BoundTests, 1000, 2000 * 1000);
    }

    [Fact]
    public void SceneRays_WithAContext_AllocateNothing()
    {
        var model = Model.Of(AssetFractals.Load("tree", 10));
        var objects = Enumerable.Range(0, 50).Select(i => new SceneObject(model) { Placement = Samples.Move(3 * i, 0, 0) });
        var caster = new SceneRayCaster(new Scene { Objects = [.. objects] });
        var rays = CreateRays(AssetFractals.Load("tree", 2), 500);
        var context = new QueryContext();
        Cast();
        var hits = 0;
        Assert.Equal(0, Allocation.Measure(() => hits = Cast()));
        Assert.InRange(hits, 50, 1000);

        int Cast()
        {
            var count = 0;
            foreach (var ray in rays)
            {
                count += caster.TryFindNearest(ray, context, out _, out _) ? 1 : 0;
                count += caster.HitsAny(ray, context) ? 1 : 0;
            }

            return count;
        }
    }

    private static Ray[] CreateRays(Fractal fractal, int count)
    {
        var oracle = new RayOracle(new ShapeExpansion(fractal).Triangles);
        var random = new Random(1);
        var source = new RandomRays(random, oracle);
        return [.. Enumerable.Range(0, count).Select(i => i % 2 == 0 ? source.Draw(random, oracle) : source.DrawAtEdge(random, oracle))];
    }
}
