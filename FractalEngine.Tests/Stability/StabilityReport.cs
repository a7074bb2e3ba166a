using System.Globalization;
using System.Runtime.CompilerServices;
using FractalEngine.Benchmarks.Measuring;
using Xunit.Abstractions;
using Xunit.Sdk;

namespace FractalEngine.Tests.Stability;

/// <summary>
/// Keeps the worst number of each kind that a test has met, which docs/stability.md states as measured. It is written to the test's output
/// at its end. Where the environment variable FRACTALENGINE_STABILITY names a folder, a file there holds the same: a part of
/// docs/benchmarks/stability.csv. Any number of threads may record.
/// </summary>
/// <param name="output">Output of the test.</param>
/// <param name="argument">Argument that tells the cases of a theory apart.</param>
/// <param name="method">Name of the test's method.</param>
/// <param name="file">Path of the test class's file, which has its name.</param>
internal sealed class StabilityReport(ITestOutputHelper output, object? argument = null, [CallerMemberName] string method = "",
    [CallerFilePath] string file = "") : IDisposable
{
    private readonly Dictionary<(string What, double? At), Measurement> _measurements = [];
    private readonly Lock _lock = new();

    /// <summary>Name of the test: class, method, argument.</summary>
    public string Test { get; } = $"{Path.GetFileNameWithoutExtension(file)}.{method}"
        + (argument is null ? "" : string.Create(CultureInfo.InvariantCulture, $"({argument})"));

    /// <summary>Records a value, of which the largest is kept. NaN is worse than any number.</summary>
    /// <param name="what">Name of the quantity.</param>
    /// <param name="value">The value.</param>
    /// <param name="at">Position on a curve: one of few, each of which has a largest of its own too.</param>
    public void Record(string what, double value, double? at = null) => Add(what, value, null, at);

    /// <summary>Records an error, and fails where it is larger than promised, or NaN.</summary>
    /// <param name="what">Name of the quantity.</param>
    /// <param name="error">The error, not negative.</param>
    /// <param name="bound">Largest error that is allowed.</param>
    /// <param name="describeCase">Describes the case so that it can be repeated.</param>
    /// <param name="at">Position on a curve.</param>
    public void Require(string what, double error, double bound, Func<FormattableString> describeCase, double? at = null)
    {
        Add(what, error, bound, at);
        if (!(error <= bound))
        {
            var description = describeCase().ToString(CultureInfo.InvariantCulture);
            throw new XunitException(FormattableString.Invariant($"{what}: {error:R}, allowed {bound:R}: {description}"));
        }
    }

    /// <summary>
    /// Writes what was recorded to a file of the test's own. Of each quantity the whole test comes first, then each position of its curve,
    /// in whatever order they were recorded.
    /// </summary>
    /// <param name="folder">Folder of the file, created where it is missing.</param>
    /// <exception cref="IOException">The folder can't be written to, or has a test of this name already.</exception>
    public void Save(string folder)
    {
        var path = Path.Combine(folder, Uri.EscapeDataString(Test) + ".csv");
        if (File.Exists(path))
        {
            throw new IOException($"{path}: a test of this name is there already");
        }

        var table = new CsvTable(path, "stability", "test", "what", "at", "cases", "worst", "promised");
        var ordered = _measurements.OrderBy(item => item.Key.What, StringComparer.Ordinal).ThenBy(item => item.Key.At);
        foreach (var ((what, at), measurement) in ordered)
        {
            table.Add(Test, what, at, measurement.Cases, measurement.WorstValue, measurement.Promised);
        }

        table.Save();
    }

    public void Dispose()
    {
        foreach (var ((what, at), measurement) in _measurements)
        {
            if (at is null)
            {
                output.WriteLine(
                    FormattableString.Invariant($"{what}: at most {measurement.WorstValue:G3} in {measurement.Cases} cases"));
            }
        }

        if (Environment.GetEnvironmentVariable("FRACTALENGINE_STABILITY") is { Length: > 0 } folder)
        {
            Save(folder);
        }
    }

    private void Add(string what, double value, double? promised, double? at)
    {
        lock (_lock)
        {
            _measurements[(what, null)] = _measurements.GetValueOrDefault((what, null), Measurement.Nothing).With(value, promised);
            if (at is not null)
            {
                _measurements[(what, at)] = _measurements.GetValueOrDefault((what, at), Measurement.Nothing).With(value, promised);
            }
        }
    }

    /// <summary>The worst of some cases.</summary>
    /// <param name="Cases">Number of cases.</param>
    /// <param name="WorstValue">Largest of their values.</param>
    /// <param name="Promised">Bound of the worst case, as bounds may differ; the smallest where several are as bad.</param>
    private readonly record struct Measurement(long Cases, double WorstValue, double? Promised)
    {
        public static readonly Measurement Nothing = new(0, double.NegativeInfinity, null);

        public Measurement With(double value, double? promised)
        {
            var isWorse = value > WorstValue
                || (double.IsNaN(value) && !double.IsNaN(WorstValue))
                || (value.Equals(WorstValue) && promised < Promised);
            return isWorse ? new(Cases + 1, value, promised) : this with { Cases = Cases + 1 };
        }
    }
}
