using System.CommandLine;
using System.Text;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Scenes;

namespace FractalEngine.App.Commands;

/// <summary><c>save FILE --output Y.sdo</c></summary>
internal static class SaveCommand
{
    public static Command Create()
    {
        var shared = new SharedOptions();
        var output = SharedOptions.OutputOption(".sdo", "The scene to write.");
        var command = new Command("save", "Load a scene and write it back; a mesh or fractal becomes a scene of one object.") { output };
        shared.AddTo(command, hasComposition: false);
        command.SetAction(result => Run(result.GetRequiredValue(shared.File), shared.LoadOptions(result), result.GetRequiredValue(output)));
        return command;
    }

    private static int Run(string path, LoadOptions options, string output)
    {
        var file = ConsoleLoader.Load(path, options);
        Save(file, file.Scene.Scene, output);
        return ExitCode.Done;
    }

    /// <summary>Writes a scene, which may have changed since it was loaded; file names are made relative to its new place.</summary>
    public static void Save(LoadedFile file, Core.Scenes.Scene scene, string output)
    {
        var relocated = SceneRelocation.Relocate(scene, file.Path, Path.GetFullPath(output));
        if (relocated.Objects.Any(declared => declared.File!.IndexOfAny(['"', '\n', '\r']) >= 0))
        {
            throw new UsageException("a scene can't name a file that has a quote or a line break in its path");
        }

        AtomicFile.Write(output, stream => stream.Write(Encoding.UTF8.GetBytes(SceneWriter.Write(relocated, file.SceneFile))));
        var folder = AssetFolder.ForFile(Path.GetFullPath(output));
        if (file.Scene.Models.Any(model => !folder.Contains(model.SourcePath!)))
        {
            Console.Error.WriteLine($"warning: {output} names files outside its folder: it opens only with --allow-outside");
        }
    }
}
