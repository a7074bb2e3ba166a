using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>Tables of several runs as one of medians and spreads.</summary>
public sealed class MergeCommandTests : IDisposable
{
    private const string Start = "# rays\n# a machine\nname,count,ms,us\n";

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Merge_OfRuns_TakesMediansAsTheyAreWrittenAndSpreadsOfWhatDiffers() => Assert.Equal(
        "# rays (medians of 3 runs)\n# a machine\nname,count,ms,us,ms_spread_percent,us_spread_percent\n"
        + "\"a,b\",7,2.0,1e1,100.0,20.0\nc,,4,,0.0,\n",
        Merge("\"a,b\",7,3,1e1\nc,,4,\n", "\"a,b\",7,2.0,11\nc,,4,\n", "\"a,b\",7,1,9\nc,,4,\n"));

    [Fact]
    public void Merge_OfFourRuns_TakesTheSecondOfTheMiddle() =>
        Assert.EndsWith("\na,1,2,0,150.0\n", Merge("a,1,4,0\n", "a,1,2,0\n", "a,1,3,0\n", "a,1,1,0\n"), StringComparison.Ordinal);

    [Fact]
    public void Merge_WhereTheMedianIsZero_TakesThePartOfTheLargest() => Assert.EndsWith(
        "\na,1,0,0,100.0\n", Merge("a,1,0,0\n", "a,1,0,0\n", "a,1,5,0\n"), StringComparison.Ordinal);

    [Theory]
    [InlineData("b,1,2,3\n")]
    [InlineData("a,,2,3\n")]
    [InlineData("a,1,2,3\na,1,2,3\n")]
    public void Merge_OfRunsOfDifferentRows_Throws(string rows) =>
        Assert.Contains("t.csv", Assert.Throws<InvalidDataException>(() => Merge("a,1,2,3\n", rows)).Message, StringComparison.Ordinal);

    [Fact]
    public void Run_OfFolders_WritesATableForEachThatTheyHave()
    {
        foreach (var (run, ms) in new[] { ("1", 5), ("2", 4), ("3", 6) })
        {
            _folder.Write($"{run}/t.csv", $"{Start}a,1,{ms},3\n");
            _folder.Write($"{run}/u.csv", $"{Start}a,1,2,3\n");
        }

        var folders = new[] { "1", "2", "3" }.Select(run => _folder[run]);
        Assert.Equal(0, MergeCommand.Run([.. folders.Append("--output").Append(_folder["all"])]));
        Assert.Equal(["a", "1", "5", "3", "40.0"], ParsedCsv.Read(_folder["all/t.csv"]).Rows[0]);
        Assert.Equal(["a", "1", "2", "3"], ParsedCsv.Read(_folder["all/u.csv"]).Rows[0]);
    }

    private static string Merge(params string[] runs) =>
        MergeCommand.Merge([.. runs.Select(rows => ParsedCsv.Parse(Start + rows))], "t.csv");
}
