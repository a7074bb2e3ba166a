namespace FractalEngine.Benchmarks.Measuring;

/// <summary>A value that a benchmark reports in a column of its own.</summary>
/// <param name="Column">Name of the column, with its unit.</param>
/// <param name="Value">The value, or null where there is none.</param>
/// <param name="IsPerSecond">True for an amount that the method processes: the column shows how much of it a second.</param>
internal readonly record struct ExtraMetric(string Column, double? Value, bool IsPerSecond = false);
