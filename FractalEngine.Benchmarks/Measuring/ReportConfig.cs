using BenchmarkDotNet.Configs;
using BenchmarkDotNet.Jobs;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>BenchmarkDotNet's own report, with more columns, and as a table where a folder is given.</summary>
internal static class ReportConfig
{
    /// <summary>For <c>BenchmarkSwitcher</c>.</summary>
    /// <param name="folder">Of tables; null for none.</param>
    public static IConfig Create(string? folder)
    {
        var columns = new ExtraMetricColumns();
        // With profile-guided tiers what is compiled first counts: the simple collider takes 1.3 ms in a program of its own, and 4 ms among
        // others, which would make these look three times as good as they are. Without profiles it takes 1.8 ms in both.
        var config = DefaultConfig.Instance.AddColumnProvider(columns)
            .AddJob(Job.Default.WithEnvironmentVariable("DOTNET_TieredPGO", "0").AsMutator());
        return folder is null ? config : config.AddExporter(new CsvTableExporter(folder, columns));
    }
}
