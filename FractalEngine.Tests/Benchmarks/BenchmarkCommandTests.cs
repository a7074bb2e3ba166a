using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>Runs the benchmarks' program. Wrong arguments end it before anything is measured or written.</summary>
[Collection(ConsoleTests.Name)]
public sealed class BenchmarkCommandTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    private static readonly string[] Names =
    [
        "front", "growth", "loading", "frames", "skips", "window", "compare", "rays", "trace", "light", "physics", "precision", "paper",
        "approximate", "merge",
    ];

    public static TheoryData<string> Commands => [.. Names];

    private static IEnumerable<string> Classes => typeof(CommandLineParser).Assembly.GetTypes().Select(type => type.Name)
        .Where(name => name.EndsWith("Benchmarks", StringComparison.Ordinal)).Order(StringComparer.Ordinal);

    public void Dispose() => _folder.Dispose();

    [Theory]
    [MemberData(nameof(Commands))]
    public void Run_OfACommandWithAnUnknownWord_IsWrongUsage(string command) => AssertRefused(command, "nonsense", "nonsense");

    [Theory]
    [InlineData("front --quick --nonsense", "--nonsense")]
    [InlineData("front tree:0", "tree:0")]
    [InlineData("physics --balls 0", "--balls")]
    [InlineData("frames menger:1:2:afar", "menger:1:2:afar")]
    [InlineData("skips nothing.sdo", "nothing.sdo")]
    public void Run_OfWordsThatMakeNoSense_NamesTheFirst(string words, string unexpected) => CheckNoSense(words, unexpected);

    [Theory]
    [InlineData("front tree: --quick", "tree:")]
    [InlineData("front tree:2:2", "tree:2:2")]
    [InlineData("front Tree", "Tree")]
    [InlineData("front --output", "--output")]
    [InlineData("physics --balls", "--balls")]
    [InlineData("physics --balls -5", "--balls")]
    [InlineData("physics --rounds 1.5", "--rounds")]
    [InlineData("physics --rounds 99999999999", "--rounds")]
    [InlineData("physics tree-stump", "tree-stump")]
    [InlineData("growth growth-nothing", "growth-nothing")]
    [InlineData("loading --quick --rounds", "--rounds")]
    [InlineData("frames menger", "menger")]
    [InlineData("frames menger:3", "menger:3")]
    [InlineData("frames menger:x:afar", "menger:x:afar")]
    [InlineData("frames :afar", ":afar")]
    [InlineData("frames --samples -1", "--samples")]
    [InlineData("physics --collider best", "--collider")]
    [InlineData("physics --balls none", "--balls")]
    [InlineData("window nothing.sdo", "nothing.sdo")]
    [InlineData("compare --threshold -1", "--threshold")]
    [InlineData("paper --quick", "--quick")]
    [Trait("Category", "Soak")]
    public void Run_OfOtherWordsThatMakeNoSense_NamesTheFirst(string words, string unexpected) => CheckNoSense(words, unexpected);

    private void CheckNoSense(string words, string unexpected)
    {
        var line = words.Split(' ');
        AssertRefused(line[0], unexpected, line[1..]);
    }

    [Fact]
    public void Run_OfAnUnknownCommand_NamesAllThereAre() => Assert.Equal(
        new AppResult(2, "",
        $"error: unknown command 'Front': expected one of {string.Join(' ', Names)}, or an option of BenchmarkDotNet{Environment.NewLine}"),
        AppInProcess.RunBenchmarks(_folder.Path, "Front", "--output", "out"));

    [Fact]
    [Trait("Category", "Soak")]
    public void Run_OfAnOptionOfBenchmarkDotNet_IsItsWork()
    {
        var (exitCode, output, error) = AppProcess.RunBenchmarks(_folder.Path, "--list", "flat", "--output", "out");
        Assert.Equal((0, ""), (exitCode, error));
        var listed = output.Split('\n', StringSplitOptions.RemoveEmptyEntries).Select(line => line.Split('.')[^2]);
        Assert.Equal(Classes, listed.Distinct().Order(StringComparer.Ordinal));
    }

    [Fact]
    public void ReadMe_HasEveryClassAndCommandOnceInItsTable()
    {
        // Question and folder, commands, classes, baseline.
        var rows = File.ReadAllLines(Repository.Full("FractalEngine.Benchmarks/README.md"))
            .Where(line => line.StartsWith("| ", StringComparison.Ordinal)).Select(line => line.Split('|')).ToArray();
        Assert.Equal(Names.Order(StringComparer.Ordinal), InBackticks(2));
        Assert.Equal(Classes, InBackticks(3));

        string[] InBackticks(int column) =>
            [.. rows.SelectMany(row => row[column].Split('`').Where((_, i) => i % 2 == 1)).Order(StringComparer.Ordinal)];
    }

    private void AssertRefused(string command, string unexpected, params string[] args)
    {
        var (exitCode, output, error) = AppInProcess.RunBenchmarks(_folder.Path, [command, "--output", "out", .. args]);
        Assert.Equal((2, ""), (exitCode, output));
        var lines = error.ReplaceLineEndings("\n").Split('\n');
        Assert.Equal($"error: unexpected '{unexpected}'", lines[0]);
        // The usage comes next, and no second error.
        Assert.StartsWith($"{command} [", lines[1], StringComparison.Ordinal);
        Assert.DoesNotContain("error:", string.Concat(lines[1..]), StringComparison.Ordinal);
        Assert.Empty(Directory.GetFileSystemEntries(_folder.Path));
    }
}
