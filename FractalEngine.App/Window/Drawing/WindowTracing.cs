using FractalEngine.App.Jobs;
using FractalEngine.App.Window.State;
using FractalEngine.Core.Images;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Drawing;

/// <summary>Shows a document traced whenever its view stands still, unless that is switched off.</summary>
/// <param name="options">The options of the window.</param>
/// <param name="published">Called on another thread when there is something new to show.</param>
internal sealed class WindowTracing(WindowOptions options, Action published) : IDisposable
{
    private readonly ProgressiveTrace _trace =
        new(options.TraceSampleCount, options.Settings, published) { Denoises = options.DenoisesTrace };

    private string? _obstacle;

    public bool IsEnabled { get; set; }

    /// <summary>The image to show over the frame; null for none.</summary>
    public ImageLayer? Layer => _trace.Layer;

    /// <summary>The traced image, once nothing of the frame below it is visible; null before.</summary>
    public PixelImage? OpaqueImage => Layer is { Opacity: >= 1, Image: var image } ? image : null;

    /// <summary>Whether the view is traced while it stands still.</summary>
    public bool IsTracing => IsEnabled && (_obstacle ?? _trace.Problem) is null;

    /// <summary>How far the image is, or why there is none; null where there is nothing to tell.</summary>
    public string? StatusText => !IsEnabled ? null
        : (_obstacle ?? _trace.Problem) is { } obstacle ? $"not traced: {obstacle}"
        : _trace.State == TraceState.Idle ? null
        : FormattableString.Invariant($"traced {_trace.SampleCount} of {_trace.MaxSampleCount}");

    /// <summary>Switches tracing on or off.</summary>
    /// <returns>A message for the user.</returns>
    public string Toggle()
    {
        IsEnabled = !IsEnabled;
        return IsEnabled ? "traced while the view stands still" : "drawn, not traced";
    }

    /// <summary>Traces the present view of a document, or ends the trace of an earlier one. Called before each frame is drawn.</summary>
    /// <param name="document">The document shown, or null.</param>
    /// <param name="settings">The present render settings.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    /// <param name="isStill">Whether the view stands still; else others are likely to follow at once.</param>
    public void Update(Document? document, RenderSettings settings, int width, int height, bool isStill)
    {
        _obstacle = null;
        TraceRequest? request = null;
        if (IsEnabled && document is not null)
        {
            _obstacle = (long)width * height > TracedImage.MaxPixelsOf(options.DenoisesTrace)
                ? "too many pixels"
                : FindObstacle(document, settings);
            if (_obstacle is null && isStill)
            {
                request = new(document.LitScene, document.UpdateView((double)width / height), width, height);
            }
        }

        if (IsEnabled && document is not null)
        {
            _trace.Show(request);
        }
        else
        {
            _trace.Release();
        }
    }

    /// <summary>Returns whether there is something new to show since the last call.</summary>
    public bool TakeUpdate() => _trace.TakeUpdate();

    public void Dispose() => _trace.Dispose();

    /// <summary>Names what a traced image of the document would not show; null for nothing.</summary>
    private static string? FindObstacle(Document document, RenderSettings settings) =>
        document.Physics.IsRunning ? "bodies move"
        : document.IsTrailEnabled ? "the paper's zoom"
        : settings.Wireframe ? "wireframe"
        : settings.Shading != Shading.PerPixel ? "light at the vertices"
        : !settings.Shadows ? "no shadows"
        : !settings.AmbientOcclusion ? "no ambient occlusion"
        : settings.Grid || settings.Axes ? "grid"
        : document.Physics.ShowsClosestPoints ? "closest points"
        : document.Tool.HasLines ? "outlines of a selection"
        : null;
}
