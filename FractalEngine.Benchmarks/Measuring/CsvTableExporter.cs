using BenchmarkDotNet.Exporters;
using BenchmarkDotNet.Loggers;
using BenchmarkDotNet.Reports;
using BenchmarkDotNet.Running;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>
/// Exports the report of a class of benchmarks as a table of the project's form. The file has the name of the class in lower case.
/// </summary>
/// <param name="folder">Folder of the file.</param>
/// <param name="columns">Columns beside time and allocation.</param>
internal sealed class CsvTableExporter(string folder, ExtraMetricColumns columns) : IExporter
{
    private static readonly string[] MeasuredColumns =
        ["method", "mean_ns", "standard_deviation_ns", "ratio_to_baseline", "allocated_bytes"];

    /// <inheritdoc/>
    public string Name => nameof(CsvTableExporter);

    /// <inheritdoc/>
    public void ExportToLog(Summary summary, ILogger logger)
    {
    }

    /// <inheritdoc/>
    public IEnumerable<string> ExportToFiles(Summary summary, ILogger consoleLogger)
    {
        var type = summary.BenchmarksCases[0].Descriptor.Type.Name;
        var parameters = summary.BenchmarksCases.SelectMany(item => item.Parameters.Items).Select(item => item.Name).Distinct().ToArray();
        var extraColumns = columns.ColumnNames(summary).ToArray();
        var file = Path.Combine(folder, $"{type.Replace("Benchmarks", "", StringComparison.Ordinal).ToLowerInvariant()}-classes.csv");
        var table = new CsvTable(
            file, $"--filter *.{type}.*", [.. parameters.Select(name => name.ToLowerInvariant()), .. MeasuredColumns, .. extraColumns]);
        foreach (var item in summary.BenchmarksCases)
        {
            if (summary[item] is not { ResultStatistics: { } statistics } report)
            {
                throw new InvalidDataException($"{type}.{item.Descriptor.WorkloadMethod.Name} has no result");
            }

            table.Add(
            [
                .. parameters.Select(name => item.Parameters[name]),
                item.Descriptor.WorkloadMethod.Name,
                Math.Round(statistics.Mean, 3),
                Math.Round(statistics.StandardDeviation, 3),
                RatioToBaseline(summary, item, statistics.Mean),
                report.GcStats.GetBytesAllocatedPerOperation(item),
                .. extraColumns.Select(name => (object?)columns.Value(summary, item, name)),
            ]);
        }

        table.Save();
        return [file];
    }

    private static double? RatioToBaseline(Summary summary, BenchmarkCase item, double mean) =>
        summary.GetBaseline(summary.GetLogicalGroupKey(item)) is { } baseline && summary[baseline]?.ResultStatistics is { } statistics
        ? Math.Round(mean / statistics.Mean, 6)
        : null;
}
