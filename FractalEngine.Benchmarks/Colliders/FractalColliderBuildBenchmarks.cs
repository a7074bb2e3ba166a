using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>How long does it take to build the exact collider of a fractal, and how large is it?</summary>
public class FractalColliderBuildBenchmarks : IExtraMetrics
{
    private Fractal _fractal = null!;

    [ParamsSource(nameof(Names))]
    public string Shape { get; set; } = "";

    /// <summary>Names of all fractals of the assets.</summary>
    public static IEnumerable<string> Names => FractalCase.Names;

    [GlobalSetup]
    public void SetUp() => _fractal = FractalCase.Load(Shape).Fractal;

    /// <summary>Runs the baseline: a box around the fractal, which whatever draws the fractal needs anyway.</summary>
    [Benchmark(Baseline = true)]
    public BoundingBox Bounds() => new Fractal(_fractal.Description, _fractal.BaseMesh).Bounds;

    [Benchmark]
    public Collider Exact() => new ExactFractalCollider(FractalCase.Copy(_fractal));

    /// <inheritdoc/>
    IEnumerable<ExtraMetric> IExtraMetrics.MeasureExtra(string method) =>
        [new("bytes", method == nameof(Exact) ? Exact().StorageBytes : null)];
}
