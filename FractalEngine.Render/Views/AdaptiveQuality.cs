using FractalEngine.Core.Visibility.Frames;

namespace FractalEngine.Render.Views;

/// <summary>
/// Adapts render settings to a moving camera: no multisampling, at most 150,000 instances, kept shadow maps, and
/// larger pixels and coarser detail while frames are slow.
/// </summary>
/// <remarks>
/// Where frames take more than 50 ms, squares of up to 3 × 3 pixels are drawn as one, if that is allowed. The minimum projected size stays
/// between 3 and 24 of what is drawn as a pixel, 8 with shadows, and follows the frame time so that ten frames a second are drawn. Both
/// change at most every fourth frame, since each change discards what was culled ahead. Draw with
/// <see cref="Adapt(RenderSettings, bool)"/> and pass the time taken to <see cref="RecordFrameTime"/>. When the camera stops, draw once
/// more with the full settings.
/// </remarks>
public sealed class AdaptiveQuality
{
    // Limits of the minimum projected size, pixels.
    private const double FinestProjectedSize = 3;
    private const double CoarsestProjectedSize = 24;

    // Shadow maps have their own, finer detail. Larger proxies lie so far below what maps show, as tiles of a mountain do, that their
    // surface is full of stripes and dots of shadow.
    private const double CoarsestShadedSize = 8;
    private const int MaxInstances = 150_000;

    // Frame times between the two leave the size as it is.
    private static readonly TimeSpan SlowFrameTime = TimeSpan.FromSeconds(0.09);
    private static readonly TimeSpan FastFrameTime = TimeSpan.FromSeconds(0.05);

    // A quarter of the pixels takes no less than a quarter of the time: with four times as many, frames stay below the limit.
    private static readonly TimeSpan FastEnlargedTime = 0.25 * FastFrameTime;
    private const int MaxPixelFactor = 3;

    // Each change discards what was culled ahead.
    private const int FramesBetweenChanges = 4;
    private const double CoarseningFactor = 1.4;
    private const double RefinementFactor = 1.15;

    private double _minProjectedSize = FinestProjectedSize;
    private double _coarsestSize = CoarsestProjectedSize;
    private int _framesSinceChange;
    private int _pixelFactor = 1;
    private bool _mayEnlarge;
    private (RenderSettings Source, double MinProjectedSize, int PixelSize, RenderSettings Adapted)? _lastAdapted;

    /// <summary>Returns the settings for frames of a moving camera.</summary>
    /// <param name="settings">Settings of a camera at rest.</param>
    /// <param name="mayEnlarge">Whether slow frames may have larger pixels.</param>
    /// <returns>The same object for as long as nothing has changed.</returns>
    public RenderSettings Adapt(RenderSettings settings, bool mayEnlarge = false)
    {
        ArgumentNullException.ThrowIfNull(settings);
        _mayEnlarge = mayEnlarge;
        var pixelSize = mayEnlarge ? _pixelFactor * settings.PixelSize : settings.PixelSize;
        var hasShadows = settings is { Shadows: true, Shading: Shading.PerPixel, Wireframe: false };
        _coarsestSize = hasShadows ? CoarsestShadedSize : CoarsestProjectedSize;
        _minProjectedSize = Math.Min(_minProjectedSize, _coarsestSize);
        if (_lastAdapted is not { } last || last.Source != settings
            || (last.MinProjectedSize, last.PixelSize) != (_minProjectedSize, pixelSize))
        {
            var culling = settings.Culling is null ? null : Adapt(settings.Culling);
            var adapted = settings with { Samples = 0, PixelSize = pixelSize, FitShadowsToView = false, Culling = culling };
            last = (settings, _minProjectedSize, pixelSize, adapted);
            _lastAdapted = last;
        }

        return last.Adapted;
    }

    /// <summary>
    /// Adjusts pixels and detail to the time that a frame took: above 50 ms, pixels become larger where they may; above 90 ms, detail gets
    /// coarser, and below 50 ms finer.
    /// </summary>
    /// <param name="frameTime">Time from the first step of drawing until the window showed the frame.</param>
    public void RecordFrameTime(TimeSpan frameTime)
    {
        if (++_framesSinceChange < FramesBetweenChanges)
        {
            return;
        }

        var previous = (_minProjectedSize, _pixelFactor);
        if (_mayEnlarge && _pixelFactor < MaxPixelFactor && frameTime > FastFrameTime)
        {
            _pixelFactor++;
        }
        else if (frameTime > SlowFrameTime)
        {
            _minProjectedSize = Math.Min(CoarseningFactor * _minProjectedSize, _coarsestSize);
        }
        else if (frameTime < FastFrameTime)
        {
            // Larger pixels go last.
            var isLast = _mayEnlarge && _minProjectedSize.Equals(FinestProjectedSize) && frameTime < FastEnlargedTime;
            _pixelFactor = isLast ? Math.Max(1, _pixelFactor - 1) : _pixelFactor;
            _minProjectedSize = Math.Max(_minProjectedSize / RefinementFactor, FinestProjectedSize);
        }

        if (previous != (_minProjectedSize, _pixelFactor))
        {
            _framesSinceChange = 0;
        }
    }

    /// <summary>Returns settings with pixels as small as a frame can have in time, if its time follows the number of its pixels.</summary>
    /// <param name="settings">Settings of a coarse frame.</param>
    /// <param name="smallest">Side of the smallest square that is drawn as one pixel.</param>
    /// <param name="frameTime">Time that the coarse frame takes.</param>
    /// <param name="maxTime">Time that a finer one may take.</param>
    public static RenderSettings Refine(RenderSettings settings, int smallest, TimeSpan frameTime, TimeSpan maxTime)
    {
        ArgumentNullException.ThrowIfNull(settings);
        var size = settings.PixelSize;
        while (size > smallest && Math.Pow((double)settings.PixelSize / (size - 1), 2) * frameTime <= maxTime)
        {
            size--;
        }

        return settings with { PixelSize = size };
    }

    private CullingSettings Adapt(CullingSettings culling) => culling with
    {
        MinProjectedSize = Math.Max(culling.MinProjectedSize, _minProjectedSize),
        InstanceBudget = Math.Min(culling.InstanceBudget, MaxInstances),
    };
}
