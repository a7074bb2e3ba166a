namespace FractalEngine.Benchmarks.Measuring;

/// <summary>Benchmarks that know more of their methods than time and allocation. See <see cref="ExtraMetricColumns"/>.</summary>
internal interface IExtraMetrics
{
    /// <summary>
    /// What a method does, beside taking time; asked once for each set of parameters, after the set-up, in the process that writes the
    /// report.
    /// </summary>
    /// <param name="method">Its name.</param>
    IEnumerable<ExtraMetric> MeasureExtra(string method);
}

/// <summary>A value in a column of its own.</summary>
/// <param name="Column">Its name, with a unit.</param>
/// <param name="Value">Null where there is none.</param>
/// <param name="IsPerSecond">An amount that the method works off: the column shows how much of it a second.</param>
internal readonly record struct ExtraMetric(string Column, double? Value, bool IsPerSecond = false);
