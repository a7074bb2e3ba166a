using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Views;
using FractalEngine.Core.Visibility;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>
/// What does it cost on one core to cull the instances of a frame of 1280 × 720, and is anything allocated? The fractal is the sponge from
/// afar. Of its 3,200,000 instances, culling by frustum and size leaves 163,021, and occlusion culling 87,586 of these.
/// </summary>
[MemoryDiagnoser]
public class VisibleSetBenchmarks
{
    private readonly VisibleSet _set = new();
    private CulledObject[] _objects = [];
    private CullingView _view;

    [GlobalSetup]
    public void SetUp()
    {
        var fractal = FractalCase.Load("menger").Fractal;
        var camera = CameraFraming.Default(fractal.Bounds, FrameCase.Aspect);
        _objects = [new(LodHierarchy.Build(fractal), AffineMap.Identity, fractal.BaseMesh.Bounds.Centre, 1)];
        _view = new(
            camera.Position, camera.LocalAxes, true, camera.HalfHeightAtUnitDepth, FrameCase.Width, FrameCase.Height, FrameCase.Aspect,
            1e-3 * fractal.Bounds.Diagonal, double.PositiveInfinity);
    }

    /// <summary>Runs the baseline, which keeps every instance.</summary>
    [Benchmark(Baseline = true)]
    public int Everything() => Cull(new() { OcclusionCulling = false, MinProjectedSize = 0, InstanceBudget = 4_000_000, ThreadCount = 1 });

    [Benchmark]
    public int ViewAndSize() => Cull(new() { OcclusionCulling = false, MinProjectedSize = 8, InstanceBudget = 4_000_000, ThreadCount = 1 });

    [Benchmark]
    public int ViewSizeAndCoverage() => Cull(new() { ThreadCount = 1 });

    private int Cull(CullingSettings settings)
    {
        _set.Cull(in _view, _objects, settings);
        return _set.InstanceCount;
    }
}
