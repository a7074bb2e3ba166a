using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Render;

namespace FractalEngine.App.Window;

/// <summary>
/// Draws what a window shows. While the camera moves, pictures are coarser and one behind: the instances of the next are chosen while one
/// is drawn. When it stands, the full picture follows.
/// </summary>
/// <param name="frame">Of the window.</param>
internal sealed class WindowRenderer(FrameRenderer frame)
{
    private readonly AdaptiveQuality _adaptiveQuality = new();
    private long _drawnCount;
    private long _presentedAgainCount;
    private View? _nextView;
    private View? _shownView;

    /// <summary>The camera's view when the last picture was drawn; null before the first of a document.</summary>
    public View? LatestView { get; private set; }

    /// <summary>True where the last picture was drawn for a moving camera.</summary>
    public bool IsReducedQuality { get; private set; }

    /// <summary>Counts a picture that was shown again, below another text.</summary>
    public void CountPresentedAgain() => _presentedAgainCount++;

    /// <summary>Pictures drawn so far, shown again without drawing, and neither.</summary>
    /// <param name="frameCount">How many there would be if each were drawn.</param>
    public (long Drawn, long ShownAgain, long NotNeeded) CountFrames(long frameCount) =>
        (_drawnCount, _presentedAgainCount, Math.Max(0, frameCount - _drawnCount - _presentedAgainCount));

    /// <summary>Forgets the views of a document that is no longer shown.</summary>
    public void Reset() => (_nextView, _shownView, LatestView) = (null, null, null);

    /// <summary>Draws a picture.</summary>
    /// <param name="document">Null while there is none.</param>
    /// <param name="settings">Of pictures that stand.</param>
    /// <param name="width">Pixels.</param>
    /// <param name="height">Pixels.</param>
    /// <returns>How it was drawn.</returns>
    public RenderSettings Draw(Document? document, RenderSettings settings, int width, int height)
    {
        _drawnCount++;
        IsReducedQuality = document?.IsMoving == true;
        if (document is null)
        {
            frame.Draw(null, new(Camera.Default, Projection.Perspective), width, height, settings);
            return settings;
        }

        var view = document.UpdateView((double)width / height);
        LatestView = view;
        if (!IsReducedQuality)
        {
            (_shownView, _nextView) = (view, null);
            frame.Draw(document.Renderer, view, width, height, settings);
            return settings;
        }

        var adapted = _adaptiveQuality.Adapt(settings);
        // The paper's way moves the fractal with the camera: there the picture is that of the camera's place.
        (_shownView, _nextView) = document.IsTrailEnabled ? (view, null) : (_nextView ?? view, view);
        frame.Draw(document.Renderer, _shownView, width, height, adapted, _nextView);
        return adapted;
    }

    /// <summary>Tells how long it took to draw and show a picture, so that the next ones keep up with a moving camera.</summary>
    public void RecordFrameTime(TimeSpan frameTime)
    {
        if (IsReducedQuality)
        {
            _adaptiveQuality.RecordFrameTime(frameTime);
        }
    }

    /// <summary>
    /// The scene alone in full detail: as the window shows it while the camera moves, else as the camera is now. What the window shows must
    /// be drawn again.
    /// </summary>
    /// <param name="document">Loaded.</param>
    /// <param name="settings">Of pictures that stand.</param>
    /// <param name="width">Pixels.</param>
    /// <param name="height">Pixels.</param>
    public PixelImage Capture(Document document, RenderSettings settings, int width, int height)
    {
        var view = document.IsMoving && _shownView is { } shownView ? shownView : document.UpdateView((double)width / height);
        frame.Draw(document.Renderer, view, width, height, settings);
        return frame.Capture();
    }
}
