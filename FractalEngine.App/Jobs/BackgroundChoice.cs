using FractalEngine.App.Shell;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;

namespace FractalEngine.App.Jobs;

/// <summary>What an image shows behind the scene.</summary>
/// <param name="IsTransparent">Whether the background lets through what is behind the image.</param>
/// <param name="Colour">The colour of the background; null for the scene's own. Without meaning where it is transparent.</param>
internal sealed record BackgroundChoice(bool IsTransparent, Colour? Colour)
{
    public static BackgroundChoice OfScene { get; } = new(false, null);

    /// <summary>Gives a scene this background, so that haze without a colour of its own fades to it.</summary>
    public LoadedScene ApplyTo(LoadedScene scene) =>
        Colour is { } colour ? scene with { Scene = scene.Scene with { Background = colour } } : scene;

    /// <summary>Parses the value of <c>--background</c>.</summary>
    /// <exception cref="UsageException">The value is neither <c>transparent</c> nor a colour.</exception>
    public static BackgroundChoice Parse(string? text) => text switch
    {
        null => OfScene,
        "transparent" => new(true, null),
        _ => new(false, CameraText.ParseColour("--background", text)),
    };
}
