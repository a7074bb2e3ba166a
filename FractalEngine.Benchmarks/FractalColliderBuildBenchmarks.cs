using BenchmarkDotNet.Attributes;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Benchmarks;

/// <summary>How long does it take to build the exact collider of a fractal? How large it is, the command <c>table</c> says.</summary>
public class FractalColliderBuildBenchmarks
{
    private Fractal _fractal = null!;

    [ParamsSource(nameof(Names))]
    public string Fractal { get; set; } = "";

    /// <summary>All fractals of the assets.</summary>
    public static IEnumerable<string> Names => FractalCase.Names;

    [GlobalSetup]
    public void SetUp() => _fractal = FractalCase.Load(Fractal).Fractal;

    /// <summary>The baseline: a box around the fractal, which anything that shows it needs.</summary>
    [Benchmark(Baseline = true)]
    public BoundingBox Bounds() => new Fractal(_fractal.Description, _fractal.BaseMesh).Bounds;

    [Benchmark]
    public Collider Exact() => new ExactFractalCollider(_fractal);
}
