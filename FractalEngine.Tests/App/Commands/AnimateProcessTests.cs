using System.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests what only processes of <c>animate</c> have: signals, and the encoder that they start.</summary>
public sealed class AnimateProcessTests : DrawingCommandTests
{
    [SkippableFact]
    public void Animate_WhenInterrupted_LeavesWholeFrames() => CheckInterrupted();

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Animate_TracedWhenInterrupted_LeavesWholeFrames() => CheckInterrupted("--trace", "8");

    private void CheckInterrupted(params string[] options)
    {
        Display.Require();
        Signals.Require("INT");
        using var process = AppProcess.Start(
            Folder.Path, [],
            ["animate", "scene.sdo", "--turntable", "--frames", "100000", "--output", "f.png", "--resolution", "64x64", .. options]);
        var error = process.StandardError.ReadToEndAsync();
        try
        {
            Polling.WaitUntil(() => File.Exists(Folder["f-000005.png"]), "fifth frame");
            Signals.Send(process, "INT");
            Assert.True(process.WaitForExit(Polling.Deadline), "the process does not end");
        }
        finally
        {
            process.Kill();
        }

        Assert.Equal(130, process.ExitCode);
        Assert.Contains(" frames, ", error.GetAwaiter().GetResult(), StringComparison.Ordinal);
        var files = Directory.GetFiles(Folder.Path, "f-*");
        Assert.All(files, file => Assert.Equal(64, ReadImage(file).Height));
    }

    [Fact]
    public void Animate_OfAVideoWithoutFfmpeg_SaysWhatIsMissing()
    {
        var dotnet = Path.GetDirectoryName(Environment.ProcessPath)!;
        var environment = new Dictionary<string, string?> { ["PATH"] = dotnet };
        Assert.Equal(
            new AppResult(2, "", "error: a.mp4 needs the program ffmpeg, which is not installed; .png and .apng need none\n"),
            AppProcess.Run(Folder.Path, environment, "animate", "scene.sdo", "--turntable", "--output", "a.mp4"));
    }

    /// <summary>The encoder itself is a large package, which only the long tests need; here another program takes its name.</summary>
    [SkippableTheory]
    [InlineData("a.mp4")]
    [InlineData("-a:b.mp4")]
    [InlineData(
        "LLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLL"
        + "LLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLLL.mp4")]
    public void Animate_OfAVideo_GivesTheEncoderEachFrame(string file)
    {
        Elsewhere.SkipOnWindows("there are no shell scripts");
        Display.Require();
        Folder.Write("bin/ffmpeg", "#!/bin/sh\necho \"$@\" >arguments.txt\nfor last; do :; done\ncat >\"${last#file:}\"\n");
        if (!OperatingSystem.IsWindows())
        {
            File.SetUnixFileMode(Folder["bin/ffmpeg"], UnixFileMode.UserRead | UnixFileMode.UserExecute);
        }

        var environment = new Dictionary<string, string?> { ["PATH"] = $"{Folder["bin"]}:{Environment.GetEnvironmentVariable("PATH")}" };
        var (exitCode, _, error) = AppProcess.Run(
            Folder.Path, environment,
            "animate", "scene.sdo", "--turntable", $"--output={file}", "--frames", "3", "--fps", "10", "--resolution", "33x21");
        Assert.True(exitCode == 0, error);
        Assert.Equal(3, AnimateCommandTests.CountChunks("IEND", File.ReadAllBytes(Folder[file])));
        Assert.Matches(
            @"^-loglevel error -y -f image2pipe -c:v png -framerate 10 -i - -vf \S+ -pix_fmt yuv420p .*file:\w+\.unfinished\.mp4\n$",
            File.ReadAllText(Folder["arguments.txt"]));
    }

    [SkippableTheory]
    [Trait("Category", "Soak")]
    [InlineData("a.mp4", 4, "ftyp")]
    [InlineData("a.webm", 0, "\u001aE\u00df\u00a3")]
    [InlineData("a.gif", 0, "GIF8")]
    public void Animate_OfAVideo_IsWrittenThroughFfmpeg(string file, int offset, string signature)
    {
        Display.Require();
        var folders = (Environment.GetEnvironmentVariable("PATH") ?? "").Split(Path.PathSeparator);
        Skip.IfNot(Array.Exists(folders, folder => File.Exists(Path.Combine(folder, "ffmpeg"))), "ffmpeg is not installed");
        // Odd sizes, which codecs don't have.
        var (exitCode, _, error) = AppProcess.Run(
            Folder.Path, "animate", "scene.sdo", "--turntable", "--output", file, "--frames", "3", "--fps", "10", "--resolution", "33x21");
        Assert.True(exitCode == 0, error);
        Assert.Equal(signature, Encoding.Latin1.GetString(File.ReadAllBytes(Folder[file]).AsSpan(offset, signature.Length)));
        Assert.Equal([Folder[file]], Directory.GetFiles(Folder.Path, "a.*"));
    }
}
