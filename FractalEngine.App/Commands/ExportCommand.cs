using System.CommandLine;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Meshes;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>export FILE --output X.obj</c>, which expands a file into one flat mesh.</summary>
internal static class ExportCommand
{
    /// <summary>Creates the command with its arguments and options.</summary>
    public static Command Create()
    {
        var shared = new SharedOptions();
        var output = SharedOptions.OutputOption(".obj", "Mesh to write.");
        var depth = NumberOption.Integer("--depth", "N", 0, int.MaxValue, "Recursion depth, overriding the fractal's file.");
        var command = new Command("export", "Write all faces of FILE as one flat mesh, with fractals expanded.")
        {
            output, depth,
        };
        shared.AddTo(command);
        command.SetAction(result => Run(
            result.GetRequiredValue(shared.File), shared.LoadOptions(result) with { Depth = result.GetValue(depth) },
            result.GetRequiredValue(output)));
        return command;
    }

    private static int Run(string path, LoadOptions options, string output)
    {
        if (options.Depth > FractalLimits.MaxDepth)
        {
            throw new FractalLimitException($"--depth {options.Depth} exceeds the limit of {FractalLimits.MaxDepth}");
        }

        var file = ConsoleLoader.Load(path, options);
        if (file.Scene.Models.Select(model => model.SourcePath).Append(file.Path).Contains(Path.GetFullPath(output)))
        {
            throw new UsageException($"{output} is one of the files to export, and is not overwritten");
        }

        if (options.Depth is not null && !file.Scene.Models.Any(model => model is FractalModel { Fractal.Description.HasDepth: true }))
        {
            throw new UsageException($"{path} has no recursive fractal, so --depth has no effect");
        }

        OutputFile.Write(output, stream => ObjWriter.Write(file.Scene, stream, FractalLimits.MaxExportedFaces));
        return ExitCode.Done;
    }
}
