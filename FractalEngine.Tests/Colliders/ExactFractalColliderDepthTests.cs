using FractalEngine.Core.Colliders;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Fractals;
using FractalEngine.Tests.Queries.Closest;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Colliders;

/// <summary>
/// The exact collider where a fractal has too many faces to list: against the greedy one, a beam, and branch and bound with spheres.
/// </summary>
public class ExactFractalColliderDepthTests
{
    private const int BeamWidth = 64;
    private const int MaxNodes = 400_000;

    /// <summary>Assets whose instances hardly overlap, so that spheres suffice, and depths; null for the infinite fractal.</summary>
    public static TheoryData<string, int?> DeepFractals
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

            // Deeper tiles are needles 300 times as tall as they are wide, and a query takes up to a minute.
            data.Add("terrain", 20);
            return data;
        }
    }

    [Theory]
    [InlineData("sierpinski", 20)]
    [InlineData("menger", 1_000_000)]
    [InlineData("googol", 60)]
    [InlineData("tree-leaves", 60)]
    [InlineData("tree", null)]
    [InlineData("snowflake", 20)]
    [InlineData("diamond", null)]
    [InlineData("romanesco", 1_000_000)]
    [InlineData("fern", 20)]
    [InlineData("appendix-b", 60)]
    [InlineData("terrain", 20)]
    public void TryFindClosest_AtSomeDepth_EqualsBranchAndBoundWithSpheres(string name, int? depth) => Compare(name, depth, queries: 2);

    [Theory]
    [MemberData(nameof(DeepFractals))]
    [Trait("Category", "Soak")]
    public void TryFindClosest_AtAnyDepth_EqualsBranchAndBoundWithSpheres(string name, int? depth) =>
        Compare(name, depth, queries: 300);

    [Theory]
    [InlineData("sierpinski")]
    [InlineData("menger")]
    [InlineData("tree")]
    [InlineData("fern")]
    public void Oracle_WhereFacesCanBeListed_EqualsThem(string name)
    {
        var fractal = AssetFractals.Load(name, 2);
        var oracle = new BranchAndBoundOracle(fractal);
        var simple = ExactColliderChecker.BruteForce(fractal);
        var context = new QueryContext();
        Seeded.Run(60, random =>
        {
            var position = FractalPositions.RandomPosition(random, fractal);
            Assert.True(simple.TryFindClosest(position, double.PositiveInfinity, context, out var closest));
            var tolerance = ExactColliderChecker.Tolerance * FractalPositions.Magnitude(fractal, position);
            Assert.Equal(closest.Distance, Assert.NotNull(oracle.FindClosestDistance(position, int.MaxValue)), tolerance);
            Assert.InRange(oracle.FindClosestDistanceByBeam(position, BeamWidth), closest.Distance - tolerance, double.PositiveInfinity);
        });
    }

    private static void Compare(string name, int? depth, int queries)
    {
        var fractal = AssetFractals.Load(name, depth);
        var checker = new ExactColliderChecker(FormattableString.Invariant($"{name} of depth {depth}"), fractal);
        var oracle = new BranchAndBoundOracle(fractal);
        // The descent takes the identity as often as it can, so that it does not end. A shallower fractal is then part of a deeper one.
        var greedy = new FractalCollider(oracle.RoundHasIdentity && depth is not <= 60 ? AssetFractals.Load(name, 60) : fractal);
        var compared = 0;
        Parallel.For(1, queries + 1, () => new QueryContext(), (seed, _, context) =>
        {
            Seeded.RunOne(seed, random =>
            {
                var position = FractalPositions.RandomPosition(random, fractal);
                var tolerance = ExactColliderChecker.Tolerance * FractalPositions.Magnitude(fractal, position);
                var found = checker.Collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest);
                checker.ThrowUnless(found, position, $"nothing found");
                checker.CheckResult(position, context, closest);
                // The result is a point of the fractal; so it is right if nothing is closer.
                if (oracle.FindClosestDistance(position, MaxNodes, closest.Distance - tolerance) is { } expected)
                {
                    checker.ThrowUnless(expected >= closest.Distance - tolerance, position,
                        $"distance {closest.Distance:R}, not {expected:R}");
                    Interlocked.Increment(ref compared);
                }

                checker.CheckMaxDistance(position, context, closest.Distance);
                greedy.TryFindClosest(position, double.PositiveInfinity, context, out var other);
                checker.ThrowUnless(closest.Distance <= other.Distance + tolerance, position,
                    $"distance {closest.Distance:R}, though greedily {other.Distance:R}");
                var beamDistance = seed % 4 == 0 ? oracle.FindClosestDistanceByBeam(position, BeamWidth) : double.PositiveInfinity;
                checker.ThrowUnless(closest.Distance <= beamDistance + tolerance, position,
                    $"distance {closest.Distance:R}, though {beamDistance:R} by beam search");
            });
            return context;
        }, _ => { });
        // Spheres overlap more than what they contain, so that some positions take too long.
        Assert.InRange(compared, queries * 2 / 3, queries);
    }
}
