using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.SceneQueries;

public class RayBatchTests
{
    private static readonly Fractal Sponge = AssetFractals.Load("menger", 3);

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(8)]
    public void FindNearest_OnAnyThreads_EqualsOneRayAfterTheOther(int threads)
    {
        var caster = new SceneRayCaster(new Scene { Objects = [new(Sponge), new(Sponge) { Placement = Samples.Move(1.5, 0, 0) }] });
        var random = new Random(7);
        var rays = Enumerable.Range(0, 5000).Select(_ => new Ray(RandomVector(random), RandomVector(random))).ToArray();
        var totals = new QueryContext();
        var results = BatchQuery.Run(rays, (ray, rayContext) => caster.FindNearest(ray, rayContext), totals, threads);

        var context = new QueryContext();
        var hits = 0;
        for (var i = 0; i < rays.Length; i++)
        {
            RayHit? expected = caster.TryFindNearest(rays[i], context, out var hit)
                ? hit with { InstancePath = [.. context.InstancePath], ObjectIndex = context.ObjectIndex }
                : null;
            Assert.Equal(expected, results[i]);
            hits += expected is null ? 0 : 1;
        }

        Assert.InRange(hits, 500, 4500);
        Assert.Equal(
            (context.Statistics.FaceTests, context.Statistics.BoundTests), (totals.Statistics.FaceTests, totals.Statistics.BoundTests));
    }

    [Fact]
    public void FindNearest_OfNoRays_IsEmpty() =>
        Assert.Empty(BatchQuery.Run(Array.Empty<Ray>(), (ray, context) => RayCaster.For(Sponge).FindNearest(ray, context)));

    [Fact]
    public void FindNearest_OfAFractalThatIsRefused_ThrowsItsOwnErrorOnAnyThread()
    {
        // Infinite, and each level as large as the one before: no level bounds it.
        var endless = new Fractal(new([new Repetition([new TransformationSet([Samples.Move(1, 0, 0), Transformation.Identity])], null)]),
            Samples.Triangle);
        var caster = new SceneRayCaster(new Scene { Objects = [new(endless)] });
        var rays = Enumerable.Repeat(new Ray(Vector.Zero, Vector.K), 2000).ToArray();
        Assert.Throws<FractalLimitException>(
            () => { BatchQuery.Run(rays, (ray, context) => caster.FindNearest(ray, context), threads: 2); });
    }

    [Fact]
    public void FindNearest_OfARayWithoutDirection_IsRefusedAsAlone()
    {
        var caster = new SceneRayCaster(new Scene { Objects = [new(Sponge)] });
        Ray[] rays = [new(Vector.Zero, Vector.K), new(Vector.Zero, Vector.Zero)];
        Assert.Throws<ArgumentException>(() => { BatchQuery.Run(rays, (ray, context) => caster.FindNearest(ray, context)); });
    }

    [Fact]
    public void TryFindNearest_ByAWideRay_HitsSmallPartsAsTheirBoxes()
    {
        var caster = RayCaster.For(Sponge);
        var context = new QueryContext();
        // Through the hole in the middle of a third of a third: a line passes, a pixel wider than the sub-fractal does not.
        var ray = new Ray(new(1.0 / 3, 1.0 / 3, -2), Vector.K);
        Assert.False(caster.TryFindNearest(ray, context, out _));
        Assert.False(caster.TryFindNearest(ray, context, out _, footprint: new(0, 0)));
        Assert.True(caster.TryFindNearest(ray, context, out var hit, footprint: new(0.3, 0)));
        // The box of a proxy is a little wider than the sub-fractal.
        Assert.Equal(1.5, hit.Distance, 1e-8);
        Assert.Equal(2, new RayFootprint(0.5, 0.25).RadiusAt(6));
    }

    private static Vector RandomVector(Random random) =>
        new((2 * random.NextDouble()) - 1, (2 * random.NextDouble()) - 1, (2 * random.NextDouble()) - 1);
}
