using FractalEngine.Core.Visibility;

namespace FractalEngine.Render;

/// <summary>
/// How pictures are drawn while the camera moves: without multisampling, with at most 150,000 instances, and with parts as coarse as it
/// takes to draw ten pictures a second, from 3 to 24 pixels. When the camera stands, the full picture follows.
/// </summary>
/// <remarks>
/// Draw with <see cref="Adapt(RenderSettings)"/>, then tell <see cref="RecordFrameTime"/> how long that took. Changes at most every fourth
/// picture, since each makes useless what was chosen ahead.
/// </remarks>
public sealed class AdaptiveQuality
{
    private const double FinestProjectedSize = 3;
    private const double CoarsestProjectedSize = 24;
    private const int MaxInstances = 150_000;

    // Between the two nothing changes.
    private static readonly TimeSpan SlowFrameTime = TimeSpan.FromSeconds(0.09);
    private static readonly TimeSpan FastFrameTime = TimeSpan.FromSeconds(0.05);

    // Each change makes what was chosen ahead useless.
    private const int FramesBetweenChanges = 4;
    private const double CoarseningFactor = 1.4;
    private const double RefinementFactor = 1.15;

    private double _minProjectedSize = FinestProjectedSize;
    private int _framesSinceChange;
    private (RenderSettings Source, double PixelSize, RenderSettings Adapted)? _lastAdapted;

    /// <summary>The settings for pictures of a moving camera.</summary>
    /// <param name="settings">Those for a camera that stands.</param>
    /// <returns>The same object as long as nothing has changed.</returns>
    public RenderSettings Adapt(RenderSettings settings)
    {
        if (_lastAdapted is not { } last || last.Source != settings || last.PixelSize != _minProjectedSize)
        {
            _lastAdapted =
                (settings, _minProjectedSize,
                settings with { Samples = 0, Culling = settings.Culling is { } culling ? Adapt(culling) : null });
        }

        return _lastAdapted.Value.Adapted;
    }

    /// <summary>
    /// Tells how long a picture took from the first step to the window: above 90 ms parts get coarser, below 50 ms finer.
    /// </summary>
    public void RecordFrameTime(TimeSpan frameTime)
    {
        if (++_framesSinceChange < FramesBetweenChanges)
        {
            return;
        }

        var previousSize = _minProjectedSize;
        _minProjectedSize = frameTime > SlowFrameTime
            ? Math.Min(CoarseningFactor * _minProjectedSize, CoarsestProjectedSize)
            : frameTime < FastFrameTime ? Math.Max(_minProjectedSize / RefinementFactor, FinestProjectedSize) : _minProjectedSize;
        _framesSinceChange = previousSize.Equals(_minProjectedSize) ? _framesSinceChange : 0;
    }

    private CullingSettings Adapt(CullingSettings culling) => culling with
    {
        MinProjectedSize = Math.Max(culling.MinProjectedSize, _minProjectedSize),
        InstanceBudget = Math.Min(culling.InstanceBudget, MaxInstances),
    };
}
