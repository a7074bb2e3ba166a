using System.CommandLine;
using System.Diagnostics;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;

namespace FractalEngine.App.Commands;

/// <summary><c>info FILE [--json]</c></summary>
internal static class InfoCommand
{
    public static Command Create()
    {
        var shared = new SharedOptions();
        var json = new Option<bool>("--json") { Description = "Write JSON." };
        var command =
            new Command("info", "Count what a file holds, measure it, and time how long it takes until it could be drawn.") { json };
        shared.AddTo(command);
        command.SetAction(result => Run(result.GetRequiredValue(shared.File), shared.LoadOptions(result), result.GetValue(json)));
        return command;
    }

    private static int Run(string path, LoadOptions options, bool json)
    {
        var clock = Stopwatch.StartNew();
        var file = ConsoleLoader.Load(path, options);
        DrawableScene.Prepare(file.Scene, new RenderSettings());
        var summary = FileSummary.Of(file, clock.Elapsed);
        Console.WriteLine(json ? summary.ToJson() : summary.ToText());
        return ExitCode.Done;
    }
}
