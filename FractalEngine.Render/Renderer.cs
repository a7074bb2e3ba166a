using FractalEngine.Core;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Render;

/// <summary>Draws scenes into images, from scenes made in code as well as from loaded ones.</summary>
/// <remarks>
/// A renderer owns an OpenGL context. Use and dispose it on the thread that created it; on macOS this is the main thread. The last scene
/// stays prepared and on the GPU, so that drawing the same object again, as from another camera, costs only the frame.
/// </remarks>
/// <example>
/// <code>
/// using var renderer = Renderer.Offscreen(1280, 720);
/// renderer.Draw(scene, CameraFraming.Default(scene)).SavePng("sponge.png");
/// </code>
/// </example>
public sealed class Renderer : IDisposable
{
    private readonly OffscreenContext _context;
    private readonly FrameRenderer _frameRenderer;

    // Scene in the caller's form, whose preparation is kept.
    private object? _source;
    private SceneRenderer? _sceneRenderer;
    private bool _isDisposed;

    private Renderer(int width, int height, RenderSettings settings)
    {
        Width = width;
        Height = height;
        Settings = settings;
        _context = new();
        try
        {
            _frameRenderer = new(_context);
        }
        catch
        {
            _context.Dispose();
            throw;
        }
    }

    /// <summary>Width of the images in pixels.</summary>
    public int Width { get; }

    /// <summary>Height of the images in pixels.</summary>
    public int Height { get; }

    /// <summary>Style, budgets and optimisations of all images.</summary>
    public RenderSettings Settings { get; }

    /// <summary>Sentences for the user about whatever the last scene does not show in full.</summary>
    public IReadOnlyList<string> Notices => _sceneRenderer is null ? [] : _sceneRenderer.Scene.Notices;

    /// <summary>Creates a renderer without a visible window.</summary>
    /// <param name="width">Width of the images in pixels, at least 1.</param>
    /// <param name="height">Height of the images in pixels, at least 1.</param>
    /// <param name="settings">Style, budgets and optimisations; the defaults when null.</param>
    /// <exception cref="ArgumentOutOfRangeException">Width or height is less than 1.</exception>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
    /// <exception cref="GlException">The driver refuses a shader.</exception>
    public static Renderer Offscreen(int width, int height, RenderSettings? settings = null)
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(width, 1);
        ArgumentOutOfRangeException.ThrowIfLessThan(height, 1);
        return new(width, height, settings ?? new());
    }

    /// <summary>Draws a scene whose objects have their models.</summary>
    /// <param name="scene">Scene made in code, or loaded from a file.</param>
    /// <param name="camera">Camera in place of the scene's own; null for that, or for one that frames the scene where it has none.</param>
    /// <returns>A new image of <see cref="Width"/> × <see cref="Height"/> pixels.</returns>
    /// <exception cref="FractalEngineException">An object names a file that is not loaded.</exception>
    /// <exception cref="GlException">The image or the scene is too large for the driver.</exception>
    /// <exception cref="ObjectDisposedException">The renderer was disposed.</exception>
    /// <exception cref="InvalidOperationException">This is not the thread that created the renderer.</exception>
    public PixelImage Draw(Scene scene, Camera? camera = null)
    {
        ArgumentNullException.ThrowIfNull(scene);
        var sceneRenderer = Load(scene, () => DrawableScene.Prepare(LoadedScene.Of(scene), Settings));
        return DrawFrame(sceneRenderer, DefaultView(sceneRenderer.Scene.Source, camera));
    }

    /// <summary>Draws a loaded scene, such as a file's, with its own camera or another one.</summary>
    /// <param name="scene">Scene with its models.</param>
    /// <param name="camera">Camera in place of the scene's own; null for that, or for one that frames the scene where it has none.</param>
    /// <returns>A new image of <see cref="Width"/> × <see cref="Height"/> pixels.</returns>
    /// <exception cref="GlException">The image or the scene is too large for the driver.</exception>
    /// <exception cref="ObjectDisposedException">The renderer was disposed.</exception>
    /// <exception cref="InvalidOperationException">This is not the thread that created the renderer.</exception>
    public PixelImage Draw(LoadedScene scene, Camera? camera = null)
    {
        ArgumentNullException.ThrowIfNull(scene);
        return Draw(scene, DefaultView(scene, camera));
    }

    /// <summary>Draws a scene as a view shows it.</summary>
    /// <param name="scene">Scene made in code, or loaded from a file.</param>
    /// <param name="view">Camera and projection.</param>
    /// <returns>A new image of <see cref="Width"/> × <see cref="Height"/> pixels.</returns>
    /// <exception cref="GlException">The image or the scene is too large for the driver.</exception>
    /// <exception cref="ObjectDisposedException">The renderer was disposed.</exception>
    /// <exception cref="InvalidOperationException">This is not the thread that created the renderer.</exception>
    public PixelImage Draw(LoadedScene scene, View view)
    {
        ArgumentNullException.ThrowIfNull(scene);
        return DrawFrame(Load(scene, () => DrawableScene.Prepare(scene, Settings)), view);
    }

    /// <summary>Draws a prepared scene as a view shows it.</summary>
    /// <param name="scene">Scene that was prepared before, on any thread.</param>
    /// <param name="view">Camera and projection.</param>
    /// <returns>A new image of <see cref="Width"/> × <see cref="Height"/> pixels.</returns>
    /// <exception cref="GlException">The image or the scene is too large for the driver.</exception>
    /// <exception cref="ObjectDisposedException">The renderer was disposed.</exception>
    /// <exception cref="InvalidOperationException">This is not the thread that created the renderer.</exception>
    public PixelImage Draw(DrawableScene scene, View view)
    {
        ArgumentNullException.ThrowIfNull(scene);
        return DrawFrame(Load(scene, () => scene), view);
    }

    /// <summary>Draws the light of a prepared scene, with <see cref="RenderSettings.KeepsLight"/>.</summary>
    /// <param name="scene">Scene that was prepared before, on any thread.</param>
    /// <param name="view">Camera and projection. A background is what the scene's exposure and tone curve show as its colour.</param>
    /// <returns>Linear light of the scene before exposure and tone curve, <see cref="Width"/> × <see cref="Height"/> pixels.</returns>
    /// <exception cref="GlException">The image or the scene is too large for the driver.</exception>
    /// <exception cref="ObjectDisposedException">The renderer was disposed.</exception>
    /// <exception cref="InvalidOperationException">
    /// This is not the thread that created the renderer, or its settings don't keep light.
    /// </exception>
    public FloatImage DrawLight(DrawableScene scene, View view)
    {
        ArgumentNullException.ThrowIfNull(scene);
        DrawFrames(Load(scene, () => scene), view);
        return _frameRenderer.CaptureLight();
    }

    /// <summary>Moves an object of a prepared scene for the images that follow, until another scene is drawn.</summary>
    /// <param name="scene">Scene that was prepared before, on any thread.</param>
    /// <param name="objectIndex">Index of the object in the scene, from 0.</param>
    /// <param name="map">Map from the model's frame to world space.</param>
    /// <exception cref="GlException">The scene is too large for the driver.</exception>
    /// <exception cref="ObjectDisposedException">The renderer was disposed.</exception>
    /// <exception cref="InvalidOperationException">This is not the thread that created the renderer.</exception>
    public void Move(DrawableScene scene, int objectIndex, AffineMap map)
    {
        ArgumentNullException.ThrowIfNull(scene);
        Load(scene, () => scene).Move(objectIndex, map);
    }

    /// <summary>Deletes the scene on the GPU and ends the context. Harmless when repeated.</summary>
    /// <exception cref="InvalidOperationException">This is not the thread that created the renderer.</exception>
    public void Dispose()
    {
        if (_isDisposed)
        {
            return;
        }

        _context.MakeCurrent();
        _isDisposed = true;
        _source = null;
        GlObject.DisposeAll(_sceneRenderer, _frameRenderer, _context);
    }

    private View DefaultView(LoadedScene scene, Camera? camera) => View.Of(scene, (double)Width / Height, camera);

    /// <summary>Returns the renderer of a scene, which is prepared and uploaded unless it is the last one.</summary>
    private SceneRenderer Load(object source, Func<DrawableScene> prepare)
    {
        ObjectDisposedException.ThrowIf(_isDisposed, this);
        if (_sceneRenderer is null || !ReferenceEquals(_source, source))
        {
            var prepared = prepare();
            _sceneRenderer?.Dispose();
            _sceneRenderer = null;
            _sceneRenderer = new(_context, prepared);
            _source = source;
        }

        return _sceneRenderer;
    }

    private PixelImage DrawFrame(SceneRenderer scene, View view)
    {
        DrawFrames(scene, view);
        return _frameRenderer.Capture();
    }

    private void DrawFrames(SceneRenderer scene, View view)
    {
        _frameRenderer.Draw(scene, view, Width, Height, Settings);
        while (_frameRenderer.GatheredCount < FrameRenderer.FrameCountOf(view, Settings))
        {
            _frameRenderer.Gather(scene, view, Settings);
        }
    }
}
