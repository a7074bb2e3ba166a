using System.CommandLine;
using FractalEngine.App.Jobs;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.App.Window;
using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.State;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>[view] [FILE]</c>, which opens a window. It is the default command.</summary>
internal static class ViewCommand
{
    /// <summary>Largest length of the trail of the paper's zoom.</summary>
    public const int MaxTrailLength = 1000;

    private const string GalleryPath = "assets/scenes/gallery.sdo";

    private static readonly int DefaultTrailLength = new WindowOptions().TrailLength;

    // Set to 1 by run.sh where it starts a virtual display, which nobody can see.
    private const string NoWindowVariable = "FRACTALENGINE_NO_WINDOW";

    public static Command Create()
    {
        var shared = new SharedOptions();
        var draw = new DrawOptions();
        shared.File.Arity = ArgumentArity.ZeroOrOne;
        var command = new DocumentedCommand(
            "view", "Open FILE, or the gallery, in a window. This is the default command.",
            "assets/fractals/menger.fdo", "view assets/scenes/playground.sdo --shading pixel");
        var trailLength = NumberOption.Integer(
            "--trail", "N", 1, MaxTrailLength, $"Length of the trail of the paper's zoom, key T (default: {DefaultTrailLength}).");
        var noWatch = new Option<bool>("--no-watch") { Description = "Don't load files again when they change." };
        var trace = NumberOption.OptionalInteger(
            "--trace", "SAMPLES", 1, TraceOptions.MaxSamples, WindowOptions.DefaultTraceSampleCount,
            "Samples of each pixel of the image that is traced while the view stands still"
            + $" (default: {WindowOptions.DefaultTraceSampleCount}).");
        var noTrace = new Option<bool>("--no-trace") { Description = "Don't trace the view while it stands still. Key Y switches." };
        var noDenoise = SharedOptions.NoDenoiseOption();
        command.Validators.Add(result =>
        {
            if (result.GetResult(trace) is not null && result.GetValue(noTrace))
            {
                result.AddError("--no-trace: expected either --trace or --no-trace");
            }
        });
        shared.AddTo(command);
        draw.AddTo(command);
        SharedOptions.AddAll(command, noWatch, trailLength, trace, noTrace, noDenoise);
        command.SetAction(result =>
        {
            draw.RequireEffect(result, hasWindow: true);
            return Run(result.GetValue(shared.File) ?? FindGallery(), new()
            {
                Load = draw.Staged(result, shared.LoadOptions(result)),
                Settings = draw.Settings(result, DrawOptions.WindowGatheredFrames),
                Projection = draw.Projection(result),
                Section = draw.Section(result),
                TrailLength = result.GetValue(trailLength) ?? DefaultTrailLength,
                IsTraced = result.GetValue(noTrace) ? false : result.GetValue(trace) is null ? null : true,
                DenoisesTrace = !result.GetValue(noDenoise),
                TraceSampleCount = result.GetValue(trace) ?? WindowOptions.DefaultTraceSampleCount,
                Size = draw.Resolution(result),
                WatchesFiles = !result.GetValue(noWatch),
                SettingsPath = WindowSettings.DefaultPath,
                RecentFilesPath = RecentFiles.DefaultPath,
            });
        });
        return command;
    }

    private static int Run(string path, WindowOptions options)
    {
        if (Environment.GetEnvironmentVariable(NoWindowVariable) is not "1")
        {
            return Show(path, options);
        }

        var output = Path.Combine("out", Path.GetFileNameWithoutExtension(path) + ".png");
        var job = new RenderJob(path, options.Load, options.Size, options.Projection, options.Settings)
        {
            CreateView = (scene, aspect) => View.Of(scene, aspect) with { Section = options.Section },
        };
        RenderCommand.Run(job, trace: null, output, new(isQuiet: true, isVerbose: false));
        Console.Error.WriteLine($"there is no display for a window, so {output} was drawn instead");
        return ExitCode.Done;
    }

    private static int Show(string path, WindowOptions options)
    {
        try
        {
            return SceneWindow.Show(path, options);
        }
        catch (GraphicsUnavailableException) when (path != StandardInput.Name && !Path.Exists(path))
        {
            // A window would wait for the file to appear. Without one, the file is the user's first problem.
            ConsoleLoader.Load(path, options.Load);
            throw;
        }
    }

    /// <summary>Finds the gallery in the source tree that the program was built in, whatever the current folder is.</summary>
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

        throw new UsageException($"{GalleryPath} is not found, so the file to view must be named");
    }
}
