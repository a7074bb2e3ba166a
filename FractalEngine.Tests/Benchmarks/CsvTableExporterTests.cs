using BenchmarkDotNet.Columns;
using BenchmarkDotNet.Configs;
using BenchmarkDotNet.Jobs;
using BenchmarkDotNet.Loggers;
using BenchmarkDotNet.Reports;
using BenchmarkDotNet.Running;
using BenchmarkDotNet.Toolchains.InProcess.NoEmit;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>Tests the table of a class of benchmarks by a run in this process, of which all but the times is known.</summary>
public sealed class CsvTableExporterTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void ExportToFiles_OfARun_HasARowForEachMethodAndParameter()
    {
        var columns = new ExtraMetricColumns();
        var summary = Run(columns);
        Assert.Empty(summary.ValidationErrors.Where(error => error.IsCritical));
        var file = Assert.Single(new CsvTableExporter(_folder.Path, columns).ExportToFiles(summary, NullLogger.Instance));
        Assert.Equal(_folder["counted-classes.csv"], file);
        var table = ParsedCsv.Read(file);
        Assert.Equal("# --filter *.CountedBenchmarks.*", table.Comments[0]);
        Assert.Equal(
            [
                "size", "method", "mean_ns", "standard_deviation_ns", "ratio_to_baseline", "allocated_bytes", "double_size", "only_second",
                "amount_a_second",
            ],
            table.Header);
        Assert.Equal(
            [("3", "First", "6", ""), ("3", "Second", "6", "0.5"), ("5", "First", "10", ""), ("5", "Second", "10", "0.5")],
            table.NamedRows().Select(row => (row("size"), row("method"), row("double_size"), row("only_second"))));
        Assert.All(table.NamedRows(), row =>
        {
            var mean = ParsedCsv.ParseNumber(row("mean_ns"));
            Assert.True(mean > 0);
            // Written to a thousandth of a nanosecond.
            Assert.Equal(ParsedCsv.ParseNumber(row("double_size")) * 1e9, ParsedCsv.ParseNumber(row("amount_a_second")) * mean,
                0.001 * ParsedCsv.ParseNumber(row("amount_a_second")));
            var baselineRow = table.NamedRows().Single(other => (other("size"), other("method")) == (row("size"), "First"));
            var ratio = mean / ParsedCsv.ParseNumber(baselineRow("mean_ns"));
            Assert.Equal(ratio, ParsedCsv.ParseNumber(row("ratio_to_baseline")), 1e-5 * (1 + ratio));
        });
        IColumn[] shown = [.. columns.GetColumns(summary)];
        Assert.Equal(["double_size", "only_second", "amount_a_second"], shown.Select(column => column.ColumnName));
        Assert.Equal(["6", "–"], shown[..2].Select(column => column.GetValue(summary, summary.BenchmarksCases[0])));
    }

    private Summary Run(ExtraMetricColumns columns) => BenchmarkRunner.Run<CountedBenchmarks>(ManualConfig.CreateEmpty()
        .AddJob(Job.Dry.WithToolchain(InProcessNoEmitToolchain.Instance))
        .AddColumnProvider(columns)
        .AddLogger(NullLogger.Instance)
        .WithOptions(ConfigOptions.DisableOptimizationsValidator)
        .WithArtifactsPath(_folder["artifacts"]));
}
