using FractalEngine.App.Jobs;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Animation;

/// <summary>What an animation shows and where it goes.</summary>
/// <param name="Images">What each frame draws.</param>
/// <param name="Output">Path of the animation.</param>
/// <param name="FrameCount">Number of frames.</param>
/// <param name="FramesPerSecond">Frames a second.</param>
/// <param name="IsTurntable">Whether the camera turns once around the scene.</param>
/// <param name="CameraList">Path of a list of cameras; null for none.</param>
/// <param name="IsSimulated">Whether the physics objects move.</param>
internal sealed record AnimationJob(
    RenderJob Images, string Output, int FrameCount, double FramesPerSecond, bool IsTurntable, string? CameraList, bool IsSimulated)
{
    /// <summary>How the frames are traced; null where they are drawn.</summary>
    public TracedImage? Trace { get; init; }

    /// <summary>Requires something to move, at most one motion of the camera, and what the format of the output can hold.</summary>
    /// <exception cref="UsageException">Nothing moves, the motions contradict each other, or the format can't hold the frames.</exception>
    public void Check()
    {
        var motions = new[] { IsTurntable, CameraList is not null, Images.ZoomLevels > 0 }.Count(static asked => asked);
        if (motions > 1)
        {
            throw new UsageException("--turntable, --zoom and --path exclude each other");
        }

        if (motions == 0 && !IsSimulated)
        {
            throw new UsageException("nothing moves: expected --turntable, --zoom LEVELS, --path CAMERAS.txt or --simulate");
        }

        AnimationOutput.CheckFormat(Output, FramesPerSecond, Images.Background.IsTransparent);
    }

    /// <summary>Returns the physics time of a frame, in seconds.</summary>
    /// <param name="frame">Index of the frame, from 0.</param>
    public double TimeOf(int frame) => Images.Time + (frame / FramesPerSecond);

    /// <summary>Creates the motion of the camera: the view of each frame.</summary>
    /// <param name="scene">The scene as it is at first.</param>
    /// <param name="prepare">Prepares the scene for drawing, which only a zoom needs.</param>
    /// <param name="view">The view of a still image.</param>
    /// <param name="isQuiet">Whether nothing is told while that takes long.</param>
    /// <exception cref="UsageException">The scene or a list does not fit the motion.</exception>
    public Func<int, View> CreateMotion(LoadedScene scene, Func<DrawableScene> prepare, View view, bool isQuiet)
    {
        // The way into a fractal is measured first, which takes long for hundreds of levels.
        using var notice = new SlowWorkNotice("finding the camera's way", isQuiet);
        return this switch
        {
            { IsTurntable: true } => CameraMotion.Turntable(view, scene.Bounds.Centre, FrameCount),
            { CameraList: { } list } => CameraMotion.Along(CameraPath.Read(list, scene.Scene.Handedness), view, FrameCount),
            { Images.ZoomLevels: > 0 and var levels } => CameraMotion.Zoom(prepare(), view, levels, FrameCount),
            _ => CameraMotion.Still(view),
        };
    }
}
