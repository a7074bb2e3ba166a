using System.CommandLine;
using System.Text;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Assets.References;
using FractalEngine.Parsing.Editing;
using FractalEngine.Parsing.Sdo;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>save FILE --output Y.sdo</c>, which loads a file and writes it as a scene.</summary>
internal static class SaveCommand
{
    public static Command Create()
    {
        var shared = new SharedOptions();
        var output = SharedOptions.OutputOption(".sdo", "Scene to write.");
        var report = new ReportOptions();
        var command = new DocumentedCommand(
            "save", "Load a scene and write it back; a mesh or fractal becomes a scene with one object.",
            "save assets/fractals/tree.fdo --output assets/scenes/mine.sdo", "save assets/models/bell.obj --output -")
        {
            output,
        };
        shared.AddTo(command, hasComposition: false);
        report.AddTo(command);
        command.SetAction(result => Run(
            result.GetRequiredValue(shared.File), shared.LoadOptions(result), result.GetRequiredValue(output), report.Begin(result)));
        return command;
    }

    private static int Run(string path, LoadOptions options, string output, WrittenReport report)
    {
        var file = report.Measure("load", () => ConsoleLoader.Load(path, options));
        report.Measure("write", () => Save(file, output));
        report.Written(output, $"{file.Scene.Scene.Objects.Length} {(file.Scene.Scene.Objects.Length == 1 ? "object" : "objects")}");
        return ExitCode.Done;
    }

    /// <summary>Writes the scene of a file. File names become relative to the output.</summary>
    /// <exception cref="IOException">The path of a file can't be written in a scene.</exception>
    private static void Save(LoadedFile file, string output)
    {
        var relocated = NewSceneFile.Relocate(file, file.Scene.Scene, Path.GetFullPath(output));
        // Editors that need a byte order mark wrote it. UTF-16 becomes UTF-8 with one.
        var mark = file.ParsedScene?.Source.HasByteOrderMark == true ? "\uFEFF" : "";
        OutputFile.Write(output, stream => stream.Write(Encoding.UTF8.GetBytes(mark + SceneWriter.Write(relocated, file.ParsedScene))));
        var folder = AssetFolder.ForFile(Path.GetFullPath(output));
        var image = (file.Scene.Scene.Sky as ImageSky)?.Image?.SourcePath;
        if (file.Scene.Models.Select(static model => model.SourcePath).Append(image).OfType<string>().Any(path => !folder.Contains(path)))
        {
            Console.Error.WriteLine($"warning: {output} refers to files outside its folder, so it opens only with --allow-outside");
        }
    }
}
