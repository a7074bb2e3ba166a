using System.Globalization;
using Xunit.Abstractions;
using Xunit.Sdk;

namespace FractalEngine.Tests.Stability;

/// <summary>
/// The worst number of each kind that a test has met, written to the test's output at its end: what docs/stability.md states as measured. Any number of threads may note.
/// </summary>
/// <param name="output">Of the test.</param>
internal sealed class StabilityReport(ITestOutputHelper output) : IDisposable
{
    private readonly Dictionary<string, (double Worst, long Count)> _noted = [];
    private readonly Lock _lock = new();

    /// <summary>Keeps the largest; NaN is worse than any number.</summary>
    public void Note(string name, double value)
    {
        lock (_lock)
        {
            var (worst, count) = _noted.GetValueOrDefault(name, (double.NegativeInfinity, 0));
            _noted[name] = (double.IsNaN(value) || value > worst ? value : worst, count + 1);
        }
    }

    /// <summary>Notes an error, and fails where it is larger than promised, or NaN.</summary>
    /// <param name="name">What the error is of.</param>
    /// <param name="error">Not negative.</param>
    /// <param name="bound">The largest allowed.</param>
    /// <param name="about">What repeats the case.</param>
    public void Require(string name, double error, double bound, Func<FormattableString> about)
    {
        Note(name, error);
        if (!(error <= bound))
        {
            throw new XunitException(string.Create(CultureInfo.InvariantCulture, $"{name}: {error:R}, allowed {bound:R}: {about().ToString(CultureInfo.InvariantCulture)}"));
        }
    }

    public void Dispose()
    {
        foreach (var (name, (worst, count)) in _noted)
        {
            output.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{name}: at most {worst:G3} in {count} cases"));
        }
    }
}
