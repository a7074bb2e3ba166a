using System.Collections.Immutable;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Render.Images;
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

    /// <summary>Makes a frame. Frames must be asked for in order.</summary>
    /// <param name="frame">Index of the frame, from 0.</param>
    /// <param name="cancellation">Ends the work.</param>
    /// <exception cref="OperationCanceledException">The work was cancelled.</exception>
    public PixelImage Create(int frame, CancellationToken cancellation)
    {
        if (animation.PartCount == 1)
        {
            return CreateAt(frame, 0, cancellation);
        }

        var (width, height) = animation.Images.Size;
        var mean = new ImageMean(width, height);
        for (var part = 0; part < animation.PartCount; part++)
        {
            mean.Add(CreateAt(frame + (animation.Shutter * (part + 0.5) / animation.PartCount), part, cancellation));
        }

        return mean.ToImage();
    }

    private PixelImage CreateAt(double frame, int part, CancellationToken cancellation)
    {
        var time = animation.TimeOf(frame);
        if (bodies?.AdvanceTo(time, cancellation) == true)
        {
            frames.Move(bodies);
        }

        if (scene.Scene.Film is { HasNumbers: true } film && !HaveSameValues(film.ValuesAt(time), film.ValuesAt(_shownTime)))
        {
            frames.Replace(animation.Images.LoadAt(time, _cache));
            _shownTime = time;
        }

        return frames.CreateFrame(motion(frame), part, cancellation);
    }

    private static bool HaveSameValues(
        ImmutableDictionary<string, double> values, ImmutableDictionary<string, double> others) =>
        values.All(pair => others[pair.Key].Equals(pair.Value));
}
