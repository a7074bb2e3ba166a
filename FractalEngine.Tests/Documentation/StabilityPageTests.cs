using System.Globalization;
using System.Text.RegularExpressions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Documentation;

/// <summary>docs/stability.md states what <c>bench.sh stability</c> has measured.</summary>
public partial class StabilityPageTests
{
    /// <summary>
    /// A row's first cell is what was measured, or begins with it and a colon; its last names the test class, or says that it is the same.
    /// Soak tests stand in brackets.
    /// </summary>
    [Fact]
    public void WorstNumbers_AreThoseOfTheTables()
    {
        var (quick, soak) = (Measured("stability.csv"), Measured("stability-soak.csv"));
        var (tests, compared) = ("", 0);
        foreach (var row in File.ReadLines(Repository.Full("docs/stability.md"))
            .Where(line => line.StartsWith("| ", StringComparison.Ordinal)))
        {
            var cells = row.Split('|')[1..^1];
            tests = TestClass().Match(cells[4]) is { Success: true } named ? named.Groups[1].Value : tests;
            if (tests.EndsWith("StabilityTests", StringComparison.Ordinal) && Worst().Match(cells[3]) is { Success: true } worst)
            {
                Check(row, worst.Groups[1], quick, tests, cells[0].Trim());
                Check(row, worst.Groups[2], soak, tests, cells[0].Trim());
                compared++;
            }
        }

        Assert.True(compared > 25, $"only {compared} rows");
    }

    private static void Check(string row, Group stated, (string Test, string What, double Worst)[] measured, string tests, string what)
    {
        if (!stated.Success)
        {
            return;
        }

        var own = measured.Where(number => number.Test.StartsWith(tests + ".", StringComparison.Ordinal)).ToArray();
        var same = own.Where(number => number.What == what).ToArray();
        var begin = what.Split(':')[0];
        var found = same.Length > 0 ? same : [.. own.Where(number => number.What.Split(':')[0] == begin)];
        Assert.True(found.Length > 0, $"not measured: {row}");
        var worst = found.Max(number => number.Worst);
        // Two digits, as the page has them.
        Assert.True(double.Parse(Rounded(worst), CultureInfo.InvariantCulture)
            .Equals(double.Parse(stated.Value, CultureInfo.InvariantCulture)), $"{Rounded(worst)} is right: {row}");
    }

    /// <summary>What whole tests have met: places of curves are left out.</summary>
    private static (string Test, string What, double Worst)[] Measured(string file) =>
    [
        .. from line in File.ReadLines(Repository.Full($"docs/benchmarks/{file}")).SkipWhile(line => line.StartsWith('#')).Skip(1)
           let cells = line.Split(',')
           where cells[2].Length == 0
           select (cells[0], cells[1], double.Parse(cells[4], CultureInfo.InvariantCulture)),
    ];

    private static string Rounded(double number) => number.ToString("0.0e0", CultureInfo.InvariantCulture);

    [GeneratedRegex(@"^ `(\w+)`")]
    private static partial Regex TestClass();

    [GeneratedRegex(@"^ ([\d.]+(?:e-?\d+)?)(?: \(([\d.]+(?:e-?\d+)?)\))? $")]
    private static partial Regex Worst();
}
