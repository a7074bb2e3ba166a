using System.CommandLine;
using FractalEngine.App.Jobs;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Exports;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>export FILE --output X.obj</c>, which writes a file for other programs, fractals expanded.</summary>
internal static class ExportCommand
{
    public static Command Create()
    {
        var shared = new SharedOptions();
        var output = SharedOptions.OutputOption(string.Join('|', ExportJob.Endings), "File to write; its ending says the format.");
        var depth = NumberOption.Integer("--depth", "N", 0, int.MaxValue, "Recursion depth, overriding the fractal's file.");
        var frame = new ExportOptions();
        var report = new ReportOptions();
        var command = new DocumentedCommand(
            "export", "Write all that FILE shows for other programs, with fractals expanded.",
            "export assets/fractals/menger-3.fdo --output out/menger.obj", "export assets/fractals/tree.fdo --depth 3 --output -")
        {
            output, depth,
        };
        frame.AddTo(command);
        shared.AddTo(command);
        report.AddTo(command);
        command.SetAction(result =>
        {
            var path = result.GetRequiredValue(output);
            return Run(
                result.GetRequiredValue(shared.File), shared.LoadOptions(result) with { Depth = result.GetValue(depth) }, path,
                frame.JobOf(result, path), frame.SettingsOf(result), report.Begin(result));
        });
        return command;
    }

    private static int Run(
        string path, LoadOptions options, string output, ExportJob job, ExportSettings settings, WrittenReport report)
    {
        if (options.Depth > FractalLimits.Depth.Value)
        {
            throw new FractalLimitException($"--depth {options.Depth} exceeds the limit of {FractalLimits.Depth.Value}");
        }

        options = options with { IsStaged = job.IsStaged };
        var file = report.Measure("load", () => ConsoleLoader.Load(path, options));
        InputFiles.Protect(output);
        if (options.Depth is not null && !file.Scene.Models.Any(model => model is FractalModel { Fractal.Description.HasDepth: true }))
        {
            throw new UsageException($"{path} has no recursive fractal, so --depth has no effect");
        }

        var summary = job.Run(file.Scene, settings with { Load = options }, report.Measure);
        report.Written(output, summary.Contents);
        foreach (var loss in summary.Losses)
        {
            Console.Error.WriteLine(DisplayText.Escape(loss));
        }

        return ExitCode.Done;
    }
}
