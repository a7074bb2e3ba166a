using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests what a command line that can't be read says, and the ways to ask for help.</summary>
[Collection(ConsoleTests.Name)]
public sealed class UsageTextTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public UsageTextTests() => _folder.Write("cube.obj", SampleFiles.Cube);

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("error: unknown option '--jsn': did you mean '--json'?\n", "--jsn=x", "--jsn")]
    [InlineData("error: unknown option '--jsn': did you mean '--json'?\nerror: unknown option '--prepar': did you mean '--prepare'?\n",
        "--jsn", "--prepar")]
    [InlineData("error: unknown option '--nothing-like-it'\n", "--nothing-like-it")]
    [InlineData("error: unknown option '--limits': did you mean '--limit'?\n", "--limits")]
    public void Info_OfUnknownOptions_NamesEachOnce(string message, params string[] options)
    {
        var (exitCode, output, error) = AppInProcess.Run(_folder.Path, ["info", "cube.obj", .. options]);
        Assert.Equal(
            (2, "", message + "Run 'fractal-engine info --help' to see its options.\n"),
            (exitCode, output, error.ReplaceLineEndings("\n")));
    }

    [Fact]
    public void Help_ByAnyOfItsNames_IsTheSame()
    {
        var expected = AppInProcess.Run(_folder.Path, "--help");
        Assert.Equal((0, ""), (expected.ExitCode, expected.Error));
        Assert.Contains("\nCommands:\n", expected.Output.ReplaceLineEndings("\n"), StringComparison.Ordinal);
        Assert.Equal(expected, AppInProcess.Run(_folder.Path, "-h"));
        Assert.Equal(expected, AppInProcess.Run(_folder.Path, "-?"));
    }
}
