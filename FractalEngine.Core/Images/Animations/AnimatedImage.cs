namespace FractalEngine.Core.Images.Animations;

/// <summary>Frames in one animated PNG, which repeats for ever.</summary>
/// <param name="path">Path of the file.</param>
/// <param name="framesPerSecond">Frames a second.</param>
internal sealed class AnimatedImage(string path, double framesPerSecond) : AnimationOutput(path)
{
    private readonly ApngAnimation _animation = new(framesPerSecond);

    /// <inheritdoc/>
    public override void Add(PixelImage frame)
    {
        ThrowIfDisposed();
        _animation.Add(frame);
    }

    /// <inheritdoc/>
    public override void Complete(bool isPartial = false)
    {
        ThrowIfDisposed();
        if (_animation.FrameCount > 0)
        {
            Save(_animation.Write, isPartial);
        }
    }
}
