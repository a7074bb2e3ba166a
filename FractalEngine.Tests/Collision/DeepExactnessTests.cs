using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Collision;

/// <summary>
/// The exact collider where a fractal has too many faces to list: against the greedy one, a beam, and plain branch and bound with balls.
/// </summary>
public class DeepExactnessTests
{
    private const int BeamWidth = 64;
    private const int MostNodes = 400_000;

    /// <summary>Assets whose copies hardly overlap, so that balls are enough, and depths; null for the infinite fractal.</summary>
    public static TheoryData<string, int?> Deep
    {
        get
        {
            var data = new TheoryData<string, int?>();
            foreach (var name in new[] { "sierpinski", "tetrahedron", "menger", "googol", "tree-leaves", "tree", "snowflake", "diamond",
                "romanesco", "fern", "appendix-b" })
            {
                data.Add(name, 20);
                data.Add(name, 60);
                data.Add(name, 1_000_000);
                data.Add(name, null);
            }

            // Deeper, its tiles are needles as tall as 300 of their widths, and a query takes up to a minute.
            data.Add("terrain", 20);
            return data;
        }
    }

    [Theory]
    [MemberData(nameof(Deep))]
    public void Find_AtAnyDepth_EqualsBranchAndBoundWithBalls(string name, int? depth) => Compare(name, depth, queries: 24);

    [Theory]
    [MemberData(nameof(Deep))]
    [Trait("Category", "Soak")]
    public void Find_AtAnyDepthForLong_EqualsBranchAndBoundWithBalls(string name, int? depth) => Compare(name, depth, queries: 300);

    [Theory]
    [InlineData("sierpinski")]
    [InlineData("menger")]
    [InlineData("tree")]
    [InlineData("fern")]
    public void Oracle_WhereFacesCanBeListed_EqualsThem(string name)
    {
        var fractal = AssetFractals.Load(name, 2);
        var (oracle, simple, record) = (new DeepOracle(fractal), FractalProbe.BruteForce(fractal), new QueryContext());
        Seeded.Run(60, random =>
        {
            var position = FractalPositions.Draw(random, fractal);
            Assert.True(simple.TryFindClosest(position, double.PositiveInfinity, record, out var closest));
            var tolerance = FractalProbe.Tolerance * FractalPositions.SizeOf(fractal, position);
            Assert.Equal(closest.Distance, Assert.NotNull(oracle.Nearest(position, int.MaxValue)), tolerance);
            Assert.InRange(oracle.NearestOfBeam(position, BeamWidth), closest.Distance - tolerance, double.PositiveInfinity);
        });
    }

    private static void Compare(string name, int? depth, int queries)
    {
        var fractal = AssetFractals.Load(name, depth);
        var probe = new FractalProbe(FormattableString.Invariant($"{name} of depth {depth}"), fractal);
        var oracle = new DeepOracle(fractal);
        // The descent takes the identity as often as it can, so that it does not end; a shallower fractal is part of a deeper one there.
        var greedy = new FractalCollider(oracle.HasIdentity && depth is not <= 60 ? AssetFractals.Load(name, 60) : fractal);
        var compared = 0;
        Parallel.For(1, queries + 1, () => new QueryContext(), (seed, _, record) =>
        {
            Seeded.RunOne(seed, random =>
            {
                var position = FractalPositions.Draw(random, fractal);
                var tolerance = FractalProbe.Tolerance * FractalPositions.SizeOf(fractal, position);
                var found = probe.Exact.TryFindClosest(position, double.PositiveInfinity, record, out var closest);
                probe.Require(found, position, $"nothing found");
                probe.CheckAnswer(position, record, closest);
                // The answer is a point of the fractal; so it is right if nothing is nearer.
                if (oracle.Nearest(position, MostNodes, closest.Distance - tolerance) is { } nearest)
                {
                    probe.Require(nearest >= closest.Distance - tolerance, position, $"distance {closest.Distance:R}, not {nearest:R}");
                    Interlocked.Increment(ref compared);
                }

                probe.CheckWithin(position, record, closest.Distance);
                greedy.TryFindClosest(position, double.PositiveInfinity, record, out var other);
                probe.Require(closest.Distance <= other.Distance + tolerance, position,
                    $"distance {closest.Distance:R}, though greedily {other.Distance:R}");
                var beam = seed % 4 == 0 ? oracle.NearestOfBeam(position, BeamWidth) : double.PositiveInfinity;
                probe.Require(closest.Distance <= beam + tolerance, position,
                    $"distance {closest.Distance:R}, though {beam:R} by beam search");
            });
            return record;
        }, _ => { });
        // Balls overlap more than what they hold does, so that some positions take too long.
        Assert.InRange(compared, queries * 2 / 3, queries);
    }
}
