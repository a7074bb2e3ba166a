using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Jobs;

/// <summary>Draws one scene into images, from any number of views, before the background of a command.</summary>
/// <param name="drawable">The scene.</param>
/// <param name="job">Size, background and settings of the images.</param>
/// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
internal sealed class ImageRenderer(DrawableScene drawable, RenderJob job) : IDisposable
{
    private readonly Renderer _renderer = Renderer.Offscreen(job.Size.Width, job.Size.Height, job.Settings);

    /// <summary>Places an object elsewhere.</summary>
    /// <param name="index">Index of the object in the scene, from 0.</param>
    /// <param name="map">From the frame of the object to world space.</param>
    public void Move(int index, AffineMap map) => _renderer.Move(drawable, index, map);

    /// <summary>Draws the scene as a view shows it.</summary>
    public PixelImage Draw(View view) => job.Background.IsTransparent
        ? Matting.Combine(DrawOn(view, Colour.Black), DrawOn(view, Colour.White))
        : DrawOn(view, job.Background.Colour);

    /// <inheritdoc/>
    public void Dispose() => _renderer.Dispose();

    private PixelImage DrawOn(View view, Colour? background) =>
        _renderer.Draw(drawable, background is null ? view : view with { Background = background });
}
