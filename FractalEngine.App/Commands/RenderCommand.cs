using System.CommandLine;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>render FILE --output X.png</c>, which draws a file into an image without a window.</summary>
internal static class RenderCommand
{
    private const double MaxTime = 3600;

    /// <summary>Creates the command with its arguments and options.</summary>
    public static Command Create()
    {
        var shared = new SharedOptions();
        var draw = new DrawOptions();
        var output = SharedOptions.OutputOption(".png", "Image to write.");
        var time = NumberOption.Decimal("--time", "SECONDS", 0, MaxTime, "Simulate the physics for this time first (default: 0).");
        var command = new Command("render", "Draw FILE into a PNG image, without a window.") { output };
        shared.AddTo(command);
        draw.AddTo(command);
        command.Add(time);
        command.SetAction(result => Run(
            result.GetRequiredValue(shared.File), draw.WithLoadOptions(result, shared.LoadOptions(result)), result.GetRequiredValue(output),
            draw.Resolution(result), draw.Projection(result), draw.Settings(result), result.GetValue(time) ?? 0));
        return command;
    }

    /// <summary>Draws a file into an image.</summary>
    /// <param name="path">Path of the mesh, fractal or scene.</param>
    /// <param name="options">The load options of the file.</param>
    /// <param name="output">Path of the PNG to write.</param>
    /// <param name="size">Width and height in pixels.</param>
    /// <param name="projection">Overrides the projection of the scene; null keeps it.</param>
    /// <param name="settings">The render settings of the frame.</param>
    /// <param name="time">The physics time at which the scene is drawn, in seconds.</param>
    /// <returns>The exit code.</returns>
    public static int Run(
        string path, LoadOptions options, string output, (int Width, int Height) size, Projection? projection, RenderSettings settings,
        double time = 0)
    {
        var file = ConsoleLoader.Load(path, options);
        var scene = projection is { } requestedProjection
            ? file.Scene with { Scene = file.Scene.Scene with { Projection = requestedProjection } }
            : file.Scene;
        // A default camera frames the scene as it is at time 0, so that images of several times show the same view.
        var view = View.Of(scene, (double)size.Width / size.Height);
        var drawable = DrawableScene.Prepare(time > 0 ? Simulate(path, file, scene, time) : scene, settings);
        foreach (var notice in drawable.Notices)
        {
            Console.Error.WriteLine(notice);
        }

        using var renderer = Renderer.Offscreen(size.Width, size.Height, settings);
        var image = renderer.Draw(drawable, view);
        OutputFile.Write(output, stream => PngWriter.Write(image, stream));
        return ExitCode.Done;
    }

    private static LoadedScene Simulate(string path, LoadedFile file, LoadedScene scene, double seconds)
    {
        var world = SceneWorld.Create(file, scene, new());
        while (world.Time + (0.5 * world.Settings.TimeStep) < seconds)
        {
            SceneWorld.Step(path, world);
        }

        return world.GetCurrentScene();
    }
}
