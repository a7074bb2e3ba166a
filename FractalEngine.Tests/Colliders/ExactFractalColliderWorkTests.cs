using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Colliders;

/// <summary>Tests how much work the exact search does on fractals that once took minutes, found nothing or ended in an error.</summary>
public class ExactFractalColliderWorkTests
{
    private static readonly Mesh Cube = Shapes.Cube();

    private static readonly AffineMap Skew = new Transformation(Vector.Zero, new(20, 0, 10), new(1, 2, 0.5)).ToAffineMap()
        * new Transformation(new(0.3, 0, 0), new(0, 0, 30), Vector.One).ToAffineMap();

    private static readonly Transformation[] PyramidMaps =
    [
        Samples.MoveAndScale(0.25, -0.25, 0.25, 0.5),
        Samples.MoveAndScale(-0.25, -0.25, 0.25, 0.5),
        Samples.MoveAndScale(0.25, -0.25, -0.25, 0.5),
        Samples.MoveAndScale(-0.25, -0.25, -0.25, 0.5),
        Samples.MoveAndScale(0, 0.25, 0, 0.5),
    ];

    private static readonly Transformation[] SpongeMaps =
    [
        .. from x in Enumerable.Range(-1, 3)
           from y in Enumerable.Range(-1, 3)
           from z in Enumerable.Range(-1, 3)
           where Math.Abs(x) + Math.Abs(y) + Math.Abs(z) > 1
           select Transformation.At(new Vector(x, y, z) / 3, scale: 1 / 3.0),
    ];

    [Theory]
    [InlineData(10_000)]
    [InlineData(40_000)]
    public void TryFindClosest_InAWideSet_TestsFewBounds(int width)
    {
        var random = new Random(1);
        var maps = Enumerable.Range(0, width)
            .Select(_ => new Transformation(random.Vector(10), random.Vector(180), 0.1 * Vector.One)).ToArray();
        var fractal = Fractal.Of(Samples.Tetrahedron).Apply(maps);
        var collider = new ExactFractalCollider(fractal);
        var expansion = new HierarchyCollider(FractalGenerator.Flatten(fractal, 1_000_000));
        var context = new QueryContext();
        for (var i = 0; i < 50; i++)
        {
            var position = random.Vector(12);
            Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, context, out var found));
            expansion.TryFindClosest(position, double.PositiveInfinity, new(), out var expected);
            Assert.Equal(expected.Distance, found.Distance, 1e-13);
            Assert.Equal(expected.FaceIndex / Samples.Tetrahedron.FaceCount, Assert.Single(context.InstancePath.ToArray()));
        }

        Assert.InRange(context.Statistics.BoundTests / 50, 1, 200);
    }

    [Theory]
    [InlineData(8)]
    [InlineData(20)]
    [InlineData(null)]
    public void TryFindClosest_OfASkewedSponge_TestsFewMoreBoundsThanOfTheSponge(int? depth)
    {
        var collider = new ExactFractalCollider(Fractal.Of(Cube).Repeat(SpongeMaps, depth));
        foreach (var position in (Vector[])[Vector.Zero, new(0.01, 0.02, 0.015), new(0.3, 0.1, 0), new(2, 1, 1)])
        {
            var skewed = new QueryContext();
            Assert.True(collider.FindClosestTransformed(position, Skew, double.PositiveInfinity, 0, skewed, out var found));
            var plain = new QueryContext();
            collider.TryFindClosest(position, double.PositiveInfinity, plain, out _);
            Assert.InRange(skewed.Statistics.BoundTests, 1, 20 * plain.Statistics.BoundTests);
            Assert.InRange(found.ErrorBound, 0, 1e-13);
        }
    }

    [Fact]
    public void TryFindClosest_OfASkewedSponge_EqualsItsExpansion()
    {
        var fractal = Fractal.Of(Cube).Repeat(SpongeMaps, 3);
        var collider = new ExactFractalCollider(fractal);
        var expansion = new HierarchyCollider(FractalGenerator.Flatten(fractal, 1_000_000).Transform(v => Skew * v));
        var context = new QueryContext();
        Seeded.Run(100, random =>
        {
            var position = random.Vector(1);
            Assert.True(collider.FindClosestTransformed(position, Skew, double.PositiveInfinity, 0, context, out var found));
            expansion.TryFindClosest(position, double.PositiveInfinity, new(), out var expected);
            Assert.Equal(expected.Distance, found.Distance, 1e-14);
        });
    }

    /// <summary>
    /// Hulls of the first levels are larger than those of the deep ones, in front of whose slanted sides many sub-fractals are about
    /// equally far away.
    /// </summary>
    [Theory]
    [InlineData(0.04, -0.2, -1)]
    [InlineData(0.1, 0.3, -1)]
    [InlineData(0.3, 0.35, 0)]
    public void TryFindClosest_BeforeThePyramid_TestsFewBounds(double x, double y, double z)
    {
        var distances = new List<double>();
        foreach (var depth in (int[])[12, 20, 30])
        {
            var collider = new ExactFractalCollider(Fractal.Of(Cube).Repeat(PyramidMaps, depth));
            var context = new QueryContext();
            Assert.True(collider.TryFindClosest(new(x, y, z), double.PositiveInfinity, context, out var found));
            Assert.InRange(context.Statistics.BoundTests, 1, 10_000);
            distances.Add(found.Distance);
        }

        // Cubes of depth n end within 2⁻ⁿ of the limit.
        Assert.Equal(distances[2], distances[1], 1e-5);
        Assert.Equal(distances[2], distances[0], 1e-3);
    }

    /// <summary>A query must not visit sub-fractals around the position one after another when the radius excludes little.</summary>
    [Fact]
    public void TryFindClosest_WithARadiusOnTheInfiniteSponge_TestsFewBounds()
    {
        var collider = new ExactFractalCollider(Fractal.Of(Cube).Repeat(SpongeMaps));
        var context = new QueryContext();
        var found = 0;
        Seeded.Run(20_000, random =>
        {
            context.Statistics.Reset();
            found += collider.TryFindClosest(random.Vector(0.7), 0.3 * random.NextDouble(), context, out _) ? 1 : 0;
            Assert.InRange(context.Statistics.BoundTests, 0, 10_000);
        });
        Assert.InRange(found, 5_000, 20_000);
    }

    [Fact]
    public void TryFindClosest_OfASpongeWithOneFarMap_IsExact()
    {
        // Hardly any of the 21²⁰ instances are far away, yet every sub-fractal has some.
        var fractal = Fractal.Of(Cube).Repeat([.. SpongeMaps, Samples.MoveAndScale(3e14, 0, 0, 1 / 3.0)], 20);
        var sponge = new ExactFractalCollider(Fractal.Of(Cube).Repeat(SpongeMaps, 20));
        var collider = new ExactFractalCollider(fractal);
        foreach (var position in (Vector[])[Vector.Zero, new(0.7, 0.6, 0.2)])
        {
            var context = new QueryContext();
            Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, context, out var found));
            sponge.TryFindClosest(position, double.PositiveInfinity, new(), out var expected);
            Assert.Equal(expected.Distance, found.Distance, 1e-12);
            Assert.InRange(found.ErrorBound, 0, 1e-12);
            Assert.InRange(context.Statistics.BoundTests, 1, 1_000_000);
        }
    }

    [Fact]
    public void TryFindClosest_BesideAMapAtTenToThe15_EndsWithAnHonestBound()
    {
        Transformation[] near = [.. PyramidMaps.Skip(2)];
        var sparse = new ExactFractalCollider(Fractal.Of(Cube).Repeat(near, 30));
        var collider = new ExactFractalCollider(Fractal.Of(Cube).Repeat([.. near, Samples.MoveAndScale(1e15, 0, 0, 0.5)], 30));
        foreach (var position in (Vector[])[Vector.Zero, new(0.7, 0.6, 0.2)])
        {
            var context = new QueryContext();
            Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, context, out var found));
            sparse.TryFindClosest(position, double.PositiveInfinity, new(), out var limit);
            Assert.InRange(limit.Distance, found.Distance - found.ErrorBound, found.Distance + 1e-12);
            Assert.InRange(context.Statistics.BoundTests, 1, 1_000_100);
        }
    }

    [Theory]
    [InlineData(20)]
    [InlineData(48)]
    [InlineData(1_000_000)]
    public void Bounds_OfAStaircase_AreThoseOfItsSteps(int depth)
    {
        var up = new Transformation(new(0.9, 0.25, 0), new(0, 20, 0), Vector.One);
        var step = Shapes.Box(new(new(-0.5, 0, -0.5), new(0.5, 0.2, 0.5)));
        var fractal = Fractal.Of(step).Repeat([Transformation.Identity, up], depth);
        // One turn is 18 steps, after which the next goes over the same ground.
        var box = BoundingBox.Empty;
        var map = AffineMap.Identity;
        for (var i = 0; i <= Math.Min(depth, 40); i++, map *= up.ToAffineMap())
        {
            box = BoundingBox.Union(box, step.ComputeBounds(map));
        }

        var size = fractal.Bounds.Size;
        Assert.InRange(fractal.Bounds.Minimum.X, box.Minimum.X - (0.01 * size.X), box.Minimum.X + 1e-9);
        Assert.InRange(fractal.Bounds.Maximum.X, box.Maximum.X - 1e-9, box.Maximum.X + (0.01 * size.X));
        Assert.InRange(fractal.Bounds.Minimum.Z, box.Minimum.Z - (0.01 * size.Z), box.Minimum.Z + 1e-9);
        Assert.InRange(fractal.Bounds.Maximum.Z, box.Maximum.Z - 1e-9, box.Maximum.Z + (0.01 * size.Z));
        Assert.Equal((depth * 0.25) + 0.2, fractal.Bounds.Maximum.Y, 1e-9 * depth);
    }

    [Fact]
    public void TryFindClosest_OnAStaircaseOfAMillionSteps_FindsTheStep()
    {
        var up = new Transformation(new(0.9, 0.25, 0), new(0, 20, 0), Vector.One);
        var step = Shapes.Box(new(new(-0.5, 0, -0.5), new(0.5, 0.2, 0.5)));
        var collider = new ExactFractalCollider(Fractal.Of(step).Repeat([Transformation.Identity, up], 1_000_000));
        var context = new QueryContext();
        var map = AffineMap.Identity;
        for (var i = 0; i < 1000; i++, map *= up.ToAffineMap())
        {
            if (i % 37 != 0)
            {
                continue;
            }

            context.Statistics.Reset();
            Assert.True(collider.TryFindClosest(map * new Vector(0.1, 0.25, 0.2), 0.06, context, out var found));
            Assert.Equal(0.05, found.Distance, 1e-9);
            Assert.Equal(Enumerable.Repeat(1, i), context.InstancePath.ToArray());
            Assert.InRange(context.Statistics.BoundTests, 1, 2000);
        }
    }

    [Theory]
    [InlineData("a point", 1e-100, 1_000_000)]
    [InlineData("flat", 1e-12, 29)]
    public void TryFindClosest_OfPowersThatUnderflow_IsThatOfTheirLimit(string what, double scale, int depth)
    {
        var map = what == "flat"
            ? new Transformation(new(0.1, 0.2, 0), Vector.Zero, new(1, 1, scale))
            : Samples.MoveAndScale(0.1, 0, 0, scale);
        var collider = new ExactFractalCollider(Fractal.Of(Cube).Repeat([map], depth));
        var context = new QueryContext();
        Assert.True(collider.TryFindClosest(new(1, 2, 3), double.PositiveInfinity, context, out var found));
        var expected = what == "flat" ? new Vector(0.1 * depth - 0.5 - 1, 0.2 * depth - 0.5 - 2, 3) : new Vector(0.9, 2, 3);
        Assert.Equal(expected.Length(), found.Distance, 1e-12);
    }

    [Fact]
    public void TryFindClosest_OfPowersThatOverflow_SaysSoOrAnswers()
    {
        Transformation[] maps = [Samples.MoveAndScale(0.1, 0, 0, 1e100)];
        var collider = new ExactFractalCollider(Fractal.Of(Cube).Repeat(maps, 3));
        Assert.True(collider.TryFindClosest(new(1, 2, 3), double.PositiveInfinity, new(), out var found));
        Assert.Equal(5e299, found.Distance, 1e288);
        Assert.Throws<FractalLimitException>(() => new ExactFractalCollider(Fractal.Of(Cube).Repeat(maps, 4)));
    }

    [Theory]
    [InlineData(1e150)]
    [InlineData(1e160)]
    [InlineData(1e300)]
    public void TryFindClosest_FarAway_FindsTheFractal(double x)
    {
        var collider = new ExactFractalCollider(Fractal.Of(Cube).Repeat(SpongeMaps, 5));
        Assert.True(collider.TryFindClosest(new(x, 0, 0), double.PositiveInfinity, new(), out var found));
        Assert.Equal(1, found.Distance / x, 1e-15);
    }

    [Theory]
    [InlineData(3)]
    [InlineData(1e154)]
    [InlineData(1e308)]
    public void TryFindClosest_WithAHugeEpsilon_FindsAPoint(double epsilon)
    {
        var collider = new ExactFractalCollider(Fractal.Of(Cube).Repeat(SpongeMaps, 5));
        var context = new QueryContext();
        Assert.True(collider.TryFindClosest(new(1, 2, 3), double.PositiveInfinity, context, out var found, epsilon));
        Assert.InRange(found.Distance, 2.9580398915498080, 4 * 2.9580398915498082);
        collider.TryFindClosest(new(1, 2, 3), double.PositiveInfinity, context, out var exact);
        Assert.True(found.Distance - found.ErrorBound <= exact.Distance + 1e-14);
    }

    [Fact]
    public void TryFindClosest_OfInstancesThatAreSmallBesideTheirCoordinates_FindsThem()
    {
        var mesh = Shapes.Box(new(new(999.5, -999.5, -0.5), new(1000.5, -998.5, 0.5)));
        Transformation[] maps =
            [Samples.MoveAndScale(100, 20, 3, 0.3), Samples.MoveAndScale(-50, 70, -30, 0.3), Samples.MoveAndScale(0, -90, 80, 0.3)];
        var fractal = Fractal.Of(mesh).Repeat(maps, 16);
        var collider = new ExactFractalCollider(fractal);
        Seeded.Run(50, random =>
        {
            // A chain of maps, then a point beside its instance.
            var map = AffineMap.Identity;
            for (var level = 0; level < 16; level++)
            {
                map *= maps[random.Next(3)].ToAffineMap();
            }

            var position = map * new Vector(1000, -998.5, 0);
            Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, new(), out var found));
            Assert.InRange(found.Distance, 0, 1e-12 * 1000);
        });
        Assert.True(new ExactFractalCollider(Fractal.Of(Samples.Tetrahedron).Repeat([Transformation.Identity, Transformation.Identity], 36))
            .TryFindClosest(new(1, 2, 3), double.PositiveInfinity, new(), out _));
    }
}
