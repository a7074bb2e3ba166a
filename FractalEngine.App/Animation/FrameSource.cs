using FractalEngine.Core.Images;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Animation;

/// <summary>Makes the frames of an animation from one scene, of which the bodies may move.</summary>
internal abstract class FrameSource : IDisposable
{
    /// <summary>Makes the image of a view.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="cancellation">Ends the work on an image that takes long.</param>
    /// <exception cref="OperationCanceledException">The work was cancelled.</exception>
    public abstract PixelImage CreateFrame(View view, CancellationToken cancellation);

    /// <summary>Makes the image of a view's light, with the layers of the job's format.</summary>
    /// <inheritdoc cref="CreateFrame"/>
    public abstract LightFrame CreateLight(View view, CancellationToken cancellation);

    public abstract void Move(AnimatedBodies bodies);

    public virtual void Dispose()
    {
    }
}
