using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Fractals;
using FractalEngine.Tests.Queries.Closest;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Colliders;

/// <summary>The exact collider against every face, on fractals that break what a search may take for granted.</summary>
public class ExactFractalColliderAdversarialTests
{
    public static TheoryData<string> Names => [.. AdversarialFractals.All.Keys];

    [Theory]
    [MemberData(nameof(Names))]
    public void TryFindClosest_OnAnUnusualFractal_EqualsEveryFace(string name) => CheckAgainstEveryFace(name, 10);

    [Theory]
    [MemberData(nameof(Names))]
    [Trait("Category", "Soak")]
    public void TryFindClosest_OnAnUnusualFractalForLong_EqualsEveryFace(string name) => CheckAgainstEveryFace(name, 500);

    private static void CheckAgainstEveryFace(string name, int queries)
    {
        var fractal = AdversarialFractals.All[name]();
        var checker = new ExactColliderChecker(name, fractal);
        var oracle = ExactColliderChecker.BruteForce(fractal);
        var context = new QueryContext();
        Seeded.Run(queries, random =>
        {
            var position = FractalPositions.RandomPosition(random, fractal);
            Assert.True(oracle.TryFindClosest(position, double.PositiveInfinity, context, out var expected));
            var closest = checker.CheckQuery(position, context, expected.Distance);
            checker.CheckMaxDistance(position, context, closest.Distance);
        });
    }

    [Theory]
    [MemberData(nameof(Names))]
    public void TryFindClosest_WithEpsilon_IsWithinTheFactor(string name)
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
                var found = checker.Collider.TryFindClosest(position, double.PositiveInfinity, context, out var near, epsilon);
                checker.ThrowUnless(found && near.Distance <= ((1 + epsilon) * exact.Distance) + tolerance, position,
                    $"ε = {epsilon} gives {near.Distance:R}, not {exact.Distance:R}");
                checker.ThrowUnless(near.Distance >= exact.Distance - tolerance, position,
                    $"ε = {epsilon} gives {near.Distance:R}, though the closest is {exact.Distance:R}");
            }
        });
    }

    [Theory]
    [MemberData(nameof(Names))]
    public void TryFindClosest_WithinTheDistanceOrLittleMore_FindsThePoint(string name)
    {
        var fractal = AdversarialFractals.All[name]();
        var checker = new ExactColliderChecker(name, fractal);
        var context = new QueryContext();
        Seeded.Run(60, random =>
        {
            var position = FractalPositions.RandomPosition(random, fractal);
            Assert.True(checker.Collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest));
            checker.CheckMaxDistance(position, context, closest.Distance);
            var isFound = checker.Collider.TryFindClosest(position, closest.Distance, context, out var again);
            checker.ThrowUnless(isFound, position, $"nothing within exactly {closest.Distance:R}");
            checker.ThrowUnless(again.Distance <= closest.Distance, position, $"{again.Distance:R} within {closest.Distance:R}");
        });
    }

    /// <summary>Threads of a pool may have little stack memory.</summary>
    [Theory]
    [InlineData(0)]
    public void TryFindClosest_OnASmallStack_EndsOnAFractalThatHardlyShrinks(int smallMaps)
    {
        var other = smallMaps == 0 ? Transformation.Identity : Samples.MoveAndScale(5, 1, 0, 0.05);
        var fractal = Samples.Repeated(null, new(Vector.Zero, new(0, 10, 0), 0.985 * Vector.One), other);
        Assert.Null(RunOnSmallStack(fractal));
    }

    [Theory]
    [InlineData(1)]
    [Trait("Category", "Soak")]
    public void TryFindClosest_OnASmallStackInOtherCases_EndsOnAFractalThatHardlyShrinks(int smallMaps) =>
        TryFindClosest_OnASmallStack_EndsOnAFractalThatHardlyShrinks(smallMaps);

    /// <summary>Runs queries on a thread with a stack of 256 KB, and returns what they throw.</summary>
    internal static Exception? RunOnSmallStack(Fractal fractal)
    {
        var checker = new ExactColliderChecker("on a small stack", fractal);
        var failure = default(Exception);
        var thread = new Thread(
            () => failure = Record.Exception(() => Seeded.Run(50, random =>
            {
                var position = random.Next(2) == 0 ? Vector.Zero : random.Vector(5);
                var context = new QueryContext();
                Assert.True(checker.Collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest));
                checker.CheckResult(position, context, closest);
            })),
            maxStackSize: 262_144);
        thread.Start();
        thread.Join();
        return failure;
    }
}
