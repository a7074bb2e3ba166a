using System.Diagnostics;
using System.Numerics;
using FractalEngine.App.Window.State;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Text;
using FractalEngine.Render;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Ui;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Drawing;

/// <summary>
/// Draws the frames of a window. While the camera moves, frames are coarser and one view behind, so that the instances of the next frame
/// are culled while one is drawn. When it stops, a full frame follows. Where full frames are slow, those that follow each other at once,
/// as while the mouse turns the camera, are coarser, too. Where they are slower than a window may answer, all that follow the user's input
/// are: first with larger pixels, then with as small ones as fit into that time, and the full one after a rest. The first frame of a scene
/// is a preview: one sample a pixel, coarse detail and no shadows, since full frames of large scenes take seconds without a GPU.
/// </summary>
internal sealed class WindowRenderer(FrameRenderer frame)
{
    // A window answers within this time while it gathers frames; behind a lens, where one of them alone is no image, within the other.
    private static readonly TimeSpan MaxGatherTime = TimeSpan.FromSeconds(0.25);
    private static readonly TimeSpan MaxLensTime = TimeSpan.FromSeconds(1.5);

    // Where a full frame takes longer, one that follows another one at once is coarser.
    private static readonly TimeSpan SlowFrameTime = TimeSpan.FromSeconds(0.05);

    // A frame that takes longer never follows the user's input at once. The finer frame before it takes no longer than this.
    private static readonly TimeSpan MaxAnswerTime = TimeSpan.FromSeconds(0.25);

    // A window does not answer while it draws a full frame, so a slow one waits longer until it is likely that nothing follows.
    private static readonly TimeSpan MinRestTime = TimeSpan.FromSeconds(0.15);
    private static readonly TimeSpan MaxRestTime = TimeSpan.FromSeconds(0.6);

    private readonly AdaptiveQuality _adaptiveQuality = new();
    private long _drawnCount;
    private long _presentedAgainCount;
    private View? _nextView;
    private View? _shownView;
    private TimeSpan _gatherTime;
    private TimeSpan _fullFrameTime;
    private TimeSpan _coarseFrameTime;
    private long _lastFrame;
    private long _lastInput;
    private bool _isBetweenOthers;
    private bool _isRefined;

    /// <summary>The camera's view at the time of the last frame; null before the first frame of a document.</summary>
    public View? LatestView { get; private set; }

    /// <summary>
    /// True when the last frame was a preview, or drawn for a moving camera or between others, so that a full one must follow.
    /// </summary>
    public bool IsReducedQuality { get; private set; }

    /// <summary>Whether a frame that is drawn now follows another one and the user's input so soon that a full one would be late.</summary>
    public bool FollowsAtOnce => _shownView is not null && _fullFrameTime > SlowFrameTime && (_fullFrameTime > MaxAnswerTime
        ? Stopwatch.GetElapsedTime(_lastInput) < RestTime
        : (!IsReducedQuality || _isBetweenOthers) && Stopwatch.GetElapsedTime(Math.Min(_lastFrame, _lastInput)) < RestTime);

    /// <summary>How long the next finer frame waits for another coarse one: the user may go on turning the camera.</summary>
    public TimeSpan TimeToFinerFrame =>
        _isBetweenOthers ? (_isRefined ? RestTime : MinRestTime) - Stopwatch.GetElapsedTime(_lastFrame) : TimeSpan.Zero;

    /// <summary>Whether another frame would sharpen the one that is shown, in time.</summary>
    /// <param name="settings">The render settings for a camera at rest.</param>
    public bool CanGather(RenderSettings settings) =>
        !IsReducedQuality && _shownView is { } view && frame.GatheredCount < FrameRenderer.FrameCountOf(view, settings)
        && _gatherTime < (view.HasLens ? MaxLensTime : MaxGatherTime);

    /// <summary>Draws the last frame again, moved by a part of a pixel, for a mean of all.</summary>
    /// <param name="document">The document of the last frame, unchanged since.</param>
    /// <param name="settings">Its settings.</param>
    /// <returns>Whether enough was added to show it: at each doubling, and at the end.</returns>
    public bool Gather(Document document, RenderSettings settings)
    {
        var start = Stopwatch.GetTimestamp();
        try
        {
            frame.Gather(document.Renderer, _shownView!, settings);
        }
        catch (GlException) when (frame.GatheredCount == 1)
        {
            // There is no memory for a mean: the single frame stays, and nothing that is open is lost.
            _gatherTime = TimeSpan.MaxValue;
            return false;
        }

        frame.Finish();
        _gatherTime = Stopwatch.GetElapsedTime(start);
        return BitOperations.IsPow2(frame.GatheredCount) || !CanGather(settings);
    }

    /// <summary>Notes that the user has changed what is shown.</summary>
    public void RecordInput() => _lastInput = Stopwatch.GetTimestamp();

    /// <summary>Counts a frame that is presented again, below a new overlay.</summary>
    public void CountPresentedAgain() => _presentedAgainCount++;

    /// <summary>Counts the frames so far.</summary>
    /// <param name="frameCount">Number of frames that a loop of 60 frames a second would have drawn.</param>
    public FrameCounts CountFrames(long frameCount) =>
        new(_drawnCount, _presentedAgainCount, Math.Max(0, frameCount - _drawnCount - _presentedAgainCount));

    /// <summary>Discards the views of a document that is no longer shown.</summary>
    public void Reset()
    {
        _nextView = null;
        _shownView = null;
        LatestView = null;
    }

    /// <summary>Draws one frame of the document.</summary>
    /// <param name="document">The document to draw; null for the background alone.</param>
    /// <param name="settings">The render settings for a camera at rest.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    /// <returns>The settings that were used.</returns>
    public RenderSettings Draw(Document? document, RenderSettings settings, int width, int height)
    {
        _drawnCount++;
        _gatherTime = TimeSpan.Zero;
        var isMoving = document?.IsMoving == true;
        _isBetweenOthers = !isMoving && FollowsAtOnce;
        _isRefined = _isBetweenOthers && Stopwatch.GetElapsedTime(_lastInput) >= MinRestTime;
        IsReducedQuality = isMoving || _isBetweenOthers;
        if (document is null)
        {
            frame.Draw(null, new(Camera.Default, Projection.Perspective), width, height, settings);
            return settings;
        }

        var view = document.UpdateView((double)width / height);
        LatestView = view;
        if (_shownView is null && document is { IsReload: false, File.Kind: FileKind.Scene })
        {
            IsReducedQuality = true;
            _fullFrameTime = TimeSpan.Zero;
            _shownView = view;
            _nextView = view;
            var preview = _adaptiveQuality.Adapt(settings) with { Shadows = false };
            frame.Draw(document.Renderer, view, width, height, preview);
            return preview;
        }

        if (!IsReducedQuality)
        {
            _shownView = view;
            _nextView = null;
            frame.Draw(document.Renderer, view, width, height, settings);
            return settings;
        }

        var adapted = _adaptiveQuality.Adapt(settings, mayEnlarge: !document.IsPlaying);
        if (document.IsTrailEnabled || _isBetweenOthers)
        {
            // The paper's zoom moves the fractal with the camera, so an older view would not fit it, and what the mouse does must be seen.
            _shownView = view;
            _nextView = null;
        }
        else
        {
            _shownView = _nextView ?? view;
            _nextView = view;
        }

        adapted = _isRefined ? AdaptiveQuality.Refine(adapted, settings.PixelSize, _coarseFrameTime, MaxAnswerTime) : adapted;
        frame.Draw(document.Renderer, _shownView, width, height, adapted, _nextView);
        return adapted;
    }

    /// <summary>Reports the time of the last frame, so that the next ones keep up with a moving camera.</summary>
    public void RecordFrameTime(TimeSpan frameTime)
    {
        _lastFrame = Stopwatch.GetTimestamp();
        if (_isRefined)
        {
            return;
        }

        if (IsReducedQuality)
        {
            _coarseFrameTime = frameTime;
            _adaptiveQuality.RecordFrameTime(frameTime);
        }
        else
        {
            _fullFrameTime = frameTime;
        }
    }

    private TimeSpan RestTime => TimeSpan.FromTicks(Math.Clamp(_fullFrameTime.Ticks / 3, MinRestTime.Ticks, MaxRestTime.Ticks));

    /// <summary>Captures the last frame as it is presented.</summary>
    /// <param name="layer">Traced image over the frame; null for none.</param>
    /// <param name="ui">Menus and panels as they were built last.</param>
    /// <param name="overlay">Texts over all of these.</param>
    public PixelImage CaptureWindow(ImageLayer? layer, UserInterface ui, IReadOnlyList<OverlayPanel> overlay) =>
        frame.Capture(layer, ui, overlay);

    /// <summary>
    /// Captures the scene without overlay in full quality, in the middle of the image: the view on the screen while the camera moves, else
    /// the present one.
    /// </summary>
    /// <remarks>Overwrites the frame, so the window must be drawn again.</remarks>
    /// <param name="document">The document to capture.</param>
    /// <param name="settings">The render settings for a camera at rest.</param>
    /// <param name="width">Width of the image in pixels.</param>
    /// <param name="height">Height of the image in pixels.</param>
    public PixelImage Capture(Document document, RenderSettings settings, int width, int height)
    {
        var view = document.IsMoving && _shownView is { } shownView
            ? shownView with { HorizontalShift = 0 }
            : document.UpdateView((double)width / height, isBesidePanels: false);
        frame.Draw(document.Renderer, view, width, height, settings);
        return frame.Capture();
    }
}
