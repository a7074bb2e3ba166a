using System.CommandLine;
using System.Diagnostics;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>info FILE [--json]</c>, which prints exact counts, bounds, storage size and load time.</summary>
internal static class InfoCommand
{
    /// <summary>Creates the command with its arguments and options.</summary>
    public static Command Create()
    {
        var shared = new SharedOptions();
        var json = new Option<bool>("--json") { Description = "Print JSON instead of text." };
        var command = new Command("info", "Print exact counts, bounds, storage size and load time of FILE.") { json };
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
