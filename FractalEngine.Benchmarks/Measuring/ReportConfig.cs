using BenchmarkDotNet.Configs;
using BenchmarkDotNet.Jobs;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>Creates BenchmarkDotNet's configuration: its own report with more columns.</summary>
internal static class ReportConfig
{
    /// <summary>Creates the configuration for <c>BenchmarkSwitcher</c>.</summary>
    /// <param name="folder">Folder in which each class also writes a table; null for no tables.</param>
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
