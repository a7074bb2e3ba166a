using System.Globalization;
using System.Reflection;
using BenchmarkDotNet.Attributes;
using BenchmarkDotNet.Columns;
using BenchmarkDotNet.Reports;
using BenchmarkDotNet.Running;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>Columns of the metrics that benchmarks report themselves, through <see cref="IExtraMetrics"/>.</summary>
internal sealed class ExtraMetricColumns : IColumnProvider
{
    private readonly Dictionary<string, ExtraMetric[]> _measured = [];

    /// <inheritdoc/>
    public IEnumerable<IColumn> GetColumns(Summary summary) => ColumnNames(summary).Select(name => new Column(name, this));

    /// <summary>Names of all columns, in the order in which they are measured.</summary>
    public IEnumerable<string> ColumnNames(Summary summary) =>
        summary.BenchmarksCases.SelectMany(Measure).Select(value => value.Column).Distinct();

    /// <summary>Returns the value of a benchmark in a column, or null where there is none.</summary>
    public double? Value(Summary summary, BenchmarkCase benchmarkCase, string column)
    {
        var measured = Measure(benchmarkCase).FirstOrDefault(value => value.Column == column);
        return measured.IsPerSecond ? measured.Value * 1e9 / summary[benchmarkCase]?.ResultStatistics?.Mean : measured.Value;
    }

    private ExtraMetric[] Measure(BenchmarkCase benchmarkCase)
    {
        var type = benchmarkCase.Descriptor.Type;
        if (!typeof(IExtraMetrics).IsAssignableFrom(type))
        {
            return [];
        }

        var key = $"{type.Name} {benchmarkCase.Descriptor.WorkloadMethod.Name} {benchmarkCase.Parameters.DisplayInfo}";
        if (!_measured.TryGetValue(key, out var values))
        {
            var instance = Activator.CreateInstance(type)!;
            foreach (var parameter in benchmarkCase.Parameters.Items)
            {
                type.GetProperty(parameter.Name)!.SetValue(instance, parameter.Value);
            }

            foreach (var setUp in type.GetMethods().Where(method => method.GetCustomAttribute<GlobalSetupAttribute>() is not null))
            {
                setUp.Invoke(instance, null);
            }

            values = [.. ((IExtraMetrics)instance).MeasureExtra(benchmarkCase.Descriptor.WorkloadMethod.Name)];
            _measured.Add(key, values);
        }

        return values;
    }

    private sealed class Column(string name, ExtraMetricColumns columns) : IColumn
    {
        public string Id => name;

        public string ColumnName => name;

        public string Legend => name;

        public bool AlwaysShow => true;

        public ColumnCategory Category => ColumnCategory.Custom;

        public int PriorityInCategory => 0;

        public bool IsNumeric => true;

        public UnitType UnitType => UnitType.Dimensionless;

        public string GetValue(Summary summary, BenchmarkCase benchmarkCase) =>
            columns.Value(summary, benchmarkCase, name)?.ToString("G4", CultureInfo.InvariantCulture) ?? "–";

        public string GetValue(Summary summary, BenchmarkCase benchmarkCase, SummaryStyle style) => GetValue(summary, benchmarkCase);

        public bool IsAvailable(Summary summary) => true;

        public bool IsDefault(Summary summary, BenchmarkCase benchmarkCase) => false;
    }
}
