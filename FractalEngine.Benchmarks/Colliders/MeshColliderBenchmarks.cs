using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>
/// How much faster than testing every face are the colliders of meshes? One operation is one query, at positions spread over the box or
/// near the surface (within 1 % of the diagonal).
/// </summary>
[MemoryDiagnoser]
public class MeshColliderBenchmarks : IExtraMetrics
{
    // The simple collider gets fewer queries, as each takes a millisecond.
    private const int Queries = 8192;
    private const int SimpleQueries = 32;
    private const int ComparedQueries = 1024;

    private readonly QueryContext _context = new();
    private Mesh _mesh = null!;
    private Vector[] _positions = null!;
    private SimpleCollider _simple = null!;
    private BoundingBoxCollider _boundingBox = null!;
    private HierarchyCollider _hierarchy = null!;

    public enum PositionKind
    {
        Uniform,
        Near,
    }

    [Params("terrain", "tree-stump")]
    public string Mesh { get; set; } = "";

    [Params(PositionKind.Uniform, PositionKind.Near)]
    public PositionKind Positions { get; set; }

    [GlobalSetup]
    public void SetUp()
    {
        var mesh = MeshGenerators.Create(Mesh, 1, 50_000);
        _mesh = mesh;
        var random = new Random(1);
        Func<Vector> nextPosition = Positions == PositionKind.Uniform
            ? () => QueryPositions.Uniform(random, mesh.Bounds)
            : () => QueryPositions.NearSurface(random, mesh);
        _positions = [.. Enumerable.Range(0, Queries).Select(_ => nextPosition())];
        _simple = new(mesh);
        _boundingBox = new(mesh);
        _hierarchy = new(mesh);
    }

    [Benchmark(Baseline = true, OperationsPerInvoke = SimpleQueries)]
    public double Simple() => _simple.SumDistances(_positions.AsSpan(0, SimpleQueries), _context);

    [Benchmark(OperationsPerInvoke = Queries)]
    public double BoundingBox() => _boundingBox.SumDistances(_positions, _context);

    [Benchmark(OperationsPerInvoke = Queries)]
    public double Hierarchy() => _hierarchy.SumDistances(_positions, _context);

    /// <inheritdoc/>
    IEnumerable<ExtraMetric> IExtraMetrics.MeasureExtra(string method)
    {
        var positions = _positions[..(method == nameof(Simple) ? SimpleQueries : ComparedQueries)];
        Func<Collider> build = method switch
        {
            nameof(Simple) => () => new SimpleCollider(_mesh),
            nameof(BoundingBox) => () => new BoundingBoxCollider(_mesh),
            _ => () => new HierarchyCollider(_mesh),
        };
        var oracle = ColliderQuality.ComputeOracleDistances(_mesh, positions);
        return ColliderQuality.Measure(build, positions, double.PositiveInfinity, oracle, _mesh.Bounds.Diagonal);
    }
}
