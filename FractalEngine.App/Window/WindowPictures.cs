using FractalEngine.Core.Scenes;
using FractalEngine.Render;
using FractalEngine.Render.Pictures;

namespace FractalEngine.App.Window;

/// <summary>
/// Draws what a window shows. While the camera moves, pictures are coarser and one behind: the instances of the next are chosen while one is drawn. When it
/// stands, the full picture follows.
/// </summary>
/// <param name="frame">Of the window.</param>
internal sealed class WindowPictures(FrameRenderer frame)
{
    private readonly MovingDetail _moving = new();
    private long _drawn;
    private long _shownAgain;
    private View? _next;
    private View? _shown;

    /// <summary>The camera's view when the last picture was drawn; null before the first of a document.</summary>
    public View? Latest { get; private set; }

    /// <summary>True where the last picture was drawn for a moving camera.</summary>
    public bool IsCoarse { get; private set; }

    /// <summary>Counts a picture that was shown again, below another text.</summary>
    public void ShowAgain() => _shownAgain++;

    /// <summary>Pictures drawn so far, shown again without drawing, and neither.</summary>
    /// <param name="all">How many there would be if each were drawn.</param>
    public (long Drawn, long ShownAgain, long NotNeeded) CountsOf(long all) => (_drawn, _shownAgain, Math.Max(0, all - _drawn - _shownAgain));

    /// <summary>Forgets the views of a document that is no longer shown.</summary>
    public void Reset() => (_next, _shown, Latest) = (null, null, null);

    /// <summary>Draws a picture.</summary>
    /// <param name="document">Null while there is none.</param>
    /// <param name="settings">Of pictures that stand.</param>
    /// <param name="width">Pixels.</param>
    /// <param name="height">Pixels.</param>
    /// <returns>How it was drawn.</returns>
    public RenderSettings Draw(Document? document, RenderSettings settings, int width, int height)
    {
        _drawn++;
        IsCoarse = document?.IsMoving == true;
        if (document is null)
        {
            frame.Draw(null, new(Camera.Default, Projection.Perspective), width, height, settings);
            return settings;
        }

        var view = document.ViewNow((double)width / height);
        Latest = view;
        if (!IsCoarse)
        {
            (_shown, _next) = (view, null);
            frame.Draw(document.Renderer, view, width, height, settings);
            return settings;
        }

        var coarse = _moving.Adapt(settings);
        // The paper's way moves the fractal with the camera: there the picture is that of the camera's place.
        (_shown, _next) = document.UsesTrail ? (view, null) : (_next ?? view, view);
        frame.Draw(document.Renderer, _shown, width, height, coarse, _next);
        return coarse;
    }

    /// <summary>Tells how long it took to draw and show a picture, so that the next ones keep up with a moving camera.</summary>
    public void Measure(TimeSpan time)
    {
        if (IsCoarse)
        {
            _moving.Measure(time);
        }
    }

    /// <summary>The scene alone in full detail: as the window shows it while the camera moves, else as the camera is now. What the window shows must be drawn again.</summary>
    /// <param name="document">Loaded.</param>
    /// <param name="settings">Of pictures that stand.</param>
    /// <param name="width">Pixels.</param>
    /// <param name="height">Pixels.</param>
    public PixelImage Capture(Document document, RenderSettings settings, int width, int height)
    {
        var view = document.IsMoving && _shown is { } shown ? shown : document.ViewNow((double)width / height);
        frame.Draw(document.Renderer, view, width, height, settings);
        return frame.Capture();
    }
}
