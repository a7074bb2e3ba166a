using FractalEngine.Tests.Recorded;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Compares the help of all commands with what it was when someone last read it.</summary>
[Collection(ConsoleTests.Name)]
public class RecordedHelpTests
{
    [Fact]
    public void Help_OfTheProgram_IsAsRecorded() => Check("help.txt", "--help", "limits --help", "limits");

    [Theory]
    [InlineData("loading", "info", "check", "save", "count", "export", "generate", "sky", "simulate", "query")]
    [InlineData("drawing", "view", "render", "animate")]
    public void Help_OfCommands_IsAsRecorded(string file, params string[] commands) =>
        Check($"help-{file}.txt", [.. commands.Select(command => $"{command} --help")]);

    private static void Check(string file, params string[] commandLines)
    {
        using var transcript = new Transcript(maxLines: int.MaxValue);
        transcript.Run(commandLines);
        RecordedText.Check(file, transcript.Lines);
    }
}
