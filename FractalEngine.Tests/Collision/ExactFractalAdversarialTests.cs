using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Collision;

/// <summary>Fractals that break what a search may silently take for granted, against every face.</summary>
public class ExactFractalAdversarialTests
{
    public static TheoryData<string> Names => [.. AdversarialFractals.All.Keys];

    [Theory]
    [MemberData(nameof(Names))]
    public void TryFindClosest_OnAnUnusualFractal_EqualsEveryFace(string name)
    {
        var fractal = AdversarialFractals.All[name]();
        var (probe, oracle, context) = (new ExactColliderChecker(name, fractal), ExactColliderChecker.BruteForce(fractal),
            new QueryContext());
        Seeded.Run(150, random =>
        {
            var position = FractalPositions.RandomPosition(random, fractal);
            Assert.True(oracle.TryFindClosest(position, double.PositiveInfinity, context, out var expected));
            var closest = probe.CheckQuery(position, context, expected.Distance);
            probe.CheckMaxDistance(position, context, closest.Distance);
        });
    }

    [Theory]
    [MemberData(nameof(Names))]
    public void TryFindClosest_WithEpsilon_IsWithinTheFactor(string name)
    {
        var fractal = AdversarialFractals.All[name]();
        var (probe, context) = (new ExactColliderChecker(name, fractal), new QueryContext());
        Seeded.Run(60, random =>
        {
            var position = FractalPositions.RandomPosition(random, fractal);
            var tolerance = ExactColliderChecker.Tolerance * FractalPositions.Magnitude(fractal, position);
            Assert.True(probe.Collider.TryFindClosest(position, double.PositiveInfinity, context, out var exact));
            foreach (var epsilon in new[] { 0.01, 0.5, 3 })
            {
                var found = probe.Collider.TryFindClosest(position, double.PositiveInfinity, context, out var near, epsilon);
                probe.ThrowUnless(found && near.Distance <= ((1 + epsilon) * exact.Distance) + tolerance, position,
                    $"ε = {epsilon} gives {near.Distance:R}, not {exact.Distance:R}");
                probe.ThrowUnless(near.Distance >= exact.Distance - tolerance, position,
                    $"ε = {epsilon} gives {near.Distance:R}, though the nearest is {exact.Distance:R}");
            }
        });
    }

    [Theory]
    [MemberData(nameof(Names))]
    public void TryFindClosest_WithMaxDistanceJustAbove_FindsWhatIsThere(string name)
    {
        var fractal = AdversarialFractals.All[name]();
        var (probe, context) = (new ExactColliderChecker(name, fractal), new QueryContext());
        Seeded.Run(60, random =>
        {
            var position = FractalPositions.RandomPosition(random, fractal);
            Assert.True(probe.Collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest));
            probe.CheckMaxDistance(position, context, closest.Distance);
            // Exactly the distance.
            probe.ThrowUnless(probe.Collider.TryFindClosest(position, closest.Distance, context, out var again)
                && again.Distance <= closest.Distance, position, $"{again.Distance:R} within {closest.Distance:R}");
        });
    }

    /// <summary>Threads of a pool may have little stack.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    public void TryFindClosest_OnASmallStack_EndsOnAFractalThatHardlyShrinks(int others)
    {
        Transformation[] maps = [new(Vector.Zero, new(0, 10, 0), 0.985 * Vector.One), others == 0
            ? Transformation.Identity
            : Samples.MoveAndScale(5, 1, 0, 0.05)];
        Assert.Null(RunOnSmallStack(Samples.Repeated(null, maps)));
    }

    /// <summary>What queries throw on a thread of 256 KB.</summary>
    internal static Exception? RunOnSmallStack(Fractal fractal)
    {
        var (collider, failure) = (new ExactFractalCollider(fractal), default(Exception));
        var thread = new Thread(
            () => failure = Record.Exception(() => Seeded.Run(50, random => Assert.True(
                collider.TryFindClosest(random.Next(2) == 0 ? Vector.Zero : random.Vector(5), double.PositiveInfinity, new(), out _)))),
            maxStackSize: 262_144);
        thread.Start();
        thread.Join();
        return failure;
    }
}
