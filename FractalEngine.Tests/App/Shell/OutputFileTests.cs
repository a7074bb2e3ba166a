using System.Diagnostics;
using FractalEngine.App.Shell;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Shell;

/// <summary>Tests that outputs are whole or not there, whatever ends a command or is full.</summary>
public sealed class OutputFileTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public OutputFileTests() => _folder.Write("cube.obj", SampleFiles.Cube);

    public void Dispose() => _folder.Dispose();

    [SkippableTheory]
    [InlineData("TERM")]
    [InlineData("HUP")]
    public void Export_EndedByASignalWhileWriting_LeavesNoFile(string signal)
    {
        _folder.Write("row.fdo", SampleFiles.Row("20"));
        Assert.Equal((130, "error: interrupted"), Signals.EndWhileWriting(_folder, signal, "export", "row.fdo", "--output", "t.obj"));
        Assert.Equal(["cube.obj", "row.fdo"], Directory.GetFiles(_folder.Path).Select(Path.GetFileName).Order());
    }

    [SkippableTheory]
    [InlineData("INT")]
    [InlineData("TERM")]
    public void Trace_EndedByASignal_SaysSoAndLeavesNoFile(string signal)
    {
        Signals.Require(signal);
        using var process = AppProcess.Start(
            _folder.Path, [], "render", "cube.obj", "--output", "t.png", "--trace", "1000000", "--resolution", "200x200", "--verbose");
        try
        {
            // Its time is told when the preparation is done; then samples are added.
            for (var line = ""; !line.StartsWith("prepare", StringComparison.Ordinal);)
            {
                line = process.StandardError.ReadLine() ?? throw new EndOfStreamException("the process has ended");
            }

            Thread.Sleep(TimeSpan.FromMilliseconds(100));
            Signals.Send(process, signal);
            Assert.True(process.WaitForExit(Polling.Deadline), "the process does not end");
        }
        finally
        {
            process.Kill();
        }

        Assert.Equal((130, "error: interrupted"), (process.ExitCode, process.StandardError.ReadToEnd().Trim()));
        Assert.Equal(["cube.obj"], Directory.GetFiles(_folder.Path).Select(Path.GetFileName));
    }

    [SkippableTheory]
    [InlineData("INT")]
    [InlineData("TERM")]
    public void Query_EndedByASignal_ExitsWith130AtOnce(string signal)
    {
        Signals.Require(signal);
        File.WriteAllLines(_folder["points.txt"], Enumerable.Repeat("1 2 3", 5_000_000));
        using var process = AppProcess.Start(_folder.Path, [], "query", "cube.obj", "--points", "points.txt", "--collider", "simple");
        try
        {
            Thread.Sleep(TimeSpan.FromSeconds(1));
            Signals.Send(process, signal);
            Assert.True(process.WaitForExit(Polling.Deadline), "the process does not end");
        }
        finally
        {
            process.Kill();
        }

        Assert.Equal((130, "error: interrupted"), (process.ExitCode, process.StandardError.ReadToEnd().Trim()));
    }

    [SkippableFact]
    public void Export_IntoAPipeThatNothingReads_IsAnErrorInsteadOfAWait()
    {
        Elsewhere.SkipIf(OperatingSystem.IsWindows() || Shell("mkfifo pipe.obj").ExitCode != 0, "there are no named pipes");
        var (exitCode, _, error) = AppProcess.Run(_folder.Path, "export", "cube.obj", "--output", "pipe.obj");
        Assert.Equal((2, "error: pipe.obj can't be written: it is a pipe that nothing reads"), (exitCode, error.Trim()));
    }

    [SkippableFact]
    public void Export_IntoAStandardOutputThatNothingReadsAnyMore_EndsByAnError()
    {
        Elsewhere.SkipIf(OperatingSystem.IsWindows(), "there is no such shell");
        File.WriteAllText(_folder["row.fdo"], SampleFiles.Row("14"));
        var result = Shell("{ APP export row.fdo --output -; echo $? >code; } | head -n 1; cat code");
        Assert.Equal("2", result.Output.Trim()[^1..]);
        Assert.StartsWith("error: the standard output can't be written: ", result.Error, StringComparison.Ordinal);
        Assert.Single(result.Error.Trim().Split('\n'));
    }

    [SkippableFact]
    public void Export_IntoAFullPipeThatDoesNotBlock_WaitsForItsReader()
    {
        Elsewhere.SkipIf(!OperatingSystem.IsLinux(), "dd makes pipes that don't block on Linux");
        File.WriteAllText(_folder["row.fdo"], SampleFiles.Row("14"));
        var result = Shell("{ dd oflag=nonblock </dev/null 2>dd.txt; APP export row.fdo --output -; } | { sleep 2; grep -c ^f; }");
        Assert.Equal("196608", result.Output.Trim());
    }

    [SkippableFact]
    public void Export_IntoAPipe_WritesIntoIt()
    {
        Elsewhere.SkipIf(OperatingSystem.IsWindows() || Shell("mkfifo pipe.obj").ExitCode != 0, "there are no named pipes");
        var result = Shell("cat pipe.obj >copy.obj & APP export cube.obj --output pipe.obj; wait; test -p pipe.obj");
        Assert.Equal(0, result.ExitCode);
        Assert.Equal(12, File.ReadLines(_folder["copy.obj"]).Count(line => line.StartsWith('f')));
    }

    [SkippableTheory]
    [InlineData(
        "ulimit -f 8; DOTNET_EnableWriteXorExecute=0 APP generate icosphere --output m.obj", 2,
        "error: m.obj can't be written: it is larger than the system allows")]
    [InlineData(
        "ulimit -n 40; APP generate icosphere --output m.obj", 3, "error: the system lets the program open 40 files, and it needs ")]
    [InlineData(
        "TMPDIR=/missing APP approximate cube.obj --output m.fdo", 2,
        "error: /missing/, the folder for temporary files, can't be written: ")]
    [InlineData(
        "f=$PWD/cube.obj; mkdir gone; cd gone; rmdir ../gone; APP query $f --points points.txt", 2,
        "error: the current folder has been removed")]
    [InlineData(
        "APP info $(printf 'a\\377.obj')", 1,
        "a\uFFFD.obj:1:1: error: file not found: a name that is not UTF-8 can't be opened")]
    public void Command_WhereTheSystemRefuses_SaysWhatInOneLine(string command, int exitCode, string error)
    {
        Elsewhere.SkipIf(!OperatingSystem.IsLinux(), "the system's limits and messages are those of Linux");
        var result = Shell(command);
        Assert.Equal((exitCode, ""), (result.ExitCode, result.Output));
        Assert.StartsWith(error, result.Error, StringComparison.Ordinal);
        Assert.Equal(1, result.Error.Count('\n'.Equals));
        Assert.Empty(Directory.GetFiles(_folder.Path, "m.*"));
    }

    [SkippableTheory]
    [InlineData("info nope.obj 2>FULL", 1, "")]
    [InlineData("info nope.obj 2>&-", 1, "")]
    [InlineData("count cube.obj 2>FULL", 0, "12\n")]
    [InlineData("query cube.obj --points points.txt 2>FULL", 0, "1 0.5 ")]
    [InlineData("query cube.obj --wrong 2>FULL", 2, "")]
    [InlineData("count cube.obj >FULL", 2, "error: the standard output can't be written: ")]
    [InlineData("--help >FULL", 2, "error: the standard output can't be written: ")]
    [InlineData("export cube.obj --output - <&- >&-", 2, "error: the standard output can't be written: it is closed")]
    [InlineData("export cube.obj --output FULL.ply", 2, "error: full.ply can't be written: No space left on device\n")]
    [InlineData("simulate scene.sdo >FULL", 2, "error: the standard output can't be written: ")]
    public void Streams_ThatAreFullOrClosed_DoNotChangeTheRest(string command, int exitCode, string output)
    {
        // A node of its own instead of /dev/full: an error here must not harm the machine's.
        Elsewhere.SkipIf(
            OperatingSystem.IsWindows() || Shell("mknod full c 1 7 && ln -s full full.ply").ExitCode != 0,
            "this user can't make device nodes");
        _folder.Write("points.txt", "1.5 0.1 0.2\n");
        _folder.Write("scene.sdo", "p \"cube.obj\" # 0.5\n");
        var result = Shell($"APP {command.Replace("FULL", "full", StringComparison.Ordinal)}");
        Assert.Equal(exitCode, result.ExitCode);
        if (output.Length == 0)
        {
            Assert.Equal("", result.Output + result.Error);
        }

        Assert.StartsWith(output, result.Output + result.Error, StringComparison.Ordinal);
    }

    /// <summary>Runs a line in a shell, in which APP stands for the program.</summary>
    private AppResult Shell(string command)
    {
        var app = Path.ChangeExtension(typeof(OutputFile).Assembly.Location, ".dll");
        var start = new ProcessStartInfo("sh", ["-c", command.Replace("APP", $"dotnet exec '{app}'", StringComparison.Ordinal)])
        {
            WorkingDirectory = _folder.Path, RedirectStandardOutput = true, RedirectStandardError = true,
        };
        using var process = Process.Start(start)!;
        var output = process.StandardOutput.ReadToEndAsync();
        var error = process.StandardError.ReadToEndAsync();
        Assert.True(process.WaitForExit(Polling.Deadline), $"{command} does not end");
        return new(process.ExitCode, output.GetAwaiter().GetResult(), error.GetAwaiter().GetResult());
    }
}
