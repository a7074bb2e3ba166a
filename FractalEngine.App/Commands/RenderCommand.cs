using System.CommandLine;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Pictures;
using FractalEngine.Render.Preparation;

namespace FractalEngine.App.Commands;

/// <summary><c>render FILE --output X.png</c></summary>
internal static class RenderCommand
{
    public static Command Create()
    {
        var shared = new SharedOptions();
        var draw = new DrawOptions();
        var output = SharedOptions.Output(".png", "The picture to write.");
        var command = new Command("render", "Draw a file into a picture, without a window.") { output };
        shared.AddTo(command);
        draw.AddTo(command);
        command.SetAction(result => Run(
            result.GetRequiredValue(shared.File), draw.Loading(result, shared.LoadOptions(result)), result.GetRequiredValue(output),
            draw.Resolution(result), draw.Projection(result), draw.Settings(result)));
        return command;
    }

    /// <summary>Draws a file into a picture.</summary>
    public static int Run(
        string path, LoadOptions options, string output, (int Width, int Height) size, Projection? projection, RenderSettings settings)
    {
        var file = Loading.Load(path, options);
        var scene = projection is { } asked ? file.Scene with { Scene = file.Scene.Scene with { Projection = asked } } : file.Scene;
        var drawable = DrawableScene.Prepare(scene, settings);
        foreach (var notice in drawable.Notices)
        {
            Console.Error.WriteLine(notice);
        }

        var view = View.Of(scene, (double)size.Width / size.Height);
        var image = OffscreenRenderer.Render(drawable, view, size.Width, size.Height, settings);
        Directory.CreateDirectory(Path.GetDirectoryName(Path.GetFullPath(output))!);
        ImageFile.SavePng(image, output);
        return ExitCode.Done;
    }
}
