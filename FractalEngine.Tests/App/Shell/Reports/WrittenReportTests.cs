using System.Text.RegularExpressions;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Shell.Reports;

/// <summary>Tests the lines that tell what a command has written, and how long its parts took.</summary>
[Collection(ConsoleTests.Name)]
public sealed class WrittenReportTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData(0, "0 bytes")]
    [InlineData(999, "999 bytes")]
    [InlineData(1_000, "1.0 kB")]
    [InlineData(1_260, "1.3 kB")]
    [InlineData(999_900, "999.9 kB")]
    [InlineData(1_000_000, "1.0 MB")]
    [InlineData(2_340_000, "2.3 MB")]
    public void Written_OfAFile_TellsItsSize(int bytes, string size)
    {
        string path = _folder["file.obj"];
        using (var stream = File.Create(path))
        {
            stream.SetLength(bytes);
        }

        Assert.Matches(
            $@"^wrote {Regex.Escape(path)}: 5 faces, {Regex.Escape(size)}, [0-9]+\.[0-9] s\n$",
            Text(() => new WrittenReport(isQuiet: false, isVerbose: false).Written(path, "5 faces")));
    }

    [Fact]
    public void Written_WithoutAFile_TellsNoSize()
    {
        var report = new WrittenReport(isQuiet: false, isVerbose: true);
        string path = _folder["missing.obj"];
        Assert.Matches($@"^wrote {Regex.Escape(path)}: 5 faces, [0-9]+\.[0-9] s\n$", Text(() => report.Written(path, "5 faces")));
        Assert.Matches(@"^wrote the standard output: 5 faces, [0-9]+\.[0-9] s\n$", Text(() => report.Written("-", "5 faces")));
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Measure_OfAPart_TellsItsTimeOnlyIfAsked(bool isVerbose)
    {
        var report = new WrittenReport(isQuiet: true, isVerbose);
        Assert.True(report.IsQuiet);
        int value = 0, done = 0;
        string text = Text(() =>
        {
            value = report.Measure("load", () => 7);
            report.Measure("write", () => { done++; });
            report.Written("a.obj", "5 faces");
        });
        Assert.Equal((7, 1), (value, done));
        Assert.Matches(isVerbose ? @"^load [0-9]+\.[0-9]{3} ms\nwrite [0-9]+\.[0-9]{3} ms\n$" : "^$", text);
    }

    [Fact]
    public void Written_OfANameWithControlCharacters_EscapesThem() => Assert.StartsWith(
        "wrote a\\u001Bb.obj: ", Text(() => new WrittenReport(false, false).Written("a\u001Bb.obj", "5 faces")), StringComparison.Ordinal);

    private static string Text(Action action) => ErrorText.Of(action).ReplaceLineEndings("\n");
}
