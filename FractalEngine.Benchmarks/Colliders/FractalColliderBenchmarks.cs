using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>
/// What does an exact answer cost beside the paper's descent, and does a query allocate? One operation is one query. Errors are told where
/// the fractal is small enough to look at every face.
/// </summary>
[MemoryDiagnoser]
public class FractalColliderBenchmarks : IExtraMetrics
{
    private const int Queries = 4096;
    private const int ComparedQueries = 512;

    private readonly QueryContext _context = new();
    private Fractal _fractal = null!;
    private Vector[] _nearPositions = null!;
    private Vector[] _farPositions = null!;
    private double _maxDistance;
    private FractalCollider _descent = null!;
    private ExactFractalCollider _exact = null!;

    [Params("sierpinski:5", "sierpinski:8", "tetrahedron:20", "menger:4", "menger:12", "tree:6", "tree:8", "tree:20", "appendix-b:3",
        "appendix-b:5", "terrain:7", "terrain:8")]
    public string Shape { get; set; } = "";

    [GlobalSetup]
    public void SetUp()
    {
        var fractal = FractalCase.Parse(Shape).Fractal;
        _fractal = fractal;
        var random = new Random(1);
        _nearPositions = [.. Enumerable.Range(0, Queries).Select(_ => QueryPositions.NearSurface(random, fractal))];
        _farPositions = [.. Enumerable.Range(0, Queries).Select(_ => QueryPositions.Far(random, fractal.Bounds))];
        (_descent, _exact, _maxDistance) = (new(fractal), new(fractal), DistanceErrors.TouchDistance * fractal.Bounds.Diagonal);
    }

    /// <summary>The baseline: approximate, see <see cref="FractalCollider"/>.</summary>
    [Benchmark(Baseline = true, OperationsPerInvoke = Queries)]
    public double DescentNear() => SumDistances(_descent, _nearPositions, double.PositiveInfinity);

    [Benchmark(OperationsPerInvoke = Queries)]
    public double ExactNear() => SumDistances(_exact, _nearPositions, double.PositiveInfinity);

    /// <summary>What most bodies of a scene ask most of the time: is anything within 2 % of the size, where there is nothing?</summary>
    [Benchmark(OperationsPerInvoke = Queries)]
    public double ExactFarWithinReach() => SumDistances(_exact, _farPositions, _maxDistance);

    /// <inheritdoc/>
    IEnumerable<ExtraMetric> IExtraMetrics.MeasureExtra(string method)
    {
        var isFar = method == nameof(ExactFarWithinReach);
        var positions = (isFar ? _farPositions : _nearPositions)[..ComparedQueries];
        var isSmall = !isFar && _fractal.FaceCount <= BenchmarkShape.MaxFaces;
        return ColliderQuality.Measure(
            method == nameof(DescentNear) ? () => new FractalCollider(_fractal) : () => new ExactFractalCollider(_fractal),
            positions,
            isFar ? _maxDistance : double.PositiveInfinity,
            isSmall ? ColliderQuality.ComputeOracleDistances(FractalGenerator.Flatten(_fractal, BenchmarkShape.MaxFaces), positions) : null,
            _fractal.Bounds.Diagonal);
    }

    private double SumDistances(Collider collider, Vector[] positions, double maxDistance)
    {
        var sum = 0.0;
        foreach (var position in positions)
        {
            sum += collider.TryFindClosest(position, maxDistance, _context, out var closest) ? closest.Distance : 0;
        }

        return sum;
    }
}
