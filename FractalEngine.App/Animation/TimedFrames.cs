using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Render.Images;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Animation;

/// <summary>Makes the frames of an animation at their times: moves bodies, changes numbers of the film, and opens the shutter.</summary>
/// <param name="animation">What moves.</param>
/// <param name="frames">Makes images of the present scene.</param>
/// <param name="motion">The camera at each frame, and between two.</param>
/// <param name="scene">The scene at the first frame.</param>
/// <param name="bodies">The bodies; null where they stand.</param>
internal sealed class TimedFrames(
    AnimationJob animation, FrameSource frames, Func<double, View> motion, LoadedScene scene, AnimatedBodies? bodies)
{
    private readonly AssetCache _cache = new();
    private double _shownTime = animation.TimeOf(0);

    /// <summary>Passes over a frame that is not asked for: a camera that flies into a fractal goes on from it.</summary>
    /// <param name="frame">Index of the frame, from 0.</param>
    public void Skip(int frame) => motion(frame);

    /// <summary>Makes a frame. Frames must be asked for in order.</summary>
    /// <param name="frame">Index of the frame, from 0.</param>
    /// <param name="cancellation">Ends the work.</param>
    /// <exception cref="OperationCanceledException">The work was cancelled.</exception>
    public PixelImage Create(int frame, CancellationToken cancellation)
    {
        if (animation.PartCount == 1)
        {
            return CreateAt(frame, 0, frames.CreateFrame, cancellation);
        }

        var (width, height) = animation.Images.Size;
        var mean = new ImageMean(width, height);
        for (var part = 0; part < animation.PartCount; part++)
        {
            mean.Add(CreateAt(PartOf(frame, part), part, frames.CreateFrame, cancellation));
        }

        return mean.ToImage();
    }

    /// <summary>Makes the light of a frame, with the other layers of its first image. Frames must be asked for in order.</summary>
    /// <inheritdoc cref="Create"/>
    public LightFrame CreateLight(int frame, CancellationToken cancellation)
    {
        var mean = CreateAt(animation.PartCount == 1 ? frame : PartOf(frame, 0), 0, frames.CreateLight, cancellation);
        for (var part = 1; part < animation.PartCount; part++)
        {
            var next = CreateAt(PartOf(frame, part), part, frames.CreateLight, cancellation);
            AddToMean(mean.Light.Pixels, next.Light.Pixels, part + 1);
            AddToMean(mean.Opacity ?? [], next.Opacity, part + 1);
        }

        return mean;
    }

    private static void AddToMean(float[] mean, float[]? next, int count)
    {
        for (var i = 0; i < mean.Length; i++)
        {
            mean[i] += (next![i] - mean[i]) / count;
        }
    }

    private double PartOf(int frame, int part) => frame + (animation.Shutter * (part + 0.5) / animation.PartCount);

    private T CreateAt<T>(double frame, int part, Func<View, int, CancellationToken, T> create, CancellationToken cancellation)
    {
        var time = animation.TimeOf(frame);
        if (bodies?.AdvanceTo(time, cancellation) == true)
        {
            frames.Move(bodies);
        }

        if (scene.Scene.Film is { HasNumbers: true } film && !film.HasSameValuesAt(time, _shownTime))
        {
            frames.Replace(animation.Images.LoadAt(time, _cache));
            _shownTime = time;
        }

        return create(motion(frame), part, cancellation);
    }
}
