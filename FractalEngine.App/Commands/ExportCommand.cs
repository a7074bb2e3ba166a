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
using FractalEngine.Parsing.Exports.Csv;
using FractalEngine.Parsing.Exports.Gltf;
using FractalEngine.Parsing.Exports.Ply;
using FractalEngine.Parsing.Exports.Stl;
using FractalEngine.Parsing.Exports.ThreeMf;
using FractalEngine.Parsing.Exports.Web;
using FractalEngine.Parsing.Wavefront.Writing;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>export FILE --output X.obj</c>, which writes a file for other programs, fractals expanded.</summary>
internal static class ExportCommand
{
    // Beside OBJ, which has a file for its materials.
    private static readonly ImmutableArray<SceneExport> Formats =
    [
        new PlyExport(), new StlExport(), new ThreeMfExport(), new CsvExport(), new GltfExport(), new WebExport(),
    ];

    private static string Endings { get; } = string.Join('|', [".obj", .. Formats.Select(static format => format.Ending)]);

    public static Command Create()
    {
        var shared = new SharedOptions();
        var output = SharedOptions.OutputOption(Endings, "File to write; its ending says the format.");
        var depth = NumberOption.Integer("--depth", "N", 0, int.MaxValue, "Recursion depth, overriding the fractal's file.");
        var noMaterials = SharedOptions.Flag("--no-materials", "Write no material file (.mtl) beside the mesh.");
        var frame = new ExportOptions();
        var report = new ReportOptions();
        var command = new DocumentedCommand(
            "export", "Write all that FILE shows for other programs, with fractals expanded.",
            "export assets/fractals/menger-3.fdo --output out/menger.obj", "export assets/fractals/tree.fdo --depth 3 --output -")
        {
            output, depth, noMaterials,
        };
        frame.AddTo(command);
        shared.AddTo(command);
        report.AddTo(command);
        command.SetAction(result =>
        {
            frame.RequireEffect(result, result.GetRequiredValue(output));
            return Run(
                result.GetRequiredValue(shared.File), shared.LoadOptions(result) with { Depth = result.GetValue(depth) },
                result.GetRequiredValue(output), !result.GetValue(noMaterials), frame.SettingsOf(result), frame.IsWelded(result),
                report.Begin(result));
        });
        return command;
    }

    private static int Run(
        string path, LoadOptions options, string output, bool hasMaterials, ExportSettings settings, bool isWelded, WrittenReport report)
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

        var scene = file.Scene;
        var remark = "";
        if (isWelded)
        {
            scene = report.Measure("weld", () => JoinedScene.Of(scene, settings, isWelded: true));
            settings = settings with { MaxInstances = null };
            remark = $", {JoinedScene.Describe(scene)}";
        }

        if (format is not null)
        {
            ExportSummary? summary = null;
            settings = settings with { Load = options };
            report.Measure("write", () => OutputFile.Write(output, stream => summary = format.Write(scene, settings, stream)));
            report.Written(output, summary!.Contents + remark);
            foreach (var loss in summary.Losses)
            {
                Console.Error.WriteLine(DisplayText.Escape($"{output}: warning: {loss}"));
            }

            return ExitCode.Done;
        }

        var faceCount = 0L;
        var materials = hasMaterials ? ExportedMaterials.For(scene, output) : null;
        report.Measure("write", () =>
        {
            if (materials is null)
            {
                OutputFile.Write(output, stream => faceCount = ObjSceneWriter.Write(scene, stream, settings, null, ""));
            }
            else
            {
                OutputFile.WritePair(
                    materials.Path, materials.Write,
                    output, stream => faceCount = ObjSceneWriter.Write(
                        scene, stream, settings, materials.Materials, materials.Name));
            }
        });
        var faces = (faceCount == 1 ? "1 face" : FormattableString.Invariant($"{faceCount} faces")) + remark;
        report.Written(output, materials is null ? faces : $"{faces}, {materials.Describe()}");
        materials?.WarnOfOutsideTextures();
        return ExitCode.Done;
    }
}
