using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Precision;

/// <summary>
/// Float or double? The distance of a position from a face by the same operations in both, and by the engine's own kernel, which also finds
/// the point, its weights and the feature. One operation is one face; errors are against fractions.
/// </summary>
public class PrecisionBenchmarks : IExtraMetrics
{
    private FloatVersusDouble.Measurement _single = null!;
    private FloatVersusDouble.Measurement _double = null!;
    private FloatVersusDouble.Measurement _engine = null!;

    [ParamsSource(nameof(Names))]
    public string Coordinates { get; set; } = "";

    /// <summary>Where the faces are, or of what form.</summary>
    public static IEnumerable<string> Names => FloatVersusDouble.CoordinateSets.Select(set => set.Name);

    [GlobalSetup]
    public void SetUp()
    {
        var set = FloatVersusDouble.CoordinateSets.First(set => set.Name == Coordinates);
        (_single, _double, _engine) = (FloatVersusDouble.MeasureTriangles<float>(set), FloatVersusDouble.MeasureTriangles<double>(set),
            FloatVersusDouble.MeasureEngineKernel(set));
    }

    [Benchmark(Baseline = true, OperationsPerInvoke = FloatVersusDouble.CaseCount)]
    public void Doubles() => _double.Run();

    [Benchmark(OperationsPerInvoke = FloatVersusDouble.CaseCount)]
    public void Floats() => _single.Run();

    [Benchmark(OperationsPerInvoke = FloatVersusDouble.CaseCount)]
    public void Engine() => _engine.Run();

    /// <inheritdoc/>
    IEnumerable<ExtraMetric> IExtraMetrics.MeasureExtra(string method)
    {
        var measured = method switch
        {
            nameof(Floats) => _single,
            nameof(Doubles) => _double,
            _ => _engine,
        };
        return [new("largest_error", measured.WorstError), new("too_far_percent", measured.PercentAboveExact)];
    }
}
