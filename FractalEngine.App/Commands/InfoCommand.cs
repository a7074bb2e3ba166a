using System.CommandLine;
using System.Diagnostics;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Preparation;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>info FILE [--json] [--prepare]</c>, which prints exact counts, bounds, storage size and load time.</summary>
internal static class InfoCommand
{
    public static Command Create()
    {
        var shared = new SharedOptions();
        var json = new Option<bool>("--json") { Description = "Print JSON instead of text." };
        var prepare = new Option<bool>("--prepare") { Description = "Prepare everything for drawing, too, and measure that." };
        var command = new DocumentedCommand(
            "info", "Print exact counts, bounds, storage size and load time of FILE.",
            "info assets/fractals/googol.fdo", "info assets/scenes/gallery.sdo --json --prepare")
        {
            json, prepare,
        };
        shared.AddTo(command);
        command.SetAction(result => Run(
            result.GetRequiredValue(shared.File), shared.LoadOptions(result), result.GetValue(json), result.GetValue(prepare)));
        return command;
    }

    private static int Run(string path, LoadOptions options, bool json, bool prepare)
    {
        var clock = Stopwatch.StartNew();
        var file = ConsoleLoader.Load(path, options);
        var loadTime = clock.Elapsed;
        var summary = new FileSummary(file, loadTime, prepare ? MeasurePreparation(file) : null);
        Console.WriteLine(json ? summary.ToJson() : summary.ToText());
        return ExitCode.Done;
    }

    private static TimeSpan MeasurePreparation(LoadedFile file)
    {
        var clock = Stopwatch.StartNew();
        // What the first picture needs: the window computes the light within fractals while it shows that.
        new ScenePreparation(file.Scene, new()).PrepareAll(null, CancellationToken.None);
        return clock.Elapsed;
    }
}
