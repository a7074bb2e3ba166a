using System.CommandLine;
using FractalEngine.App.Window;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;

namespace FractalEngine.App.Commands;

/// <summary><c>[view] [FILE]</c>: what the program does when it is told nothing else.</summary>
internal static class ViewCommand
{
    private const string Gallery = "assets/scenes/gallery.sdo";

    // Set by run.sh where it brings up a virtual display that nobody looks at.
    private const string NoWindowVariable = "FRACTALENGINE_NO_WINDOW";

    public static Command Create()
    {
        var shared = new SharedOptions();
        var draw = new DrawOptions();
        shared.File.Arity = ArgumentArity.ZeroOrOne;
        var command = new Command("view", "Open a window on a file, or on the gallery. This is what happens without a command, too.");
        shared.AddTo(command);
        draw.AddTo(command);
        command.SetAction(result => Run(
            result.GetValue(shared.File) ?? FindGallery(), shared.LoadOptions(result),
            draw.Resolution(result), draw.Projection(result), draw.Settings(result)));
        return command;
    }

    private static int Run(string path, LoadOptions options, (int Width, int Height) size, Projection? projection, RenderSettings settings)
    {
        if (Environment.GetEnvironmentVariable(NoWindowVariable) is not "1")
        {
            return SceneWindow.Show(path, options, projection, settings, size);
        }

        var output = Path.Combine("out", Path.GetFileNameWithoutExtension(path) + ".png");
        var exitCode = RenderCommand.Run(path, options, output, size, projection, settings);
        Console.Error.WriteLine($"there is no display to open a window on: drew {output} instead");
        return exitCode;
    }

    /// <summary>The gallery of the source tree that the program was built in, wherever it is started.</summary>
    private static string FindGallery()
    {
        for (var folder = AppContext.BaseDirectory; folder is not null; folder = Path.GetDirectoryName(folder))
        {
            var gallery = Path.Combine(folder, Gallery);
            if (File.Exists(gallery))
            {
                return Path.GetRelativePath(Directory.GetCurrentDirectory(), gallery);
            }
        }

        throw new UsageException($"{Gallery} is not beside the program: name a file to view");
    }
}
