using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Tracing;

/// <summary>What is seen behind everything: the sky, or one colour.</summary>
internal readonly struct TracedBackground(Scene scene, DisplayTransform display)
{
    private readonly SkyRadiance? _sky = scene.Background is null ? scene.Sky?.ToRadiance(scene.Handedness) : null;

    // A background is shown as it is declared, whatever is done with light.
    private readonly Vector _radiance = display.Invert((scene.Background ?? RenderSettings.DefaultBackground).ToLinearVector());

    /// <summary>Whether rays that leave the scene see its sky, and not one colour.</summary>
    public bool IsSky => _sky is not null;

    /// <summary>Returns a scene with a background of its own, unless it shows the sky.</summary>
    /// <param name="scene">A scene.</param>
    /// <param name="background">Colour of the background where it declares none.</param>
    public static Scene DeclaredIn(Scene scene, Colour background) =>
        scene with { Background = scene.Background ?? (scene.Sky is null ? background : null) };

    /// <summary>The radiance that is seen in a direction.</summary>
    public Vector At(Vector unitDirection) => _sky is { } sky ? sky.At(unitDirection) : _radiance;
}
