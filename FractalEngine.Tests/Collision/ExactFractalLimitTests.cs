using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Collision;

/// <summary>Fractals on which assumptions of the exact search about bounds, precision and depth do not hold by themselves.</summary>
public class ExactFractalLimitTests
{
    /// <summary>What lies within the distance is found, however little nearer than that it is: ε allows worse answers, not none.</summary>
    [Theory]
    [InlineData("skewed")]
    [InlineData("mirrors")]
    [InlineData("identity alone")]
    public void Find_WithEpsilonAndADistance_FindsWhatIsThere(string name)
    {
        var fractal = AttackFractals.All[name]();
        var (probe, record) = (new FractalProbe(name, fractal), new QueryContext());
        Seeded.Run(60, random =>
        {
            var position = FractalPositions.Draw(random, fractal);
            var tolerance = FractalProbe.Tolerance * FractalPositions.SizeOf(fractal, position);
            Assert.True(probe.Exact.TryFindClosest(position, double.PositiveInfinity, record, out var exact));
            foreach (var epsilon in new[] { 0.01, 0.5, 3 })
            {
                foreach (var within in new[] { (2 * exact.Distance) + tolerance, exact.Distance + tolerance })
                {
                    var found = probe.Exact.TryFindClosest(position, within, record, out var near, epsilon);
                    probe.Require(found, position, $"ε = {epsilon} finds nothing within {within:R}, though it is at {exact.Distance:R}");
                    probe.Require(near.Distance <= within && near.Distance <= ((1 + epsilon) * exact.Distance) + tolerance, position,
                        $"ε = {epsilon} gives {near.Distance:R} within {within:R}");
                }
            }
        });
    }

    /// <summary>
    /// Where copies are opened several levels at once, those of the first levels above the ones that are written out reach below the round
    /// that stands for all above: there the bounds are not yet those of the round.
    /// </summary>
    [Theory]
    [InlineData(0.5)]
    [InlineData(0.3)]
    [InlineData(0.1)]
    [InlineData(0.02)]
    public void Find_JustAboveTheLevelsThatAreWrittenOut_EqualsBranchAndBoundWithBalls(double ratio)
    {
        // A base much larger than what its copies shrink to, so that bounds shrink with each level.
        var mesh = Samples.Tetrahedron.Transform(v => 3 * v);
        for (var depth = 3; depth <= 40; depth++)
        {
            var fractal =
                new Fractal(
                    Samples.Repeated(depth, Samples.MoveAndScale(0, 0, 0, ratio), Samples.MoveAndScale(1 - ratio, 0, 0, ratio)).Description,
                    mesh);
            var (probe, oracle, record) = (new FractalProbe($"two of {ratio} at depth {depth}", fractal), new DeepOracle(fractal),
                new QueryContext());
            Seeded.Run(40, random =>
            {
                var position = random.Next(2) == 0 ? random.Vector(2) : FractalPositions.Draw(random, fractal);
                if (oracle.Nearest(position, 100_000) is { } nearest)
                {
                    probe.Check(position, record, nearest);
                    probe.CheckWithin(position, record, nearest);
                }
            });
        }
    }

    /// <summary>The precision is part of the fractal's size, not of its base's.</summary>
    [Theory]
    [InlineData(1e3)]
    [InlineData(1e6)]
    [InlineData(1e9)]
    public void Find_OnABaseMuchLargerThanTheFractal_IsExactForTheFractal(double larger)
    {
        var mesh = Samples.Tetrahedron.Transform(v => larger * v);
        var fractal =
            new Fractal(Samples.Repeated(9, Samples.MoveAndScale(0, 0, 0, 0.002), Samples.MoveAndScale(1, 0, 0, 0.002),
            Samples.MoveAndScale(0, 1, 0, 0.002)).Description, mesh);
        var (probe, oracle, record) = (new FractalProbe($"a base {larger} times larger", fractal), FractalProbe.BruteForce(fractal),
            new QueryContext());
        Seeded.Run(200, random =>
        {
            var position = FractalPositions.Draw(random, fractal);
            Assert.True(oracle.TryFindClosest(position, double.PositiveInfinity, record, out var expected));
            probe.Check(position, record, expected.Distance);
        });
    }

    /// <summary>
    /// Six maps are too many to open two levels at once; one of them hardly shrinks, and its chain leads to the position.
    /// </summary>
    [Theory]
    [InlineData(0.985, 1500)]
    [InlineData(0.99, 2500)]
    [InlineData(0.995, 3500)]
    public void Find_AtTheEndOfALongChain_GoesAllTheWay(double ratio, int depth)
    {
        var maps = Enumerable.Range(0, 5).Select(i => Samples.MoveAndScale(10, i, 0, 0.01)).Prepend(Samples.MoveAndScale(0, 0, 0, ratio))
            .ToArray();
        // Away from the fixed point, so that each level comes nearer to it.
        var fractal = new Fractal(Samples.Repeated(depth, maps).Description, Samples.Triangle.Transform(v => v + Vector.One));
        var (probe, record) = (new FractalProbe($"ratio {ratio} at depth {depth}", fractal), new QueryContext());
        var (a, b, c) = fractal.BaseMesh.Face(0);
        var expected = Math.Pow(ratio, depth) * Math.Sqrt(TriangleKernel.ClosestPoint(Vector.Zero, a, b, c).DistanceSquared);
        probe.Check(Vector.Zero, record, expected);
    }

    [Fact]
    public void Find_OnTheInfiniteFractalOfOneMap_IsItsFixedPoint()
    {
        foreach (var ratio in new[] { 0.3, 0.5, 0.9 })
        {
            var fractal = Samples.Repeated(null, Samples.MoveAndScale(1, 0, 0, ratio));
            Assert.True(new ExactFractalCollider(fractal).TryFindClosest(Vector.Zero, double.PositiveInfinity, new(), out var closest));
            Assert.Equal(1 / (1 - ratio), closest.Distance, 1e-11);
        }
    }

    /// <summary>As in fractal files, a scale of 0 is refused (decision 3).</summary>
    [Fact]
    public void Create_WithAMapThatFlattens_IsRefused()
    {
        var fractal = Samples.Repeated(2, new(Vector.I, Vector.Zero, new(0.5, 0, 0.5)), Samples.MoveAndScale(0, 1, 0, 0.5));
        Assert.Contains("determinant", Assert.Throws<SingularMatrixException>(() => new ExactFractalCollider(fractal)).Message,
            StringComparison.Ordinal);
    }

    [Fact]
    public void Find_OnABaseOfOnePoint_EqualsEveryFace() => Seeded.Run(40, random =>
    {
        var fractal = new Fractal(RandomFractals.Draw(random).Description, new([1, 1, 1, 1, 1, 1, 1, 1, 1], [0, 1, 2]));
        var (probe, oracle, record) = (new FractalProbe("point", fractal), FractalProbe.BruteForce(fractal), new QueryContext());
        var position = FractalPositions.Draw(random, fractal);
        Assert.True(oracle.TryFindClosest(position, double.PositiveInfinity, record, out var expected));
        probe.Check(position, record, expected.Distance);
    });

    [Fact]
    public void Hull_OfOnePoint_IsThePoint()
    {
        foreach (var points in new Vector[][] { [Vector.Zero], [Vector.One, Vector.One, Vector.One] })
        {
            var hull = ConvexHull.Build(points, 48);
            Assert.Equal((0, 0, 0), (hull.DistanceUpperBound(points[0]), hull.MaxOutsideDistance, hull.Volume()));
        }
    }

    /// <summary>Bounds of fractals that shrink settle, so that any depth takes no more memory than some levels.</summary>
    [Theory]
    [InlineData("diamond")]
    [InlineData("terrain")]
    public void Create_OfAnInfiniteAsset_Settles(string name) =>
        Assert.InRange(new ExactFractalCollider(AssetFractals.Load(name, null)).StorageBytes, 1, 1_000_000);

    [Fact]
    public void Create_OfAnInfiniteFractalOfSixMaps_Settles()
    {
        var maps = Enumerable.Range(1, 6).Select(i => Samples.MoveAndScale(5, i, 0, 0.05))
            .Prepend(new(Vector.Zero, new(0, 10, 0), 0.985 * Vector.One));
        Assert.InRange(new ExactFractalCollider(Samples.Repeated(null, [.. maps])).StorageBytes, 1, 1_000_000);
    }

    /// <summary>Six maps are too many to open two levels at once: a frame of the stack for each level.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(0.05)]
    public void Find_OnASmallStackInAFractalOfManyLevels_Ends(double narrower)
    {
        Transformation first = new(Vector.Zero, new(0, 10, 0), 0.985 * new Vector(1, 1, 1 - narrower));
        var maps = Enumerable.Range(1, 6).Select(i => Samples.MoveAndScale(5, i, 0, 0.05)).Prepend(first);
        Assert.Null(ExactFractalAttackTests.OnASmallStack(Samples.Repeated(3000, [.. maps])));
    }
}
