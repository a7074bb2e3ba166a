using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>Tests what is accepted. What is refused is tested with the whole program, since it is written to standard error.</summary>
public class CommandLineParserTests
{
    public static TheoryData<string> Cultures => InCulture.Names;

    [Fact]
    public void TryParse_OfNothing_SetsNothing() => Assert.Equal((true, false, 7, "", ""), Parse());

    [Fact]
    public void TryParse_OfOptionsAndNames_SetsThemInAnyOrder()
    {
        Assert.Equal((true, true, 12, "out", "a b"), Parse("--quick", "a", "--count", "12", "--output", "out", "b"));
        Assert.Equal((true, true, 12, "out", "b a"), Parse("b", "--output", "out", "--count", "12", "a", "--quick"));
    }

    [Fact]
    public void TryParse_OfAnOptionTwice_TakesTheLast() => Assert.Equal((true, false, 2, "", ""), Parse("--count", "1", "--count", "2"));

    [Fact]
    public void TryParse_OfAValueThatIsCalledAsAName_IsNoName() => Assert.Equal((true, false, 7, "a", "b"), Parse("--output", "a", "b"));

    [Theory]
    [InlineData("1", 1)]
    [InlineData("007", 7)]
    [InlineData("2147483647", int.MaxValue)]
    public void TryParseCount_OfAPositiveWholeNumber_IsIt(string text, int expected)
    {
        Assert.True(CommandLineParser.TryParseCount(text, out var count));
        Assert.Equal(expected, count);
    }

    [Theory]
    [InlineData("")]
    [InlineData("0")]
    [InlineData("-1")]
    [InlineData("+1")]
    [InlineData(" 1")]
    [InlineData("1 ")]
    [InlineData("1.0")]
    [InlineData("1,000")]
    [InlineData("1e3")]
    [InlineData("0x10")]
    [InlineData("٣")]
    [InlineData("2147483648")]
    public void TryParseCount_OfAnythingElse_IsFalse(string text) => Assert.False(CommandLineParser.TryParseCount(text, out _));

    [Theory]
    [MemberData(nameof(Cultures))]
    public void TryParse_InAnyCulture_ReadsTheSame(string culture) =>
        Assert.Equal((true, true, 1234, "İ", "a"), InCulture.Run(culture, () => Parse("--quick", "--count", "1234", "--output", "İ", "a")));

    [Fact]
    public void DefaultFolder_IsThatOfTheKeptTables() =>
        Assert.Equal(Path.GetFullPath(Repository.Full("docs/benchmarks")), Path.GetFullPath(CommandLineParser.DefaultFolder));

    private static (bool IsRead, bool Quick, int Count, string Output, string Names) Parse(params string[] args)
    {
        var quick = false;
        var count = 7;
        var output = "";
        var names = new List<string>();
        var isRead = new CommandLineParser("usage")
            .Flag("--quick", () => quick = true)
            .Count("--count", value => count = value)
            .Option("--output", value => output = value)
            .Names(text => text is "a" or "b", names)
            .TryParse(args);
        return (isRead, quick, count, output, string.Join(' ', names));
    }
}
