using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Fractals;
using FractalEngine.Tests.Queries.Closest;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Colliders;

/// <summary>The exact collider at the limits of its bounds, its precision and its depth.</summary>
public class ExactFractalColliderLimitTests
{
    /// <summary>A point within the search radius is found however close to it: ε allows worse results, not none.</summary>
    [Theory]
    [InlineData("skewed")]
    [InlineData("mirrors")]
    [InlineData("identity alone")]
    public void TryFindClosest_WithEpsilonAndMaxDistance_FindsAPoint(string name)
    {
        var fractal = AdversarialFractals.All[name]();
        var checker = new ExactColliderChecker(name, fractal);
        var context = new QueryContext();
        Seeded.Run(60, random =>
        {
            var position = FractalPositions.RandomPosition(random, fractal);
            var tolerance = ExactColliderChecker.Tolerance * FractalPositions.Magnitude(fractal, position);
            Assert.True(checker.Collider.TryFindClosest(position, double.PositiveInfinity, context, out var exact));
            foreach (var epsilon in new[] { 0.01, 0.5, 3 })
            {
                foreach (var maxDistance in new[] { (2 * exact.Distance) + tolerance, exact.Distance + tolerance })
                {
                    var found = checker.Collider.TryFindClosest(position, maxDistance, context, out var near, epsilon);
                    checker.ThrowUnless(found, position,
                        $"ε = {epsilon} finds nothing within {maxDistance:R}, though it is at {exact.Distance:R}");
                    var limit = Math.Min(maxDistance, ((1 + epsilon) * exact.Distance) + tolerance);
                    checker.ThrowUnless(near.Distance <= limit, position,
                        $"ε = {epsilon} gives {near.Distance:R} within {maxDistance:R}");
                }
            }
        });
    }

    /// <summary>
    /// Where several levels are expanded at once, children of the first levels above the stored ones lie below the round that represents
    /// all above. There the bounds are not yet those of the round.
    /// </summary>
    [Theory]
    [InlineData(0.5)]
    [InlineData(0.3)]
    [InlineData(0.1)]
    [InlineData(0.02)]
    public void TryFindClosest_JustAboveTheExpandedLevels_EqualsBranchAndBoundWithSpheres(double ratio) => CheckTwoMaps(ratio, queries: 10);

    [Theory]
    [InlineData(0.5)]
    [InlineData(0.3)]
    [InlineData(0.1)]
    [InlineData(0.02)]
    [Trait("Category", "Soak")]
    public void TryFindClosest_JustAboveTheExpandedLevelsOften_EqualsBranchAndBoundWithSpheres(double ratio) =>
        CheckTwoMaps(ratio, queries: 100);

    /// <summary>The precision is relative to the fractal's size, not to its base's.</summary>
    [Theory]
    [InlineData(1e3)]
    [InlineData(1e6)]
    [InlineData(1e9)]
    public void TryFindClosest_OnABaseMuchLargerThanTheFractal_IsExactForTheFractal(double larger)
    {
        var mesh = Samples.Tetrahedron.Transform(v => larger * v);
        Transformation[] maps =
            [Samples.MoveAndScale(0, 0, 0, 0.002), Samples.MoveAndScale(1, 0, 0, 0.002), Samples.MoveAndScale(0, 1, 0, 0.002)];
        var fractal = new Fractal(Samples.Repeated(9, maps).Description, mesh);
        var checker = new ExactColliderChecker($"a base {larger} times larger", fractal);
        var oracle = ExactColliderChecker.BruteForce(fractal);
        var context = new QueryContext();
        Seeded.Run(200, random =>
        {
            var position = FractalPositions.RandomPosition(random, fractal);
            Assert.True(oracle.TryFindClosest(position, double.PositiveInfinity, context, out var expected));
            checker.CheckQuery(position, context, expected.Distance);
        });
    }

    /// <summary>
    /// Six maps are too many to expand two levels at once; one of them hardly shrinks, and its chain leads to the position.
    /// </summary>
    [Theory]
    [InlineData(0.985, 1500)]
    [InlineData(0.99, 2500)]
    [InlineData(0.995, 3500)]
    public void TryFindClosest_AtTheEndOfALongChain_ReachesTheEnd(double ratio, int depth)
    {
        var maps = Enumerable.Range(0, 5).Select(i => Samples.MoveAndScale(10, i, 0, 0.01)).Prepend(Samples.MoveAndScale(0, 0, 0, ratio))
            .ToArray();
        // The base is away from the fixed point, so that each level comes closer to it.
        var fractal = new Fractal(Samples.Repeated(depth, maps).Description, Samples.Triangle.Transform(v => v + Vector.One));
        var checker = new ExactColliderChecker($"ratio {ratio} at depth {depth}", fractal);
        var context = new QueryContext();
        var (a, b, c) = fractal.BaseMesh.Face(0);
        var expected = Math.Pow(ratio, depth) * Math.Sqrt(TriangleKernel.ClosestPoint(Vector.Zero, a, b, c).DistanceSquared);
        checker.CheckQuery(Vector.Zero, context, expected);
    }

    [Fact]
    public void TryFindClosest_OnTheInfiniteFractalOfOneMap_IsItsFixedPoint()
    {
        foreach (var ratio in new[] { 0.3, 0.5, 0.9 })
        {
            var fractal = Samples.Repeated(null, Samples.MoveAndScale(1, 0, 0, ratio));
            Assert.True(new ExactFractalCollider(fractal).TryFindClosest(Vector.Zero, double.PositiveInfinity, new(), out var closest));
            Assert.Equal(1 / (1 - ratio), closest.Distance, 1e-11);
        }
    }

    /// <summary>A scale of 0 is refused, as in fractal files (decision 3).</summary>
    [Fact]
    public void Create_WithAMapThatFlattens_IsRefused()
    {
        var fractal = Samples.Repeated(2, new(Vector.I, Vector.Zero, new(0.5, 0, 0.5)), Samples.MoveAndScale(0, 1, 0, 0.5));
        var error = Assert.Throws<SingularMatrixException>(() => new ExactFractalCollider(fractal));
        Assert.Contains("determinant", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void TryFindClosest_OnABaseOfOnePoint_EqualsEveryFace() => Seeded.Run(40, random =>
    {
        var fractal = new Fractal(RandomFractals.Create(random).Description, new([1, 1, 1, 1, 1, 1, 1, 1, 1], [0, 1, 2]));
        var checker = new ExactColliderChecker("point", fractal);
        var oracle = ExactColliderChecker.BruteForce(fractal);
        var context = new QueryContext();
        var position = FractalPositions.RandomPosition(random, fractal);
        Assert.True(oracle.TryFindClosest(position, double.PositiveInfinity, context, out var expected));
        checker.CheckQuery(position, context, expected.Distance);
    });

    [Fact]
    public void ConvexHull_OfOnePoint_IsThePoint()
    {
        foreach (var points in new Vector[][] { [Vector.Zero], [Vector.One, Vector.One, Vector.One] })
        {
            var hull = ConvexHull.Build(points, 48);
            Assert.Equal((0, 0, 0), (hull.DistanceUpperBound(points[0]), hull.MaxOutsideDistance, hull.Volume()));
        }
    }

    /// <summary>Bounds of fractals that shrink converge, so that any depth takes no more memory than some levels.</summary>
    /// <remarks>The bytes of all arrays are counted. Hulls may have a vertex more or less where rounding is another.</remarks>
    [Theory]
    [InlineData("diamond", 5, 54_798)]
    [InlineData("diamond", 1000, 74_382)]
    [InlineData("diamond", null, 24_646)]
    [InlineData("fern", 5, 71_087)]
    [InlineData("fern", 20, 87_807)]
    [InlineData("fern", 1000, 87_983)]
    [InlineData("fern", null, 41_439)]
    [InlineData("romanesco", 5, 65_308)]
    [InlineData("romanesco", 1000, 90_452)]
    [InlineData("romanesco", null, 43_412)]
    [InlineData("terrain", 5, 25_296)]
    [InlineData("terrain", 20, 53_728)]
    [InlineData("terrain", 100, 53_912)]
    [InlineData("terrain", 1000, 85_528)]
    [InlineData("terrain", null, 21_656)]
    public void Create_OfADeepAsset_HasBoundedStorage(string name, int? depth, long expected) => Assert.InRange(
        new ExactFractalCollider(AssetFractals.Load(name, depth)).StorageBytes, expected * 49 / 50, expected * 51 / 50);

    /// <summary>Powers of two change no digits: results at tiny shapes are those at others, scaled.</summary>
    [Theory]
    [InlineData(-600)]
    [InlineData(-500)]
    public void TryFindClosest_AtATinyShape_ScalesTheErrorBound(int exponent)
    {
        var size = Math.ScaleB(1, exponent);
        var fractal = Fractal.Of(Samples.Tetrahedron.Transform(v => size * v))
            .Repeat([Samples.MoveAndScale(size, 0, 0, 0.5), Samples.MoveAndScale(0, size, 0, 0.5)], 3);
        var position = size * new Vector(1, 2, 3);
        Assert.True(Collider.For(fractal).TryFindClosest(position, double.PositiveInfinity, new(), out var closest));
        // Some units in the last place of the position.
        Assert.InRange(closest.ErrorBound, Math.ScaleB(size, -52), Math.ScaleB(size, -40));
    }

    /// <summary>The instance of the set below lies behind identities without end, which no path can name.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void TryFindClosest_BehindIdentitiesWithoutEnd_EndsThePathThere(bool hasMoreMaps)
    {
        var round = new[] { Transformation.Identity, Samples.MoveAndScale(20, 0, 0, 0.5) };
        var fractal = Fractal.Of(Samples.Tetrahedron).Apply([Samples.Move(0, 5, 0), Transformation.Identity])
            .Repeat(hasMoreMaps ? [.. round, Samples.MoveAndScale(0, 0, 20, 0.25)] : round);
        var context = new QueryContext();
        var (instance, face) = (new Vector(2, 5, 0), new Vector(20 + 1, 2.5, 0));
        Assert.True(Collider.For(fractal).TryFindClosest(instance + Vector.I, 10, context, out var closest));
        Assert.Equal((1.0, instance), (closest.Distance, closest.Point));
        Assert.True(context.InstancePath.Length < 2);
        Assert.True(Collider.For(fractal).TryFindClosest(face + Vector.I, 10, context, out closest));
        Assert.Equal((1.0, face), (closest.Distance, closest.Point));
        Assert.Equal(1, context.InstancePath[0]);
        Assert.True(context.InstancePath.Length < 3);
    }

    [Fact]
    public void Create_OfAnInfiniteFractalOfSixMaps_HasBoundedStorage()
    {
        var maps = Enumerable.Range(1, 6).Select(i => Samples.MoveAndScale(5, i, 0, 0.05))
            .Prepend(new(Vector.Zero, new(0, 10, 0), 0.985 * Vector.One));
        Assert.InRange(new ExactFractalCollider(Samples.Repeated(null, [.. maps])).StorageBytes, 1, 1_000_000);
    }

    /// <summary>A path of an infinite fractal never comes to the levels above the base mesh, so they need not be kept.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Create_OfAnInfiniteFractalOfAHundredRotatedMaps_HasBoundedStorage(bool isSkewed)
    {
        var random = new Random(100);
        var maps = Enumerable.Range(0, 100).Select(_ =>
        {
            var scale = 0.1 + (0.3 * random.NextDouble());
            return new Transformation(
                random.Vector(10), random.Vector(180), isSkewed ? new(scale, 0.2, 0.3) : scale * Vector.One);
        }).ToArray();
        var fractal = Samples.Repeated(null, maps);
        var collider = new ExactFractalCollider(fractal);
        Assert.InRange(collider.StorageBytes, 1, 160 * 1024);

        // A deep version differs by less than coordinates can hold.
        var deep = new ExactFractalCollider(fractal.WithDepth(60));
        for (var i = 0; i < 50; i++)
        {
            var position = random.Vector(20);
            Assert.Equal(deep.FindClosest(position).Distance, collider.FindClosest(position).Distance, 1e-12);
        }
    }

    /// <summary>Levels as wide as this one are recognised as equal too, so that those above are not built.</summary>
    [Fact]
    [Trait("Category", "Soak")]
    public void Create_OfAnInfiniteFractalOfTwoThousandMaps_BuildsFewLevels()
    {
        const int MapCount = 2000;
        var random = new Random(101);
        var maps = Enumerable.Range(0, MapCount)
            .Select(_ => new Transformation(random.Vector(10), random.Vector(180), 0.02 * Vector.One)).ToArray();
        var collider = new ExactFractalCollider(Samples.Repeated(null, maps));
        var deep = new ExactFractalCollider(Samples.Repeated(20, maps));
        for (var i = 0; i < 50; i++)
        {
            var position = random.Vector(20);
            Assert.Equal(deep.FindClosest(position).Distance, collider.FindClosest(position).Distance, 1e-12);
        }
    }

    /// <summary>Six maps are too many to expand two levels at once, so that each level takes a frame of the stack.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(0.05)]
    public void TryFindClosest_OnASmallStackInAFractalOfManyLevels_Ends(double narrower)
    {
        Transformation first = new(Vector.Zero, new(0, 10, 0), 0.985 * new Vector(1, 1, 1 - narrower));
        var maps = Enumerable.Range(1, 6).Select(i => Samples.MoveAndScale(5, i, 0, 0.05)).Prepend(first);
        Assert.Null(ExactFractalColliderAdversarialTests.RunOnSmallStack(Samples.Repeated(3000, [.. maps])));
    }

    private static void CheckTwoMaps(double ratio, int queries)
    {
        // The base is much larger than its instances, so that bounds shrink with each level.
        var mesh = Samples.Tetrahedron.Transform(v => 3 * v);
        var (queried, compared) = (0, 0);
        for (var depth = 3; depth <= 40; depth++)
        {
            Transformation[] maps = [Samples.MoveAndScale(0, 0, 0, ratio), Samples.MoveAndScale(1 - ratio, 0, 0, ratio)];
            var fractal = new Fractal(Samples.Repeated(depth, maps).Description, mesh);
            var checker = new ExactColliderChecker($"two of {ratio} at depth {depth}", fractal);
            var oracle = new BranchAndBoundOracle(fractal);
            var context = new QueryContext();
            Seeded.Run(queries, random =>
            {
                var position = random.Next(2) == 0 ? random.Vector(2) : FractalPositions.RandomPosition(random, fractal);
                queried++;
                if (oracle.FindClosestDistance(position, 100_000) is { } expected)
                {
                    compared++;
                    checker.CheckQuery(position, context, expected);
                    checker.CheckMaxDistance(position, context, expected);
                }
            });
        }

        Seeded.AssertMost(compared, queried);
    }
}
