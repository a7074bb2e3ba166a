using System.Globalization;
using System.Text.RegularExpressions;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Documentation;

/// <summary>Tests that docs/stability.md states what <c>bench.sh stability</c> has measured.</summary>
public partial class StabilityPageTests
{
    /// <summary>
    /// Compares each row with the tables. Its first cell is what was measured, or begins with that and a colon. Its last names the test
    /// class, or says that it is the same. Numbers of soak tests are in brackets.
    /// </summary>
    [Fact]
    public void WorstNumbers_AreThoseOfTheTables()
    {
        var quick = ReadMeasurements("stability.csv");
        var soak = ReadMeasurements("stability-soak.csv");
        var testClass = "";
        var comparedCount = 0;
        var rows = File.ReadLines(Repository.Full("docs/stability.md")).Where(line => line.StartsWith("| ", StringComparison.Ordinal));
        foreach (var row in rows)
        {
            var cells = row.Split('|')[1..^1];
            testClass = TestClass().Match(cells[4]) is { Success: true } named ? named.Groups[1].Value : testClass;
            if (testClass.EndsWith("StabilityTests", StringComparison.Ordinal) && Worst().Match(cells[3]) is { Success: true } worst)
            {
                AssertStated(row, worst.Groups[1], quick, testClass, cells[0].Trim());
                AssertStated(row, worst.Groups[2], soak, testClass, cells[0].Trim());
                comparedCount++;
            }
        }

        Assert.True(comparedCount > 25, $"only {comparedCount} rows");
    }

    private static void AssertStated(
        string row, Group stated, (string Test, string What, double Worst)[] measured, string testClass, string what)
    {
        if (!stated.Success)
        {
            return;
        }

        var own = measured.Where(number => number.Test.StartsWith(testClass + ".", StringComparison.Ordinal)).ToArray();
        var same = own.Where(number => number.What == what).ToArray();
        var quantity = what.Split(':')[0];
        var found = same.Length > 0 ? same : [.. own.Where(number => number.What.Split(':')[0] == quantity)];
        Assert.True(found.Length > 0, $"not measured: {row}");
        // The page has two digits.
        var worst = found.Max(number => number.Worst).ToString("0.0e0", CultureInfo.InvariantCulture);
        Assert.True(ParsedCsv.ParseNumber(worst).Equals(ParsedCsv.ParseNumber(stated.Value)), $"{worst} is right: {row}");
    }

    /// <summary>Reads what whole tests have met, without the positions of curves.</summary>
    private static (string Test, string What, double Worst)[] ReadMeasurements(string file)
    {
        var table = ParsedCsv.Read(Repository.Full($"docs/benchmarks/{file}"));
        return
        [
            .. from row in table.NamedRows()
               where row("at") == ""
               select (row("test"), row("what"), ParsedCsv.ParseNumber(row("worst"))),
        ];
    }

    [GeneratedRegex(@"^ `(\w+)`")]
    private static partial Regex TestClass();

    [GeneratedRegex(@"^ ([\d.]+(?:e-?\d+)?)(?: \(([\d.]+(?:e-?\d+)?)\))? $")]
    private static partial Regex Worst();
}
