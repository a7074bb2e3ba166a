using System.CommandLine;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Meshes;

namespace FractalEngine.App.Commands;

/// <summary><c>export FILE --output X.obj</c></summary>
internal static class ExportCommand
{
    public static Command Create()
    {
        var shared = new SharedOptions();
        var output = SharedOptions.OutputOption(".obj", "The mesh to write.");
        var depth = new Option<long?>("--depth")
        {
            Description = "The depth of the recursion, whatever the fractal's file says.",
            HelpName = "N",
            CustomParser = SharedOptions.ParseInteger(0, int.MaxValue),
        };
        var maxFaces = new Option<long?>("--limit")
        {
            Description = $"The most faces to write; {FractalLimits.MaxExportedFaces} unless stated.",
            HelpName = "FACES",
            CustomParser = SharedOptions.ParseInteger(1, int.MaxValue),
        };
        var command = new Command("export", "Write all faces of a file, fractals expanded, as one flat mesh.") { output, depth, maxFaces };
        shared.AddTo(command);
        command.SetAction(result => Run(
            result.GetRequiredValue(shared.File), shared.LoadOptions(result) with { Depth = (int?)result.GetValue(depth) },
            result.GetRequiredValue(output), result.GetValue(maxFaces) ?? FractalLimits.MaxExportedFaces));
        return command;
    }

    private static int Run(string path, LoadOptions options, string output, long maxFaces)
    {
        if (options.Depth > FractalLimits.MaxDepth)
        {
            throw new FractalLimitException($"--depth is more than the limit of {FractalLimits.MaxDepth}");
        }

        var file = ConsoleLoader.Load(path, options);
        if (file.Scene.Models.Select(model => model.SourcePath).Append(file.Path).Contains(Path.GetFullPath(output)))
        {
            throw new UsageException($"{output} is one of the files to export: it is not overwritten");
        }

        if (options.Depth is not null && !file.Scene.Models.Any(model => model is FractalModel { Fractal.Description.HasDepth: true }))
        {
            throw new UsageException($"{path} has no recursive fractal, so --depth has nothing to change");
        }

        AtomicFile.Write(output, stream => ObjWriter.Write(file.Scene, stream, maxFaces));
        return ExitCode.Done;
    }
}
