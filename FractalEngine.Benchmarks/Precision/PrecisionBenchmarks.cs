using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Precision;

/// <summary>
/// Float or double? The distance of a position from a face by the same operations in both, and by the engine's own kernel, which also finds
/// the point, its weights and the feature. One operation is one face; errors are against fractions.
/// </summary>
public class PrecisionBenchmarks : IMeasuresMore
{
    private FloatAndDouble.Measured _single = null!;
    private FloatAndDouble.Measured _double = null!;
    private FloatAndDouble.Measured _engine = null!;

    [ParamsSource(nameof(Names))]
    public string Coordinates { get; set; } = "";

    /// <summary>Where the faces are, or of what form.</summary>
    public static IEnumerable<string> Names => FloatAndDouble.Sets.Select(set => set.Name);

    [GlobalSetup]
    public void SetUp()
    {
        var set = FloatAndDouble.Sets.First(set => set.Name == Coordinates);
        (_single, _double, _engine) = (FloatAndDouble.Faces<float>(set), FloatAndDouble.Faces<double>(set), FloatAndDouble.Engine(set));
    }

    [Benchmark(Baseline = true, OperationsPerInvoke = FloatAndDouble.Cases)]
    public void Doubles() => _double.Time();

    [Benchmark(OperationsPerInvoke = FloatAndDouble.Cases)]
    public void Floats() => _single.Time();

    [Benchmark(OperationsPerInvoke = FloatAndDouble.Cases)]
    public void Engine() => _engine.Time();

    /// <inheritdoc/>
    IEnumerable<MoreValue> IMeasuresMore.Measure(string method)
    {
        var measured = method switch
        {
            nameof(Floats) => _single,
            nameof(Doubles) => _double,
            _ => _engine,
        };
        return [new("largest_error", measured.WorstError), new("too_far_percent", measured.Above)];
    }
}
