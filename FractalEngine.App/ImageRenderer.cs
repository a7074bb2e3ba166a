using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App;

/// <summary>Draws one scene into images, from any number of views. Owns an OpenGL context without a window.</summary>
internal sealed class ImageRenderer : IDisposable
{
    private readonly (int Width, int Height) _size;
    private readonly RenderSettings _settings;
    private readonly BackgroundChoice _background;
    private readonly OffscreenContext _context = new();
    private readonly FrameRenderer _frames;
    private readonly SceneRenderer _scene;

    /// <summary>Opens a context and uploads a scene to it.</summary>
    /// <param name="drawable">The scene.</param>
    /// <param name="size">Width and height of the images in pixels.</param>
    /// <param name="settings">Style, budgets and optimisations.</param>
    /// <param name="background">What the images show behind the scene.</param>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
    public ImageRenderer(DrawableScene drawable, (int Width, int Height) size, RenderSettings settings, BackgroundChoice background)
    {
        (_size, _settings, _background) = (size, settings, background);
        try
        {
            _frames = new(_context);
            _scene = new(_context, drawable);
        }
        catch
        {
            _frames?.Dispose();
            _context.Dispose();
            throw;
        }
    }

    /// <summary>Places an object elsewhere.</summary>
    /// <param name="index">Index of the object in the scene, from 0.</param>
    /// <param name="map">From the frame of the object to world space.</param>
    public void Move(int index, AffineMap map) => _scene.Move(index, map);

    /// <summary>Draws the scene as a view shows it.</summary>
    public PixelImage Draw(View view) => _background.IsTransparent
        ? Matting.Combine(DrawOn(view, Colour.Black), DrawOn(view, Colour.White))
        : DrawOn(view, _background.Colour);

    /// <inheritdoc/>
    public void Dispose()
    {
        _context.MakeCurrent();
        _scene.Dispose();
        _frames.Dispose();
        _context.Dispose();
    }

    private PixelImage DrawOn(View view, Colour? background)
    {
        _frames.Draw(_scene, background is null ? view : view with { Background = background }, _size.Width, _size.Height, _settings);
        return _frames.Capture();
    }
}
