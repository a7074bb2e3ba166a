using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Render;

/// <summary>Pictures without a window on the screen.</summary>
public static class OffscreenRenderer
{
    /// <summary>Draws a scene as its file asks for.</summary>
    /// <param name="scene">With its files loaded.</param>
    /// <param name="width">Pixels.</param>
    /// <param name="height">Pixels.</param>
    /// <param name="settings">Budgets and style; the defaults when null.</param>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
    /// <exception cref="Gl.GlException">The picture or the scene is too large for the driver.</exception>
    public static PixelImage Render(LoadedScene scene, int width, int height, RenderSettings? settings = null) =>
        Render(
            DrawableScene.Prepare(scene, settings ?? new()), View.Of(scene, (double)width / height), width, height, settings);

    /// <summary>Draws a prepared scene, seen as the view says.</summary>
    /// <param name="scene">Prepared, on whatever thread.</param>
    /// <param name="view">Camera and projection.</param>
    /// <param name="width">Pixels.</param>
    /// <param name="height">Pixels.</param>
    /// <param name="settings">Style; the defaults when null.</param>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
    /// <exception cref="Gl.GlException">The picture or the scene is too large for the driver.</exception>
    public static PixelImage Render(DrawableScene scene, View view, int width, int height, RenderSettings? settings = null)
    {
        using var context = new OffscreenContext();
        using var renderer = new SceneRenderer(context, scene);
        using var frame = new FrameRenderer(context);
        frame.Draw(renderer, view, width, height, settings ?? new());
        return frame.Capture();
    }
}
