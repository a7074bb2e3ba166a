using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Animation;

/// <summary>Makes the frames of an animation from one scene, of which the bodies may move.</summary>
internal abstract class FrameSource : IDisposable
{
    /// <summary>Makes the image of a view.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="part">Number of the image among those of one frame, from 0: each has its own noise.</param>
    /// <param name="cancellation">Ends the work on an image that takes long.</param>
    /// <exception cref="OperationCanceledException">The work was cancelled.</exception>
    public abstract PixelImage CreateFrame(View view, int part, CancellationToken cancellation);

    /// <summary>Makes the image of a view's light, with the layers of the job's format.</summary>
    /// <inheritdoc cref="CreateFrame"/>
    public abstract LightFrame CreateLight(View view, int part, CancellationToken cancellation);

    public abstract void Move(AnimatedBodies bodies);

    /// <summary>Shows another scene from now on, of which some models may be those of the present one.</summary>
    /// <param name="scene">With its models loaded.</param>
    public abstract void Replace(LoadedScene scene);

    public virtual void Dispose()
    {
    }
}
