using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>Benchmarks of nothing that report more than time.</summary>
public class CountedBenchmarks : IExtraMetrics
{
    private int _double;

    [Params(3, 5)]
    public int Size { get; set; }

    [GlobalSetup]
    public void SetUp() => _double = 2 * Size;

    [Benchmark(Baseline = true)]
    public int First() => _double;

    [Benchmark]
    public int Second() => _double + 1;

    /// <inheritdoc/>
    IEnumerable<ExtraMetric> IExtraMetrics.MeasureExtra(string method) =>
    [
        new("double_size", _double), new("only_second", method == nameof(Second) ? 0.5 : null),
        new("amount_a_second", _double, IsPerSecond: true),
    ];
}
