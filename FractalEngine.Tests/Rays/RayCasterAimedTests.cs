using System.Globalization;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Queries.Regions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>
/// Tests that no ray aimed into a face, or at an edge that two faces share, misses a random shape. Exact arithmetic says whether it had to
/// hit: at an open edge, or seen edge on, either answer is right.
/// </summary>
public class RayCasterAimedTests
{
    private const int MaxDrawsPerRay = 4;

    // Hardly any ray hits with certainty a shape that a far outlier or a needle makes too small.
    private const double MinCertainShare = 0.67;

    [Fact]
    public void Rays_AimedAtRandomShapes_AllHit() => CheckAll(1, 200, 60);

    [Fact]
    [Trait("Category", "Soak")]
    public void Rays_AimedAtManyRandomShapes_AllHit() => CheckAll(1_000_000, 10_000, 1500);

    private static void CheckAll(int firstSeed, int shapes, int raysPerShape)
    {
        var certain = 0;
        Parallel.For(firstSeed, firstSeed + shapes, seed =>
            Seeded.RunOne(seed, random => Interlocked.Add(ref certain, CheckOne(random, raysPerShape))));
        Seeded.AssertMost(certain, shapes * raysPerShape, MinCertainShare);
    }

    /// <summary>Casts rays at a shape until enough had to hit, and returns their number.</summary>
    private static int CheckOne(Random random, int rays)
    {
        var fractal = RandomShapes.Create(random);
        var shape = new ShapeExpansion(fractal);
        var targets = new RayTargets(shape);
        RayCaster[] casters = [RayCaster.For(fractal), RayCaster.For(Expand(shape))];
        var context = new QueryContext();
        var certain = 0;
        for (var i = 0; i < MaxDrawsPerRay * rays && certain < rays; i++)
        {
            var (ray, target) = targets.Draw(random);
            var reach = Math.Max(targets.Reach, ray.Origin.MaxAbsComponent());
            if (target.FindCertainDistance(new(ray), new(ray), reach) is not { } expected)
            {
                continue;
            }

            certain++;
            // Faces are gathered and tested in another order where there is no hierarchy of instances.
            foreach (var caster in casters)
            {
                var isFound = caster.TryFindNearest(ray, context, out var hit);
                Assert.True(isFound && hit.Distance <= expected && caster.HitsAny(ray, context), string.Create(
                    CultureInfo.InvariantCulture,
                    $"{ray} at {target}: {(isFound ? hit.Distance : double.NaN):R}, not within {expected:R}, by {caster.GetType().Name}"));
            }
        }

        return certain;
    }

    private static Mesh Expand(ShapeExpansion shape) => new(
        [.. from triangle in shape.Triangles
            from corner in new[] { triangle.A, triangle.B, triangle.C }
            from coordinate in new[] { corner.X, corner.Y, corner.Z }
            select coordinate],
        [.. Enumerable.Range(0, 3 * shape.Triangles.Length)]);
}
