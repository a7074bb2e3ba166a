using FractalEngine.App.Jobs;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core.Images.Animations;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Animation;

/// <summary>What an animation shows and where it goes.</summary>
/// <param name="Images">What each frame draws.</param>
/// <param name="Output">Path of the animation.</param>
/// <param name="FrameCount">Number of frames; null for those of the film, or for a default.</param>
/// <param name="FramesPerSecond">Frames a second.</param>
/// <param name="IsTurntable">Whether the camera turns once around the scene.</param>
/// <param name="CameraList">Path of a list of cameras; null for none.</param>
/// <param name="IsSimulated">Whether the physics objects move.</param>
internal sealed record AnimationJob(
    RenderJob Images, string Output, int? FrameCount, double FramesPerSecond, bool IsTurntable, string? CameraList, bool IsSimulated)
{
    /// <summary>Largest number of frames.</summary>
    public const int MaxFrameCount = 100_000;

    /// <summary>Number of frames of what is no film.</summary>
    public const int DefaultFrameCount = 60;

    // Images whose mean is a frame, where --gather does not say.
    private const int ShutterParts = 16;

    // A GIF counts the time of a frame in hundredths of a second.
    private const double MaxFramesPerSecondOfGif = 100;

    /// <summary>How the frames are traced; null where they are drawn.</summary>
    public TracedImage? Trace { get; init; }

    /// <summary>The part of a frame's time in which the shutter is open, from 0 to 1.</summary>
    public double Shutter { get; init; }

    /// <summary>The first and the last frame to make of all, from 1; null for all of them.</summary>
    public (int First, int Last)? Only { get; init; }

    /// <summary>Whether frames stay that are there.</summary>
    public bool IsResumed { get; init; }

    /// <summary>Number of images whose mean is a frame, at even times while the shutter is open.</summary>
    public int PartCount { get; private init; } = 1;

    /// <summary>Whether the camera turns, zooms or follows a list, whatever the film has for it.</summary>
    private bool HasMotion => IsTurntable || CameraList is not null || Images.ZoomLevels > 0;

    /// <summary>Requires at most one motion of the camera, and what the format of the output can hold.</summary>
    /// <exception cref="UsageException">The motions contradict each other, or the format can't hold the frames.</exception>
    public void Check()
    {
        var motions = new[] { IsTurntable, CameraList is not null, Images.ZoomLevels > 0 }.Count(static asked => asked);
        UsageException.ThrowIf(motions > 1, "--turntable, --zoom and --path exclude each other");
        CheckFormat(Output, FramesPerSecond, Images.Background.IsTransparent);
        UsageException.ThrowIf(
            (Only is not null || IsResumed) && !AnimationOutput.HasNoTimes(Output),
            "--only and --resume need numbered images: expected --output to end in .png, .exr or .hdr");
    }

    /// <summary>Returns the same animation of a scene, with its number of frames, and of the parts that a shutter makes of each.</summary>
    /// <exception cref="UsageException">Nothing moves, or the film is too long or at odds with a zoom.</exception>
    public AnimationJob For(LoadedScene scene)
    {
        var film = scene.Scene.Film;
        UsageException.ThrowIf(
            film is null && !HasMotion && !IsSimulated,
            "nothing moves: expected --turntable, --zoom LEVELS, --path CAMERAS.txt, --simulate, or a scene with a film");
        UsageException.ThrowIf(
            film is { HasNumbers: true } && Images.ZoomLevels > 0, "--zoom flies into a fractal as it stays, and the film changes numbers");
        var filmFrames = film is null ? DefaultFrameCount : Math.Max(1, Math.Round((film.Duration - Images.Time) * FramesPerSecond));
        UsageException.ThrowIf(
            FrameCount is null && filmFrames > MaxFrameCount,
            $"the film has more than the limit of {MaxFrameCount} frames: expected a smaller --fps, or --frames");
        var counted = this with { FrameCount = FrameCount ?? (int)filmFrames };
        UsageException.ThrowIf(
            Only?.Last > counted.FrameCount,
            FormattableString.Invariant($"--only {Only?.First}..{Only?.Last}: there are {counted.FrameCount} frames"));
        if (!(Shutter > 0))
        {
            return counted;
        }

        var parts = Images.Settings.GatheredFrames > 1 ? Images.Settings.GatheredFrames : ShutterParts;
        return counted with
        {
            PartCount = parts,
            Trace = Trace is { } trace ? trace with { Samples = ((trace.Samples - 1) / parts) + 1 } : null,
            Images = Images with { Settings = Images.Settings with { GatheredFrames = 1 } },
        };
    }

    /// <summary>Creates the output for the ending of its name.</summary>
    /// <exception cref="IOException">It needs a program that is not installed.</exception>
    /// <exception cref="UsageException">No format has its ending.</exception>
    public AnimationOutput CreateOutput() => AnimationOutput.Create(
        Output, Only?.Last ?? FrameCount!.Value, FramesPerSecond, Only?.First ?? 1)
        ?? throw new UsageException($"--output '{Output}' must end in {AnimationOutput.Endings}");

    /// <summary>Requires the format of an output to be able to hold the frames.</summary>
    /// <exception cref="UsageException">It can't.</exception>
    public static void CheckFormat(string path, double framesPerSecond, bool isTransparent)
    {
        var ending = Path.GetExtension(path).ToLowerInvariant();
        if (ending is ".gif" && framesPerSecond > MaxFramesPerSecondOfGif)
        {
            var rates = FormattableString.Invariant($"{MaxFramesPerSecondOfGif} frames a second, not {framesPerSecond}");
            throw new UsageException($"a .gif has at most {rates}: expected a smaller --fps, or .apng");
        }

        if (isTransparent && ending is (".mp4" or ".webm" or ".gif"))
        {
            throw new UsageException($"a video has no transparent background: expected --output to end in .png or .apng, not {ending}");
        }
    }

    /// <summary>Returns the time of a frame in the physics and in the film, in seconds.</summary>
    /// <param name="frame">Index of the frame, from 0; with a fraction for a time between two.</param>
    public double TimeOf(double frame) => Images.Time + (frame / FramesPerSecond);

    /// <summary>Creates the motion of the camera: the view of each frame. Frames of a zoom must be asked for in order.</summary>
    /// <param name="scene">The scene as it is at first, with a film's camera.</param>
    /// <param name="prepare">Prepares the scene for drawing, which only a zoom needs.</param>
    /// <param name="view">The view of a still image.</param>
    /// <param name="isQuiet">Whether nothing is told while that takes long.</param>
    /// <exception cref="UsageException">The scene or a list does not fit the motion.</exception>
    public Func<double, View> CreateMotion(LoadedScene scene, Func<DrawableScene> prepare, View view, bool isQuiet)
    {
        // The way into a fractal is measured first, which takes long for hundreds of levels.
        using var notice = new SlowWorkNotice("finding the camera's way", isQuiet);
        var count = FrameCount!.Value;
        var last = Math.Max(1, count - 1);
        if (IsTurntable)
        {
            // So that the last frame leads on to the first.
            var pivot = scene.Bounds.Centre;
            return frame => view with { Camera = CameraNavigation.Orbit(view.Camera, pivot, 2 * Math.PI * frame / count, 0) };
        }

        if (CameraList is { } list)
        {
            var path = CameraText.ReadPath(list, scene.Scene.Handedness);
            return frame => view with { Camera = path.At(path.Duration * (frame / last)) };
        }

        if (Images.ZoomLevels > 0)
        {
            var (zoom, steps) = Images.PlanZoom(prepare(), view);
            return frame => zoom.FlyTo(steps * frame / last);
        }

        return scene.Scene.Film?.Cameras.Any() == true ? frame => Images.CreateFilmView(scene, TimeOf(frame)) : _ => view;
    }
}
