using FractalEngine.App.Jobs;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Animation;

/// <summary>Draws an image, or the frames of an animation, with OpenGL, before the background of a command.</summary>
/// <param name="prepared">The prepared scene.</param>
/// <param name="job">Size, background and settings of the images.</param>
/// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
internal sealed class DrawnFrames(DrawableScene prepared, RenderJob job) : FrameSource
{
    private readonly Renderer _renderer = Renderer.Offscreen(job.Size.Width, job.Size.Height, job.Settings);
    private DrawableScene _drawable = prepared;

    public override PixelImage CreateFrame(View view, int part, CancellationToken cancellation)
    {
        cancellation.ThrowIfCancellationRequested();
        return job.Background.IsTransparent
            ? Matting.Combine(DrawOn(view, Colour.Black), DrawOn(view, Colour.White))
            : DrawOn(view, job.Background.Colour);
    }

    public override void Move(AnimatedBodies bodies)
    {
        foreach (var (index, map) in bodies.Maps)
        {
            _renderer.Move(_drawable, index, map);
        }
    }

    public override void Replace(LoadedScene scene)
    {
        var preparation = new ScenePreparation(job.Background.ApplyTo(scene), job.Settings, _drawable);
        preparation.PrepareAll(null, CancellationToken.None);
        if (preparation.HasUnbakedSky(job.Settings))
        {
            preparation.BakeSky(CancellationToken.None);
        }

        _drawable = preparation.Scene;
    }

    public override void Dispose()
    {
        _renderer.Dispose();
        base.Dispose();
    }

    private PixelImage DrawOn(View view, Colour? background) =>
        _renderer.Draw(_drawable, background is null ? view : view with { Background = background });
}
