using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Jobs;

/// <summary>What a command draws into images.</summary>
/// <param name="Path">Path of the mesh, fractal or scene.</param>
/// <param name="Load">The load options of the file.</param>
/// <param name="Size">Width and height in pixels.</param>
/// <param name="Projection">Overrides the projection of the scene; null keeps it.</param>
/// <param name="Settings">The render settings of each frame.</param>
internal sealed record RenderJob(
    string Path, LoadOptions Load, (int Width, int Height) Size, Projection? Projection, RenderSettings Settings)
{
    /// <summary>The physics time at which the scene is drawn, in seconds.</summary>
    public double Time { get; init; }

    /// <summary>What is shown behind the scene.</summary>
    public BackgroundChoice Background { get; init; } = BackgroundChoice.OfScene;

    /// <summary>Creates the view of a scene for an aspect ratio, before any zoom.</summary>
    public required Func<LoadedScene, double, View> CreateView { get; init; }

    /// <summary>Number of levels that the camera flies into a fractal.</summary>
    public double ZoomLevels { get; init; }

    /// <summary>Returns a scene with the projection of the job.</summary>
    public LoadedScene WithProjection(LoadedScene scene) =>
        Projection is { } projection ? scene with { Scene = scene.Scene with { Projection = projection } } : scene;
}
