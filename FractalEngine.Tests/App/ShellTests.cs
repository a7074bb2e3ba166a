using System.Diagnostics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests what a person meets at a shell: help, proposals, pipes and reports. Each command runs as a process.</summary>
public sealed class ShellTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public ShellTests()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("row.fdo", SampleFiles.Row("3"));
    }

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("render")]
    [InlineData("limits")]
    public void Help_OfACommand_NamesTheProgramAsCalledAndEndsWithTwoExamples(string command)
    {
        var environment = new Dictionary<string, string?> { ["FRACTALENGINE_PROGRAM"] = "./run.sh" };
        var (exitCode, output, _) = AppProcess.Run(_folder.Path, environment, command, "--help");
        var lines = output.TrimEnd().Split('\n');
        Assert.Equal(0, exitCode);
        Assert.Contains($"./run.sh {command}", output, StringComparison.Ordinal);
        Assert.DoesNotContain("fractal-engine", output, StringComparison.Ordinal);
        Assert.Equal("Examples:", lines[^3]);
        Assert.All(lines[^2..], static line => Assert.StartsWith("  ./run.sh ", line, StringComparison.Ordinal));
    }

    [SkippableFact]
    public void View_OfAMissingFileWithoutADisplay_NamesTheFile()
    {
        Elsewhere.SkipIf(!OperatingSystem.IsLinux(), "elsewhere there is always a display");
        var environment = new Dictionary<string, string?> { ["DISPLAY"] = null, ["WAYLAND_DISPLAY"] = null };
        var (exitCode, _, error) = AppProcess.Run(_folder.Path, environment, "view", "cub.obj");
        Assert.Equal((1, "cub.obj:1:1: error: file not found: did you mean \"cube.obj\"?\n"), (exitCode, error));
    }

    [Fact]
    public void Info_OfTheStandardInput_ReadsAFractal()
    {
        var (exitCode, output, _) = RunWithInput(SampleFiles.Row("2"), "info", "-", "--json");
        Assert.Equal(0, exitCode);
        Assert.Contains("\"kind\": \"fractal\"", output, StringComparison.Ordinal);
        Assert.Contains("\"faces\": 48,", output, StringComparison.Ordinal);
    }

    [Fact]
    public void Check_OfTheStandardInput_NamesItInMessages() => Assert.Equal(
        new AppResult(1, "", "-:1:3: error: the file \"cub.obj\" is not found: did you mean \"cube.obj\"?\n  o \"cub.obj\" #\n    ^\n"),
        RunWithInput("o \"cub.obj\" #", "check", "-"));

    [Fact]
    public void Check_OfOneCharacterOfStandardInput_ReadsIt() =>
        Assert.StartsWith("-:1:1: error: ", RunWithInput("?", "check", "-").Error, StringComparison.Ordinal);

    [SkippableFact]
    public void Check_OfAFolderWithLinksToItself_LooksOnce()
    {
        Elsewhere.SkipOnWindows("links need rights there");
        Assert.Equal(
            new AppResult(0, "sub/a.obj: ok\n", ""),
            RunInShell("mkdir sub; cp cube.obj sub/a.obj; ln -s . sub/x; ln -s . sub/y; timeout 20 {0} check sub"));
    }

    [SkippableFact]
    public void Info_OfAClosedStandardInput_DoesNotWait()
    {
        Elsewhere.SkipIf(!OperatingSystem.IsLinux(), "only Linux tells that it is closed");
        Assert.Equal(new AppResult(1, "", "-:1:1: error: the standard input is closed\n"), RunInShell("{0} info - <&-"));
    }

    [SkippableFact]
    public void Info_OfAFolderAsStandardInput_SaysSo()
    {
        Elsewhere.SkipOnWindows("the shell there opens no folders");
        Assert.Equal(
            new AppResult(1, "", "-:1:1: error: the standard input can't be read: Is a directory\n"), RunInShell("{0} info - < ."));
    }

    [SkippableTheory]
    [InlineData("info cube.obj")]
    [InlineData("generate torus-knot --output a.obj")]
    [InlineData("check .")]
    public void AnyCommand_InAFolderThatIsGone_SaysSo(string command)
    {
        Elsewhere.SkipOnWindows("a folder that is in use can't be removed there");
        Assert.Equal(
            new AppResult(2, "", "error: the current folder has been removed\n"),
            RunInShell($"mkdir gone && cd gone && rmdir ../gone && {{0}} {command}"));
    }

    [Fact]
    public void Export_OfAPipeIntoAPipe_WritesTheSameAsFiles()
    {
        Assert.Equal(0, Run("export", "row.fdo", "--output", "flat.obj").ExitCode);
        // Only the name of the object differs.
        Assert.Equal(
            File.ReadAllText(_folder["flat.obj"]).Replace("o row\n", "o -\n", StringComparison.Ordinal),
            RunWithInput(SampleFiles.Row("3"), "export", "-", "--output", "-").Output);
    }

    [SkippableTheory]
    [InlineData("-")]
    [InlineData("/dev/stdin")]
    public void Query_OfPointsFromAPipe_PrintsAHeaderOnRequest(string points)
    {
        Elsewhere.SkipIf(!(OperatingSystem.IsLinux() || points == "-"), "only Unix has /dev/stdin");
        var (exitCode, output, _) = RunWithInput("0 0 1\n", "query", "cube.obj", "--points", points, "--header", "--error-bound");
        Assert.Equal(0, exitCode);
        Assert.StartsWith("distance x y z nx ny nz faceTests errorBound\n0.5 ", output, StringComparison.Ordinal);
    }

    [Fact]
    public void Simulate_EveryNthStep_WritesFewerRowsOfTheSameRun()
    {
        _folder.Write("drop.sdo", "p \"cube.obj\" ((0, 5, 0), #, #) 0.5\n");
        string[] arguments = ["simulate", "drop.sdo", "--seconds", "1", "--output", "-"];
        var all = Run(arguments).Output.Split('\n');
        var some = Run([.. arguments, "--every", "20"]).Output.Split('\n');
        Assert.Equal([all[0], all[20], all[40], all[60], ""], some);
    }

    [SkippableTheory]
    [InlineData("0.2", false)]
    [InlineData("2.5", true)]
    [Trait("Category", "Soak")]
    public void Build_OnATerminal_SaysSoWhenItTakesMoreThanTwoSeconds(string seconds, bool isAnnounced)
    {
        var setup = Repository.Full("eng/setup.sh");
        var output = Terminal.Run(_folder.Path, $"bash -c '. {setup}; announce_build App; sleep {seconds}; stop_announcing'");
        Assert.Equal(isAnnounced, output.Contains("building App", StringComparison.Ordinal));
    }

    private AppResult Run(params string[] arguments) => AppProcess.Run(_folder.Path, arguments);

    private AppResult RunWithInput(string input, params string[] arguments)
    {
        _folder.Write("input.txt", input);
        return RunInShell($"cat input.txt | {{0}} {string.Join(' ', arguments.Select(static argument => $"'{argument}'"))}");
    }

    /// <summary>Runs a line of a shell, in which {0} stands for the program.</summary>
    private AppResult RunInShell(string line)
    {
        var program = typeof(FractalEngine.App.Shell.ExitCode).Assembly.Location;
        var start = new ProcessStartInfo("sh", ["-c", line.Replace("{0}", $"dotnet exec '{program}'", StringComparison.Ordinal)])
        {
            WorkingDirectory = _folder.Path,
            RedirectStandardOutput = true,
            RedirectStandardError = true,
        };
        using var process = Process.Start(start)!;
        var error = process.StandardError.ReadToEndAsync();
        var output = process.StandardOutput.ReadToEnd();
        process.WaitForExit();
        return new(process.ExitCode, output, error.GetAwaiter().GetResult());
    }
}
