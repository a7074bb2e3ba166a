using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Queries.Closest;

/// <summary>Tests the exact search on random fractals of every sort against an expansion in exact arithmetic.</summary>
public class RandomAdversarialFractalTests
{
    private const int PositionsPerFractal = 12;

    // Relative to the reach, the largest absolute coordinate on the way to the closest triangle.
    private const double Tolerance = 1e-12;
    private const double LooseBound = 1e-9;
    private const double MaxLooseShare = 0.01;
    private const long MaxBoundTests = 1_000_100;

    [Fact]
    public void TryFindClosest_OfAdversarialFractals_EqualsTheExactExpansion() => CheckAll(100);

    [Fact]
    [Trait("Category", "Soak")]
    public void TryFindClosest_OfManyAdversarialFractals_EqualsTheExactExpansion() => CheckAll(20_000);

    private static void CheckAll(int fractals)
    {
        var loose = 0;
        Parallel.For(1, fractals + 1, seed => Seeded.RunOne(seed, random => Interlocked.Add(ref loose, CheckOne(random))));
        Assert.InRange(loose, 0, MaxLooseShare * fractals * PositionsPerFractal);
    }

    /// <summary>Checks queries of one fractal, and counts those whose error bound is loose.</summary>
    private static int CheckOne(Random random)
    {
        var fractal = RandomAdversarialFractals.Create(random);
        var expansion = new ExactExpansion(fractal);
        var collider = new ExactFractalCollider(fractal);
        var context = new QueryContext();
        var loose = 0;
        for (var i = 0; i < PositionsPerFractal; i++)
        {
            var position = RandomPosition(random, fractal, expansion);
            context.Statistics.Reset();
            Ensure.That(collider.TryFindClosest(position, double.PositiveInfinity, context, out var found), $"none at {position}");
            var (distance, reach) = expansion.FindClosest(position);
            var error = Math.Abs(found.Distance - distance);
            Ensure.That(
                error <= Math.Max(Tolerance * reach, found.Distance > distance ? found.ErrorBound : 0),
                $"{position}: {found.Distance:R} ± {found.ErrorBound:E1}, not {distance:R}: off by {error / reach:E1} of {reach:E1}");
            Assert.InRange(context.Statistics.BoundTests, 1, MaxBoundTests);
            loose += found.ErrorBound > LooseBound * Math.Max(reach, found.Point.MaxAbsComponent()) ? 1 : 0;
        }

        return loose;
    }

    private static Vector RandomPosition(Random random, Fractal fractal, ExactExpansion expansion)
    {
        var vertex = expansion.RandomVertex(random);
        return random.Next(6) switch
        {
            0 => vertex,
            1 => vertex + random.Vector(1e-3),
            2 => random.Vector(2),
            3 => Vector.Zero,
            4 => fractal.Bounds.Centre + (random.NextDouble() * fractal.Bounds.Diagonal * random.Vector(1)),
            _ => vertex + random.Vector(0.5),
        };
    }
}
