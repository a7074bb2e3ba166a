using System.Diagnostics;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>How long does the slowest query of a hundred take in a fractal of a million levels?</summary>
internal static class DeepPercentiles
{
    private const int Depth = 1_000_000;

    private static readonly string[] Names = ["menger", "sierpinski", "tree", "terrain", "tetrahedron"];

    /// <summary>Measures and writes all rows of the table.</summary>
    public static void Write(TableOptions options)
    {
        var queries = options.IsQuick ? 1000 : 10_000;
        var table = options.CreateTable(
            "growth-million.csv", "fractal", "positions", "queries", "p50_us", "p90_us", "p99_us", "p999_us", "bound_tests_p50",
            "bound_tests_p99", "bound_tests_most");
        foreach (var name in Names)
        {
            var fractal = FractalCase.Load(name, Depth).Fractal;
            var collider = new ExactFractalCollider(fractal);
            var random = new Random(1);
            AddRow("uniform", () => QueryPositions.Uniform(random, fractal.Bounds));
            AddRow("near", () => QueryPositions.NearSurface(random, fractal));

            void AddRow(string positions, Func<Vector> next)
            {
                var (times, bounds) = Measure(collider, [.. Enumerable.Range(0, queries).Select(_ => next())], options.Rounds);
                table.Add(
                    name, positions, queries, Quantile(times, 0.5), Quantile(times, 0.9), Quantile(times, 0.99), Quantile(times, 0.999),
                    Quantile(bounds, 0.5), Quantile(bounds, 0.99), bounds[^1]);
            }
        }

        table.Save();
    }

    /// <summary>The microseconds of each query in its fastest round, and its bounds, both in ascending order.</summary>
    private static (double[] Times, double[] Bounds) Measure(Collider collider, Vector[] positions, int rounds)
    {
        var times = Enumerable.Repeat(double.PositiveInfinity, positions.Length).ToArray();
        var bounds = new double[positions.Length];
        var context = new QueryContext();
        for (var round = 0; round < rounds; round++)
        {
            for (var i = 0; i < positions.Length; i++)
            {
                context.Statistics.Reset();
                var start = Stopwatch.GetTimestamp();
                collider.TryFindClosest(positions[i], double.PositiveInfinity, context, out _);
                times[i] = Math.Min(times[i], Stopwatch.GetElapsedTime(start).TotalMicroseconds);
                bounds[i] = context.Statistics.BoundTests;
            }
        }

        Array.Sort(times);
        Array.Sort(bounds);
        return (times, bounds);
    }

    private static double Quantile(double[] ascending, double share) =>
        Math.Round(ascending[(int)(share * (ascending.Length - 1))], 3);
}
