using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>How long does it take to build the colliders of meshes, and how large are they?</summary>
public class MeshColliderBuildBenchmarks : IExtraMetrics
{
    private Mesh _mesh = null!;

    [Params(50_000, 1_000_000)]
    public int Faces { get; set; }

    [GlobalSetup]
    public void SetUp() => _mesh = MeshGenerators.Create("terrain", 1, Faces);

    /// <summary>Runs the baseline: reads every vertex of every face once.</summary>
    [Benchmark(Baseline = true)]
    public double ReadAllCorners()
    {
        var sum = 0.0;
        for (var face = 0; face < _mesh.FaceCount; face++)
        {
            var (a, b, c) = _mesh.Face(face);
            sum += a.X + b.Y + c.Z;
        }

        return sum;
    }

    [Benchmark]
    public Collider BoundingBox() => new BoundingBoxCollider(_mesh);

    [Benchmark]
    public Collider Hierarchy() => new HierarchyCollider(_mesh);

    /// <inheritdoc/>
    IEnumerable<ExtraMetric> IExtraMetrics.MeasureExtra(string method)
    {
        Collider? collider = method switch
        {
            nameof(BoundingBox) => BoundingBox(),
            nameof(Hierarchy) => Hierarchy(),
            _ => null,
        };
        return
        [
            new("million_faces_a_second", Faces / 1e6, IsPerSecond: true),
            new("bytes_a_face", (double?)collider?.StorageBytes / Faces),
        ];
    }
}
