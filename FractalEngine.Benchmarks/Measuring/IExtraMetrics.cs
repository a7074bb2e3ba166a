namespace FractalEngine.Benchmarks.Measuring;

/// <summary>Benchmarks that report more than time and allocation. See <see cref="ExtraMetricColumns"/>.</summary>
internal interface IExtraMetrics
{
    /// <summary>
    /// Measures what a method does beside taking time. It is called once for each set of parameters, after the set-up, in the process that
    /// writes the report.
    /// </summary>
    /// <param name="method">Name of the benchmark's method.</param>
    IEnumerable<ExtraMetric> MeasureExtra(string method);
}
