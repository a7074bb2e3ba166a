using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>The exact collider of a fractal beside the paper's descent, both queried at the same positions near the surface.</summary>
internal sealed class FractalWorkloads
{
    /// <summary>Creates the positions and runs each query once.</summary>
    /// <param name="fractal">The fractal that is queried.</param>
    /// <param name="random">Source of the positions.</param>
    /// <param name="queries">Number of positions.</param>
    public FractalWorkloads(Fractal fractal, Random random, int queries)
    {
        Fractal = fractal;
        var positions = Enumerable.Range(0, queries).Select(_ => QueryPositions.NearSurface(random, fractal)).ToArray();
        Exact = new(new ExactFractalCollider(fractal), positions);
        Greedy = new(new FractalCollider(fractal), positions);
    }

    /// <summary>The fractal that is queried.</summary>
    public Fractal Fractal { get; }

    /// <summary>Queries of the exact collider.</summary>
    public ColliderWorkload Exact { get; }

    /// <summary>Queries of the paper's descent.</summary>
    public ColliderWorkload Greedy { get; }

    /// <summary>Measures all workloads in turns, and returns the milliseconds of a build of the exact collider for each.</summary>
    public static double[] Measure(IReadOnlyList<FractalWorkloads> workloads, int rounds)
    {
        var actions = workloads.SelectMany(workload => new Action[]
        {
            workload.Exact.RunQueries, workload.Greedy.RunQueries, () => _ = new ExactFractalCollider(FractalCase.Copy(workload.Fractal)),
        });
        var seconds = InterleavedTiming.MeasureBestSeconds([.. actions], rounds);
        return [.. seconds.Where((_, i) => i % 3 == 2).Select(build => Math.Round(1e3 * build, 4))];
    }
}
