using System.CommandLine;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Render.Preparation;

namespace FractalEngine.App.Commands;

/// <summary><c>render FILE --output X.png</c></summary>
internal static class RenderCommand
{
    private const double MaxTime = 3600;

    public static Command Create()
    {
        var shared = new SharedOptions();
        var draw = new DrawOptions();
        var output = SharedOptions.OutputOption(".png", "The picture to write.");
        var command = new Command("render", "Draw a file into a picture, without a window.") { output };
        var time = new Option<double?>("--time")
        {
            Description = "Let the physics run for so many seconds first.",
            HelpName = "SECONDS",
            CustomParser = SharedOptions.ParseNumber(0, MaxTime),
        };
        shared.AddTo(command);
        draw.AddTo(command);
        command.Add(time);
        command.SetAction(result => Run(
            result.GetRequiredValue(shared.File), draw.WithLoadOptions(result, shared.LoadOptions(result)), result.GetRequiredValue(output),
            draw.Resolution(result), draw.Projection(result), draw.Settings(result), result.GetValue(time) ?? 0));
        return command;
    }

    /// <summary>Draws a file into a picture.</summary>
    public static int Run(
        string path, LoadOptions options, string output, (int Width, int Height) size, Projection? projection, RenderSettings settings,
        double time = 0)
    {
        var file = ConsoleLoader.Load(path, options);
        var scene = projection is { } requestedProjection
            ? file.Scene with { Scene = file.Scene.Scene with { Projection = requestedProjection } }
            : file.Scene;
        // A camera that the scene leaves open frames it as it is at first, so that pictures of several times show the same.
        var view = View.Of(scene, (double)size.Width / size.Height);
        var drawable = DrawableScene.Prepare(time > 0 ? Simulate(path, scene, time) : scene, settings);
        foreach (var notice in drawable.Notices)
        {
            Console.Error.WriteLine(notice);
        }

        var image = OffscreenRenderer.Render(drawable, view, size.Width, size.Height, settings);
        Directory.CreateDirectory(Path.GetDirectoryName(Path.GetFullPath(output))!);
        ImageFile.SavePng(image, output);
        return ExitCode.Done;
    }

    private static LoadedScene Simulate(string path, LoadedScene scene, double seconds)
    {
        var world = SceneWorld.Create(path, scene, new());
        while (world.Time + (0.5 * world.Settings.TimeStep) < seconds)
        {
            SceneWorld.Step(path, world);
        }

        return world.GetCurrentScene();
    }
}
