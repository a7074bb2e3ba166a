using FractalEngine.App.Jobs;
using FractalEngine.Core.Images;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Animation;

/// <summary>Draws the frames of an animation with OpenGL.</summary>
/// <param name="drawable">The prepared scene.</param>
/// <param name="job">Size, background and settings of the frames.</param>
internal sealed class DrawnFrames(DrawableScene drawable, RenderJob job) : FrameSource
{
    private readonly ImageRenderer _renderer = new(drawable, job);

    /// <inheritdoc/>
    public override PixelImage CreateFrame(View view, CancellationToken cancellation)
    {
        cancellation.ThrowIfCancellationRequested();
        return _renderer.Draw(view);
    }

    /// <inheritdoc/>
    public override void Move(AnimatedBodies bodies)
    {
        foreach (var (index, map) in bodies.Maps)
        {
            _renderer.Move(index, map);
        }
    }

    /// <inheritdoc/>
    public override void Dispose()
    {
        _renderer.Dispose();
        base.Dispose();
    }
}
