using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Queries.Regions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>
/// Rays at fractals too deep to expand: against the digits of the Menger sponge, and against steps along the ray as long as the exact
/// collider says is free.
/// </summary>
public class RayCasterDepthTests
{
    // Relative to the size: closer to the surface than this, a step tells nothing.
    private const double Precision = 1e-11;
    private const int MaxSteps = 400;

    // A ray down a hole of this level passes up to 3^9 cubes, so that it is still followed to the end.
    private const int MaxHole = 10;

    /// <summary>Assets and depths; null for the infinite fractal.</summary>
    public static TheoryData<string, int?> DeepFractals
    {
        get
        {
            var data = new TheoryData<string, int?>();
            foreach (var name in new[] { "sierpinski", "menger", "tree", "romanesco", "appendix-b" })
            {
                data.Add(name, 12);
                data.Add(name, 60);
                data.Add(name, 1_000_000);
                data.Add(name, null);
            }

            // Deeper, the exact collider takes seconds for so many steps.
            data.Add("fern", 12);
            return data;
        }
    }

    [Theory]
    [MemberData(nameof(DeepFractals))]
    public void TryFindNearest_AtAnyDepth_IsWhereStepsAlongTheRayEnd(string name, int? depth) => CheckSteps(name, depth, 12);

    [Theory]
    [MemberData(nameof(DeepFractals))]
    [Trait("Category", "Soak")]
    public void TryFindNearest_AtAnyDepthForLong_IsWhereStepsAlongTheRayEnd(string name, int? depth) => CheckSteps(name, depth, 2000);

    [Theory]
    [InlineData(1)]
    [InlineData(7)]
    [InlineData(9)]
    [InlineData(1000)]
    [InlineData(1_000_000)]
    [InlineData(null)]
    public void TryFindNearest_DownTheMengerSponge_FollowsTheDigits(int? depth)
    {
        // A ray down at (x, y) passes through a hole where both have the digit 1 at a level that the sponge has, and else hits the top.
        const int digits = 28;
        var caster = RayCaster.For(Sponge(depth));
        var context = new QueryContext();
        Seeded.Run(200, random =>
        {
            var hole = random.Next(1, MaxHole + 1);
            var (x, y, size) = (0.0, 0.0, 1.0);
            for (var level = 1; level <= digits; level++)
            {
                // Below the hole, the digits lead to its middle, far from its walls.
                var column = level >= hole ? 1 : random.Next(3);
                var row = level >= hole ? 1 : column == 1 ? 2 * random.Next(2) : random.Next(3);
                size /= 3;
                x += column * size;
                y += row * size;
            }

            (x, y) = (x + (size / 2), y + (size / 2));
            var ray = new Ray(new(x, y, 4), -Vector.K);
            var isHit = caster.TryFindNearest(ray, context, out var hit);
            Assert.Equal(isHit, caster.HitsAny(ray, context));
            if (hole <= (depth ?? int.MaxValue))
            {
                Assert.False(isHit, FormattableString.Invariant($"({x:R}, {y:R}): a hit at {hit.Distance:R} in a hole of level {hole}"));
            }
            else
            {
                Assert.True(isHit);
                Near.Equal(3, hit.Distance, 1e-14);
            }
        });
    }

    [Theory]
    [InlineData(5)]
    [InlineData(40)]
    [InlineData(1_000_000)]
    [InlineData(null)]
    public void TryFindNearest_AtTheCornerOfTheMengerSponge_HitsIt(int? depth)
    {
        var caster = RayCaster.For(Sponge(depth));
        var context = new QueryContext();
        Seeded.Run(100, random =>
        {
            // An edge of the cube belongs to the sponge of any depth; the ray meets nothing before.
            Vector target = new(random.Next(2), random.NextDouble(), random.Next(2));
            var outwards = new Vector(target.X - 0.5, random.Between(-0.3, 0.3), target.Z - 0.5);
            var ray = new Ray(target + outwards, -outwards);
            Assert.True(caster.TryFindNearest(ray, context, out var hit), $"{ray} leaks");
            Near.Equal(outwards.Length(), hit.Distance, 1e-12);
        });
    }

    [Fact]
    public void TryFindNearest_OfAComponentwiseFractal_EqualsEveryFace() => Seeded.Run(40, random =>
    {
        var fractal = RandomFractals.Create(random, Composition.Componentwise);
        var mesh = FractalGenerator.Flatten(fractal, 1_000_000);
        var oracle = new RayOracle(new ShapeExpansion(Fractal.Of(mesh)).Triangles);
        var caster = RayCaster.For(fractal);
        var surface = new HierarchyCollider(mesh);
        var context = new QueryContext();
        var source = new RandomRays(random, oracle);
        for (var i = 0; i < 50; i++)
        {
            var ray = source.Draw(random, oracle);
            var projected = new ProjectedRay(ray);
            var expected = oracle.CertainDistance(in projected);
            var isFound = caster.TryFindNearest(ray, context, out var hit);
            Assert.True(isFound || double.IsPositiveInfinity(expected), $"{ray} hits nothing");
            Assert.True(!isFound || hit.Distance <= expected, $"{ray} hits at {hit.Distance:R}");
            Assert.True(!isFound || surface.FindClosest(hit.Point).Distance <= 1e-12 * oracle.Magnitude);
            if (isFound && hit.Normal != Vector.Zero)
            {
                // The instance of the base's face, and the place on it.
                var (a, b, c) = fractal.BaseMesh.Face(hit.FaceIndex);
                var local = (hit.Barycentrics.X * a) + (hit.Barycentrics.Y * b) + (hit.Barycentrics.Z * c);
                Near.Equal(hit.Point, hit.InstanceMap * local, 1e-9 * oracle.Magnitude);
            }
        }
    });

    [Fact]
    public void TryFindNearest_UpToADistance_GivesTheSameBits() => Seeded.Run(100, random =>
    {
        var fractal = Fractal.Of(Shapes.Cube()).Repeat([Transformation.At(Vector.I, 0.5), Transformation.At(-Vector.I, 0.5)], 3);
        var caster = RayCaster.For(fractal.WithPlacement(new(Vector.Zero, Vector.Zero, 0.1 * Vector.One)));
        var context = new QueryContext();
        var direction = random.Direction();
        Ray ray = new((0.2 * random.Vector()) - (0.4 * direction), direction);
        var isFound = caster.TryFindNearest(ray, context, out var hit);
        Assert.Equal(isFound && hit.Distance <= 0.9, caster.TryFindNearest(ray, context, out var nearHit, maxDistance: 0.9));
        Assert.Equal(isFound && hit.Distance <= 0.9 ? hit : default, nearHit);
        Assert.Equal(isFound, caster.HitsAny(ray, context, maxDistance: isFound ? 1.0001 * hit.Distance : double.PositiveInfinity));
        Assert.False(isFound && caster.HitsAny(ray, context, maxDistance: 0.999 * hit.Distance));
    });

    [Fact]
    public void FindNearest_WithoutAContext_AllocatesTheInstancePathOnly()
    {
        var caster = RayCaster.For(
            Fractal.Of(Shapes.Cube()).Repeat([Transformation.At(Vector.I, 0.5), Transformation.At(-Vector.I, 0.5)], 9));
        // Through the middle of the outermost cube.
        Ray ray = new(new(2 - (2.0 / 512), 0, -9), Vector.K);
        var hits = Enumerable.Range(0, 20).Count(_ => caster.FindNearest(ray) is not null);
        var before = GC.GetAllocatedBytesForCurrentThread();
        for (var i = 0; i < 20; i++)
        {
            hits += caster.FindNearest(ray) is null ? 0 : 1;
        }

        // An array of nine indices each.
        Assert.Equal(20 * 64, GC.GetAllocatedBytesForCurrentThread() - before);
        Assert.Equal(40, hits);
    }

    [Fact]
    public void For_OfAnInfiniteFractalThatGrows_IsRefused() => Assert.ThrowsAny<FractalEngineException>(
        () => RayCaster.For(Samples.Repeated(null, Samples.MoveAndScale(1, 0, 0, 1.5), Samples.MoveAndScale(0, 0, 0, 0.5))));

    private static void CheckSteps(string name, int? depth, int rays)
    {
        var fractal = AssetFractals.Load(name, depth);
        var caster = RayCaster.For(fractal);
        var collider = new ExactFractalCollider(fractal);
        var box = fractal.Bounds;
        var precision = Precision * Math.Max(box.Minimum.MaxAbsComponent(), box.Maximum.MaxAbsComponent());
        var compared = 0;
        Parallel.For(1, rays + 1, () => new QueryContext(), (seed, _, context) =>
        {
            Seeded.RunOne(seed, random =>
            {
                var target = collider.FindClosest(box.Centre + (0.4 * box.Diagonal * random.Direction())).Point;
                var origin = box.Centre + (box.Diagonal * random.Between(0.5, 1.2) * random.Direction());
                var ray = new Ray(origin, target + (0.05 * box.Diagonal * random.Vector()) - origin);
                var isFound = caster.TryFindNearest(ray, context, out var hit);
                var distance = isFound ? hit.Distance : 3 * box.Diagonal;
                if (isFound)
                {
                    Assert.InRange(collider.FindClosest(hit.Point).Distance, 0, precision);
                    Near.Equal(hit.Point, ray.PointAt(hit.Distance), precision);
                }

                Assert.Equal(isFound, caster.HitsAny(ray, context));
                var free = 0.0;
                for (var step = 0; step < MaxSteps && free < distance - precision; step++)
                {
                    var length = collider.FindClosest(ray.PointAt(free)).Distance;
                    if (length < precision)
                    {
                        // The ray passes the surface this closely, so that it may hit it or not.
                        return;
                    }

                    free += length;
                }

                Assert.True(
                    !isFound || free <= distance + precision,
                    FormattableString.Invariant($"{ray}: {distance:R}, though free to {free:R}"));
                Interlocked.Increment(ref compared);
            });
            return context;
        }, _ => { });
        Seeded.AssertMost(compared, rays, 0.25);
    }

    /// <summary>The Menger sponge in the cube from 0 to 1.</summary>
    private static Fractal Sponge(int? depth)
    {
        var maps = from x in Enumerable.Range(0, 3)
                   from y in Enumerable.Range(0, 3)
                   from z in Enumerable.Range(0, 3)
                   where (x == 1 ? 1 : 0) + (y == 1 ? 1 : 0) + (z == 1 ? 1 : 0) < 2
                   select Samples.MoveAndScale(x / 3.0, y / 3.0, z / 3.0, 1 / 3.0);
        return Fractal.Of(new(
            [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1],
            [0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6, 1, 2, 6, 1, 6, 5, 0, 4, 7, 0, 7, 3]))
            .Repeat(maps, depth);
    }
}
