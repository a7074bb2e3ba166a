using System.Text;
using FractalEngine.App.Shell;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests what commands show on a terminal while they work, and in the encoding of the console.</summary>
public sealed class TerminalTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public TerminalTests()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("scene.sdo", "o \"cube.obj\" #\nc (0, 0, -3) # 60\n");
    }

    public void Dispose() => _folder.Dispose();

    /// <summary>A bar that only flickers up would tell less than none.</summary>
    [SkippableFact]
    public void Load_OfASmallFile_ShowsNoBar()
    {
        string output = Run("info cube.obj");
        Assert.Contains($"{"faces",-20}12", output, StringComparison.Ordinal);
        Assert.DoesNotContain("oading", output, StringComparison.Ordinal);
    }

    /// <summary>The line of progress is overwritten by sixty blanks, which are more than it has.</summary>
    [SkippableFact]
    public void Progress_AtTheEnd_IsClearedByOneLineOfBlanks() => Assert.Contains(
        $"left   \r{new string(' ', 60)}\rwrote a.png: ", Run("render scene.sdo --trace 2 --resolution 4x4 --output a.png"),
        StringComparison.Ordinal);

    [SkippableFact]
    public void Messages_OnAConsoleOfLatin1_AreInThatEncoding()
    {
        Elsewhere.SkipIf(!OperatingSystem.IsLinux(), "elsewhere no variable of the environment tells the encoding");
        var environment = new Dictionary<string, string?> { ["LC_ALL"] = "de_DE.ISO-8859-1" };
        using var process = AppProcess.Start(_folder.Path, environment, "info", "ä.obj");
        using var error = new MemoryStream();
        process.StandardError.BaseStream.CopyTo(error);
        Assert.True(process.WaitForExit(Polling.Deadline), "the process does not end");
        Assert.Equal(Encoding.Latin1.GetBytes("ä.obj:1:1: error: file not found\n"), error.ToArray());
    }

    [SkippableTheory]
    [InlineData("", true)]
    [InlineData("--quiet", false)]
    public void Progress_OnATerminal_CountsFramesAndIsClearedAtTheEnd(string option, bool isTold)
    {
        var output = Run($"animate scene.sdo --turntable --frames 3 --trace 1 --resolution 8x8 --output f.png {option}");
        Assert.Equal(3, Directory.GetFiles(_folder.Path, "f-*.png").Length);
        if (isTold)
        {
            Assert.Matches(
                @"\rframe 1 of 3, \d+ s left +\rframe 2 of 3, \d+ s left +\rframe 3 of 3, 0 s left +\r +\r"
                + @"wrote f-0001\.png to f-0003\.png: 3 frames, [0-9.]+ s\r\n",
                output);
        }
        else
        {
            // The runtime tells the terminal some of its own.
            Assert.DoesNotMatch("frame|wrote", output);
        }
    }

    private string Run(string arguments) =>
        Terminal.Run(_folder.Path, $"dotnet exec '{typeof(ExitCode).Assembly.Location}' {arguments}");
}
