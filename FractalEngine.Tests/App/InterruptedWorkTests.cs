using System.Diagnostics;
using FractalEngine.App.Shell;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests what signals leave of long work, and what is shown without a name, in processes.</summary>
public sealed class InterruptedWorkTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public InterruptedWorkTests()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("drop.sdo", "p \"cube.obj\" # 0.5\n");
    }

    public void Dispose() => _folder.Dispose();

    [SkippableTheory]
    [InlineData(true)]
    [InlineData(false)]
    public void Trace_Interrupted_LeavesItsImageOnlyIfAsked(bool keepsPartial)
    {
        Signals.Require("TERM");
        string[] arguments =
            ["render", "cube.obj", "--output", "t.png", "--trace", "1000000", "--resolution", "4x4", "--verbose"];
        using var process = AppProcess.Start(_folder.Path, [], keepsPartial ? [.. arguments, "--keep-partial"] : arguments);
        try
        {
            // Its time is told when the preparation is done; then samples of sixteen pixels are added, each in less than a millisecond.
            for (var line = ""; !line.StartsWith("prepare", StringComparison.Ordinal);)
            {
                line = process.StandardError.ReadLine() ?? throw new EndOfStreamException("the process has ended");
            }

            Thread.Sleep(TimeSpan.FromMilliseconds(400));
            Signals.Send(process, "TERM");
            Assert.True(process.WaitForExit(Polling.Deadline), "the process does not end");
        }
        finally
        {
            process.Kill();
        }

        string error = process.StandardError.ReadToEnd();
        Assert.Equal(130, process.ExitCode);
        Assert.EndsWith("error: interrupted\n", error, StringComparison.Ordinal);
        Assert.Equal(keepsPartial, error.Contains("wrote t.png: 4×4 pixels, ", StringComparison.Ordinal));
        Assert.Equal(keepsPartial, File.Exists(_folder["t.png"]));
    }

    /// <summary>As with <c>nohup</c>: work goes on when its terminal is closed; other signals still end it.</summary>
    [SkippableFact]
    public void Simulate_StartedToIgnoreHangups_GoesOn()
    {
        Elsewhere.SkipIf(!OperatingSystem.IsLinux(), "only Linux tells which signals a process ignores");
        string program = typeof(ExitCode).Assembly.Location;
        var start = new ProcessStartInfo(
            "sh", ["-c", $"trap '' HUP; exec dotnet exec '{program}' simulate drop.sdo --seconds 100000 --output drop.csv"])
        {
            WorkingDirectory = _folder.Path,
            RedirectStandardError = true,
        };
        using var process = Process.Start(start)!;
        try
        {
            Polling.WaitUntil(() => Directory.GetFiles(_folder.Path, "*.tmp").Length > 0, "output file");
            Signals.Send(process, "HUP");
            Assert.False(process.WaitForExit(TimeSpan.FromMilliseconds(500)), "the process has ended");
            Signals.Send(process, "TERM");
            Assert.True(process.WaitForExit(Polling.Deadline), "the process does not end");
        }
        finally
        {
            process.Kill();
        }

        Assert.Equal((130, "error: interrupted"), (process.ExitCode, process.StandardError.ReadToEnd().Trim()));
        Assert.Empty(Directory.GetFiles(_folder.Path, "*.tmp"));
    }

    /// <summary>Without a name, the gallery of the installation is shown, wherever the user is.</summary>
    [SkippableFact]
    public void View_OfNothing_ShowsTheGallery()
    {
        Display.Require();
        var environment = new Dictionary<string, string?> { ["FRACTALENGINE_NO_WINDOW"] = "1" };
        var (exitCode, _, error) = AppProcess.Run(
            _folder.Path, environment, "view", "--resolution", "32x24", "--no-shadows", "--no-ambient-occlusion");
        Assert.Equal(0, exitCode);
        Assert.EndsWith("there is no display for a window, so out/gallery.png was drawn instead\n", error, StringComparison.Ordinal);
        Assert.True(File.Exists(_folder["out/gallery.png"]));
    }
}
