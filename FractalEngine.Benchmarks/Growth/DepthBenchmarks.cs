using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Colliders;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>
/// How does the cost of an exact answer grow with the depth? At most linearly, to the depth where sub-fractals are below the precision of a
/// coordinate, and then not at all. One operation is one query.
/// </summary>
public class DepthBenchmarks : IExtraMetrics
{
    private const int Queries = 1024;

    private readonly QueryContext _context = new();
    private Fractal _fractal = null!;
    private Vector[] _positions = null!;
    private ExactFractalCollider _exact = null!;

    [Params("sierpinski", "menger", "tree", "terrain")]
    public string Shape { get; set; } = "";

    [Params(5, 10, 20, 40, 60, 100_000)]
    public int Depth { get; set; }

    [GlobalSetup]
    public void SetUp()
    {
        _fractal = FractalCase.Load(Shape, Depth).Fractal;
        var random = new Random(1);
        _positions = [.. Enumerable.Range(0, Queries).Select(_ => QueryPositions.NearSurface(random, _fractal))];
        _exact = new(_fractal);
    }

    [Benchmark(OperationsPerInvoke = Queries)]
    public double ExactNear()
    {
        var sum = 0.0;
        foreach (var position in _positions)
        {
            sum += _exact.TryFindClosest(position, double.PositiveInfinity, _context, out var closest) ? closest.Distance : 0;
        }

        return sum;
    }

    /// <inheritdoc/>
    IEnumerable<ExtraMetric> IExtraMetrics.MeasureExtra(string method) =>
        ColliderQuality.Measure(() => new ExactFractalCollider(_fractal), _positions, double.PositiveInfinity, null,
        _fractal.Bounds.Diagonal)
        .Where(value => value.Value is not null);
}
