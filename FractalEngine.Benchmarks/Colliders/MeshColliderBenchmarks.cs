using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>
/// How much faster than looking at every face are the colliders of meshes? One operation is one query, for positions spread over the
/// box or near the surface (within 1 % of the diagonal).
/// </summary>
[MemoryDiagnoser]
public class MeshColliderBenchmarks : IExtraMetrics
{
    // The simple collider is asked for fewer, since it takes a millisecond each.
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
        _positions =
            [.. Enumerable.Range(0, Queries)
            .Select(_ => Positions == PositionKind.Uniform
            ? QueryPositions.Uniform(random, mesh.Bounds)
            : QueryPositions.NearSurface(random, mesh))];
        (_simple, _boundingBox, _hierarchy) = (new(mesh), new(mesh), new(mesh));
    }

    [Benchmark(Baseline = true, OperationsPerInvoke = SimpleQueries)]
    public double Simple() => SumDistances(_simple, SimpleQueries);

    [Benchmark(OperationsPerInvoke = Queries)]
    public double BoundingBox() => SumDistances(_boundingBox, Queries);

    [Benchmark(OperationsPerInvoke = Queries)]
    public double Hierarchy() => SumDistances(_hierarchy, Queries);

    /// <inheritdoc/>
    IEnumerable<ExtraMetric> IExtraMetrics.MeasureExtra(string method)
    {
        var positions = _positions[..ComparedQueries];
        return ColliderQuality.Measure(
            method switch
            {
                nameof(Simple) => () => new SimpleCollider(_mesh),
                nameof(BoundingBox) => () => new BoundingBoxCollider(_mesh),
                _ => () => new HierarchyCollider(_mesh),
            },
            method == nameof(Simple) ? positions[..SimpleQueries] : positions,
            double.PositiveInfinity,
            ColliderQuality.ComputeOracleDistances(_mesh, positions)[..(method == nameof(Simple) ? SimpleQueries : ComparedQueries)],
            _mesh.Bounds.Diagonal);
    }

    private double SumDistances(Collider collider, int queries)
    {
        var sum = 0.0;
        foreach (var position in _positions.AsSpan(0, queries))
        {
            sum += collider.TryFindClosest(position, double.PositiveInfinity, _context, out var closest) ? closest.Distance : 0;
        }

        return sum;
    }
}
