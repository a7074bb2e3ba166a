using BenchmarkDotNet.Attributes;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks;

/// <summary>
/// How does the cost of an exact answer grow with the depth? At most linearly, to the depth where sub-fractals are below the precision of a
/// coordinate, and then not at all. One operation is one query.
/// </summary>
public class DepthBenchmarks
{
    private const int Queries = 1024;

    private readonly QueryRecord _record = new();
    private Vector[] _near = null!;
    private ExactFractalCollider _exact = null!;

    [Params("sierpinski", "menger", "tree", "terrain")]
    public string Fractal { get; set; } = "";

    [Params(5, 10, 20, 40, 60, 100_000)]
    public int Depth { get; set; }

    [GlobalSetup]
    public void SetUp()
    {
        var fractal = FractalCase.Load(Fractal, Depth).Fractal;
        var random = new Random(1);
        _near = [.. Enumerable.Range(0, Queries).Select(_ => QueryPositions.Near(random, fractal))];
        _exact = new(fractal);
    }

    [Benchmark(OperationsPerInvoke = Queries)]
    public double ExactNear()
    {
        var sum = 0.0;
        foreach (var position in _near)
        {
            sum += _exact.TryFindClosest(position, double.PositiveInfinity, _record, out var closest) ? closest.Distance : 0;
        }

        return sum;
    }
}
