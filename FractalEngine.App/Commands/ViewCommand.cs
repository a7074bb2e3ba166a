using System.CommandLine;
using FractalEngine.App.Window;

namespace FractalEngine.App.Commands;

/// <summary><c>[view] [FILE]</c>: what the program does when it is told nothing else.</summary>
internal static class ViewCommand
{
    private const string GalleryPath = "assets/scenes/gallery.sdo";

    private static readonly int DefaultTrailLength = new WindowOptions().TrailLength;

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
        var trailLength = new Option<long?>("--trail")
        {
            Description =
            $"The length of the queue with which key T follows the paper's way into a fractal; {DefaultTrailLength} unless stated.",
            HelpName = "N",
            CustomParser = SharedOptions.ParseInteger(1, 1000),
        };
        command.Add(trailLength);
        command.SetAction(result => Run(
            result.GetValue(shared.File) ?? FindGallery(),
            new()
            {
                Load = draw.WithLoadOptions(result, shared.LoadOptions(result)),
                Settings = draw.Settings(result),
                Projection = draw.Projection(result),
                TrailLength = (int)(result.GetValue(trailLength) ?? DefaultTrailLength),
                Size = draw.Resolution(result),
                IdleWhenUnchanged = draw.IsEnabled(result, Optimisation.Idle),
            }));
        return command;
    }

    private static int Run(string path, WindowOptions options)
    {
        if (Environment.GetEnvironmentVariable(NoWindowVariable) is not "1")
        {
            return SceneWindow.Show(path, options);
        }

        var output = Path.Combine("out", Path.GetFileNameWithoutExtension(path) + ".png");
        var exitCode = RenderCommand.Run(path, options.Load, output, options.Size, options.Projection, options.Settings);
        Console.Error.WriteLine($"there is no display to open a window on: drew {output} instead");
        return exitCode;
    }

    /// <summary>The gallery of the source tree that the program was built in, wherever it is started.</summary>
    private static string FindGallery()
    {
        for (var folder = AppContext.BaseDirectory; folder is not null; folder = Path.GetDirectoryName(folder))
        {
            var gallery = Path.Combine(folder, GalleryPath);
            if (File.Exists(gallery))
            {
                return Path.GetRelativePath(Directory.GetCurrentDirectory(), gallery);
            }
        }

        throw new UsageException($"{GalleryPath} is not beside the program: name a file to view");
    }
}
