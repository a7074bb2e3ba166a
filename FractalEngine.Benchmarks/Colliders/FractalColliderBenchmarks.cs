using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>
/// What does an exact result cost beside the paper's descent, and does a query allocate? One operation is one query. There are errors where
/// the fractal is small enough for testing every face.
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
        _maxDistance = DistanceErrors.TouchDistance * fractal.Bounds.Diagonal;
        _descent = new(fractal);
        _exact = new(fractal);
    }

    /// <summary>Runs the baseline, which is approximate: see <see cref="FractalCollider"/>.</summary>
    [Benchmark(Baseline = true, OperationsPerInvoke = Queries)]
    public double DescentNear() => _descent.SumDistances(_nearPositions, _context);

    [Benchmark(OperationsPerInvoke = Queries)]
    public double ExactNear() => _exact.SumDistances(_nearPositions, _context);

    /// <summary>Asks what most bodies ask most of the time: is anything within 2 % of the size, where there is nothing?</summary>
    [Benchmark(OperationsPerInvoke = Queries)]
    public double ExactFarWithinReach() => _exact.SumDistances(_farPositions, _context, _maxDistance);

    /// <inheritdoc/>
    IEnumerable<ExtraMetric> IExtraMetrics.MeasureExtra(string method)
    {
        var isFar = method == nameof(ExactFarWithinReach);
        var positions = (isFar ? _farPositions : _nearPositions)[..ComparedQueries];
        var hasOracle = !isFar && _fractal.FaceCount <= BenchmarkShape.MaxFaces;
        var oracle = hasOracle
            ? ColliderQuality.ComputeOracleDistances(FractalGenerator.Flatten(_fractal, BenchmarkShape.MaxFaces), positions)
            : null;
        Func<Collider> build = method == nameof(DescentNear)
            ? () => new FractalCollider(_fractal)
            : () => new ExactFractalCollider(_fractal);
        return ColliderQuality.Measure(
            build, positions, isFar ? _maxDistance : double.PositiveInfinity, oracle, _fractal.Bounds.Diagonal);
    }
}
