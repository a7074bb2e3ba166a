using FractalEngine.Core.Detail;

namespace FractalEngine.Render;

/// <summary>
/// How pictures are drawn while the camera moves: without multisampling, with at most 150,000 instances, and with parts as coarse as it takes to draw ten pictures a second, from 3 to
/// 24 pixels. When the camera stands, the full picture follows.
/// </summary>
/// <remarks>Draw with <see cref="Adapt(RenderSettings)"/>, then tell <see cref="Measure"/> how long that took. Changes at most every fourth picture, since each makes useless what was chosen ahead.</remarks>
public sealed class MovingDetail
{
    private const double LeastPixelSize = 3;
    private const double MostPixelSize = 24;
    private const int Instances = 150_000;

    // Between the two nothing changes.
    private static readonly TimeSpan TooLong = TimeSpan.FromSeconds(0.09);
    private static readonly TimeSpan Short = TimeSpan.FromSeconds(0.05);

    // Each change makes what was chosen ahead useless.
    private const int PicturesBetweenChanges = 4;
    private const double Coarser = 1.4;
    private const double Finer = 1.15;

    private double _pixelSize = LeastPixelSize;
    private int _pictures;
    private (RenderSettings Source, double PixelSize, RenderSettings Adapted)? _last;

    /// <summary>The settings for pictures of a moving camera.</summary>
    /// <param name="settings">Those for a camera that stands.</param>
    /// <returns>The same object as long as nothing has changed.</returns>
    public RenderSettings Adapt(RenderSettings settings)
    {
        if (_last is not { } last || last.Source != settings || last.PixelSize != _pixelSize)
        {
            _last = (settings, _pixelSize, settings with { Samples = 0, Detail = settings.Detail is { } detail ? Adapt(detail) : null });
        }

        return _last.Value.Adapted;
    }

    /// <summary>Tells how long a picture took from the first step to the window: above 90 ms parts get coarser, below 50 ms finer.</summary>
    public void Measure(TimeSpan time)
    {
        if (++_pictures < PicturesBetweenChanges)
        {
            return;
        }

        var before = _pixelSize;
        _pixelSize = time > TooLong ? Math.Min(Coarser * _pixelSize, MostPixelSize) : time < Short ? Math.Max(_pixelSize / Finer, LeastPixelSize) : _pixelSize;
        _pictures = before.Equals(_pixelSize) ? _pictures : 0;
    }

    private DetailSettings Adapt(DetailSettings detail) => detail with
    {
        PixelSize = Math.Max(detail.PixelSize, _pixelSize),
        InstanceBudget = Math.Min(detail.InstanceBudget, Instances),
    };
}
