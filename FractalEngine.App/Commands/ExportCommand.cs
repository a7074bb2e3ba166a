using System.Collections.Immutable;
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
using FractalEngine.Parsing.Exports.Web;
using FractalEngine.Parsing.Wavefront.Writing;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>export FILE --output X.obj</c>, which expands a file into one flat mesh.</summary>
internal static class ExportCommand
{
    // Beside OBJ, which has a file for its materials.
    private static readonly ImmutableArray<SceneExport> Formats =
    [
        new WebExport(),
    ];

    private static string Endings { get; } = string.Join('|', [".obj", .. Formats.Select(static format => format.Ending)]);

    public static Command Create()
    {
        var shared = new SharedOptions();
        var output = SharedOptions.OutputOption(Endings, "File to write; its ending says the format.");
        var depth = NumberOption.Integer("--depth", "N", 0, int.MaxValue, "Recursion depth, overriding the fractal's file.");
        var noMaterials = SharedOptions.Flag("--no-materials", "Write no material file (.mtl) beside the mesh.");
        var report = new ReportOptions();
        var command = new DocumentedCommand(
            "export", "Write all faces of FILE as one flat mesh, with fractals expanded.",
            "export assets/fractals/menger-3.fdo --output out/menger.obj", "export assets/fractals/tree.fdo --depth 3 --output -")
        {
            output, depth, noMaterials,
        };
        shared.AddTo(command);
        report.AddTo(command);
        command.SetAction(result => Run(
            result.GetRequiredValue(shared.File), shared.LoadOptions(result) with { Depth = result.GetValue(depth) },
            result.GetRequiredValue(output), !result.GetValue(noMaterials), report.Begin(result)));
        return command;
    }

    private static int Run(string path, LoadOptions options, string output, bool hasMaterials, WrittenReport report)
    {
        if (options.Depth > FractalLimits.Depth.Value)
        {
            throw new FractalLimitException($"--depth {options.Depth} exceeds the limit of {FractalLimits.Depth.Value}");
        }

        var format = Formats.FirstOrDefault(one => output.EndsWith(one.Ending, StringComparison.OrdinalIgnoreCase));
        options = options with { IsStaged = format?.IsStaged == true };
        var file = report.Measure("load", () => ConsoleLoader.Load(path, options));
        InputFiles.Protect(output);
        if (options.Depth is not null && !file.Scene.Models.Any(model => model is FractalModel { Fractal.Description.HasDepth: true }))
        {
            throw new UsageException($"{path} has no recursive fractal, so --depth has no effect");
        }

        if (format is not null)
        {
            ExportSummary? summary = null;
            var settings = new ExportSettings { Load = options };
            report.Measure("write", () => OutputFile.Write(output, stream => summary = format.Write(file.Scene, settings, stream)));
            report.Written(output, summary!.Contents);
            foreach (var loss in summary.Losses)
            {
                Console.Error.WriteLine(DisplayText.Escape($"{output}: warning: {loss}"));
            }

            return ExitCode.Done;
        }

        var faceCount = 0L;
        var materials = hasMaterials ? ExportedMaterials.For(file.Scene, output) : null;
        report.Measure("write", () =>
        {
            if (materials is null)
            {
                OutputFile.Write(output, stream => faceCount = ObjSceneWriter.Write(file.Scene, stream, FractalLimits.ExportedFaces.Value));
            }
            else
            {
                OutputFile.WritePair(
                    materials.Path, materials.Write,
                    output, stream => faceCount = ObjSceneWriter.Write(
                        file.Scene, stream, FractalLimits.ExportedFaces.Value, materials.Materials, materials.Name));
            }
        });
        var faces = faceCount == 1 ? "1 face" : FormattableString.Invariant($"{faceCount} faces");
        report.Written(output, materials is null ? faces : $"{faces}, {materials.Describe()}");
        materials?.WarnOfOutsideTextures();
        return ExitCode.Done;
    }
}
