using System.Globalization;
using System.Runtime.CompilerServices;
using FractalEngine.Benchmarks.Measuring;
using Xunit.Abstractions;
using Xunit.Sdk;

namespace FractalEngine.Tests.Stability;

/// <summary>
/// The worst number of each kind that a test has met, written to the test's output at its end: what docs/stability.md states as measured.
/// Any number of threads may note. Where the environment variable FRACTALENGINE_STABILITY names a folder, a file there holds the same: a
/// part of docs/benchmarks/stability.csv.
/// </summary>
/// <param name="output">Of the test.</param>
/// <param name="argument">What tells the cases of a theory apart.</param>
/// <param name="method">The test's.</param>
/// <param name="file">The test class's, which has its name.</param>
internal sealed class StabilityReport(ITestOutputHelper output, object? argument = null, [CallerMemberName] string method = "",
    [CallerFilePath] string file = "") : IDisposable
{
    private readonly Dictionary<(string What, double? At), Measurement> _measurements = [];
    private readonly Lock _lock = new();

    /// <summary>Class, method, argument.</summary>
    public string Test { get; } = $"{Path.GetFileNameWithoutExtension(file)}.{method}"
        + (argument is null ? "" : string.Create(CultureInfo.InvariantCulture, $"({argument})"));

    /// <summary>Keeps the largest; NaN is worse than any number.</summary>
    /// <param name="what">What the value is of.</param>
    /// <param name="value">The value.</param>
    /// <param name="at">Where on a curve: one of few places, each of which has its own largest too.</param>
    public void Record(string what, double value, double? at = null) => Add(what, value, null, at);

    /// <summary>Notes an error, and fails where it is larger than promised, or NaN.</summary>
    /// <param name="what">What the error is of.</param>
    /// <param name="error">Not negative.</param>
    /// <param name="bound">The largest allowed.</param>
    /// <param name="describeCase">What repeats the case.</param>
    /// <param name="at">Where on a curve.</param>
    public void Require(string what, double error, double bound, Func<FormattableString> describeCase, double? at = null)
    {
        Add(what, error, bound, at);
        if (!(error <= bound))
        {
            throw new XunitException(
                string.Create(CultureInfo.InvariantCulture,
                $"{what}: {error:R}, allowed {bound:R}: {describeCase().ToString(CultureInfo.InvariantCulture)}"));
        }
    }

    /// <summary>
    /// Writes what was noted to a file of the test's own: the whole test first, then each place of its curves, whatever order it was noted
    /// in.
    /// </summary>
    /// <param name="folder">Made where it is missing.</param>
    /// <exception cref="IOException">The folder can't be written to, or has a test of this name already.</exception>
    public void Save(string folder)
    {
        var path = Path.Combine(folder, Uri.EscapeDataString(Test) + ".csv");
        if (File.Exists(path))
        {
            throw new IOException($"{path}: a test of this name is there already");
        }

        var table = new CsvTable(path, "stability", "test", "what", "at", "cases", "worst", "promised");
        foreach (var ((what, at), measurement) in _measurements.OrderBy(item => item.Key.What, StringComparer.Ordinal)
            .ThenBy(item => item.Key.At))
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
                    string.Create(CultureInfo.InvariantCulture,
                    $"{what}: at most {measurement.WorstValue:G3} in {measurement.Cases} cases"));
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

    /// <param name="Cases">How many.</param>
    /// <param name="WorstValue">Of their values.</param>
    /// <param name="Promised">The bound of the worst, which may differ from case to case; the smallest where several are as bad.</param>
    private readonly record struct Measurement(long Cases, double WorstValue, double? Promised)
    {
        public static readonly Measurement Nothing = new(0, double.NegativeInfinity, null);

        public Measurement With(double value, double? promised)
        {
            var isWorse = value > WorstValue || (double.IsNaN(value) && !double.IsNaN(WorstValue))
                || (value.Equals(WorstValue) && promised < Promised);
            return isWorse ? new(Cases + 1, value, promised) : this with { Cases = Cases + 1 };
        }
    }
}
