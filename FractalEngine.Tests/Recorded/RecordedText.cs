using System.Globalization;
using System.Text.RegularExpressions;
using FractalEngine.Tests.Support;
using Xunit.Sdk;

namespace FractalEngine.Tests.Recorded;

/// <summary>
/// Compares what the product says now with what it said when it was last looked at: files of this folder. Oracles show that a result is
/// right; these show that it is the same, and that it cost the same work. Where a change is meant, rewrite the files and read the
/// difference: <c>REWRITE_RECORDED=1 dotnet test FractalEngine.Tests --filter Recorded</c>.
/// </summary>
internal static partial class RecordedText
{
    private const int MaxDifferences = 8;

    /// <summary>Compares lines with those of a file.</summary>
    /// <param name="file">Name of the file in this folder.</param>
    /// <param name="lines">Texts without line breaks.</param>
    /// <param name="tolerance">
    /// Greatest difference of two numbers with a point or an exponent, relative to the larger: what another processor or library of
    /// mathematics may round differently. Integers and all else are the same, or differ.
    /// </param>
    public static void Check(string file, IEnumerable<string> lines, double tolerance = 1e-11)
    {
        string path = Repository.Full("FractalEngine.Tests/Recorded/" + file);
        string[] actual = [.. lines];
        Assert.NotEmpty(actual);
        if (Environment.GetEnvironmentVariable("REWRITE_RECORDED") is "1")
        {
            File.WriteAllLines(path, actual);
            return;
        }

        string[] expected = File.ReadAllLines(path);
        var differences = Enumerable.Range(0, Math.Max(expected.Length, actual.Length))
            .Select(i => (Line: i + 1, Expected: expected.ElementAtOrDefault(i) ?? "", Actual: actual.ElementAtOrDefault(i) ?? ""))
            .Where(pair => !AreSame(pair.Expected, pair.Actual, tolerance))
            .Select(pair => $"{file}:{pair.Line}\n  - {pair.Expected}\n  + {pair.Actual}").ToArray();
        if (differences.Length > 0)
        {
            throw new XunitException($"""
                {differences.Length} of {expected.Length} lines differ; if that is meant, REWRITE_RECORDED=1 writes them anew
                {string.Join('\n', differences.Take(MaxDifferences))}
                """);
        }
    }

    /// <summary>Writes a number so that all of its bits are kept, with a point or an exponent.</summary>
    public static string Text(double value)
    {
        string text = value.ToString("R", CultureInfo.InvariantCulture);
        return double.IsFinite(value) && !text.Contains('.', StringComparison.Ordinal) && !text.Contains('E', StringComparison.Ordinal)
            ? text + ".0"
            : text;
    }

    private static bool AreSame(string expected, string actual, double tolerance)
    {
        if (expected == actual)
        {
            return true;
        }

        string[] words = Numbers().Split(expected), others = Numbers().Split(actual);
        return words.Length == others.Length && words.Zip(others).All(pair => pair.First == pair.Second
            || (IsNumber(pair.First) && IsNumber(pair.Second)
                && Difference(Number(pair.First), Number(pair.Second)) <= tolerance));
    }

    private static double Difference(double first, double second) =>
        Math.Abs(first - second) / Math.Max(Math.Abs(first), Math.Abs(second));

    private static bool IsNumber(string word) => word.AsSpan().IndexOfAny('.', 'E') >= 0 && Numbers().Match(word).Length == word.Length;

    private static double Number(string word) => double.Parse(word, CultureInfo.InvariantCulture);

    [GeneratedRegex(@"(-?\d+(?:\.\d+)?(?:E[+-]\d+)?)")]
    private static partial Regex Numbers();
}
