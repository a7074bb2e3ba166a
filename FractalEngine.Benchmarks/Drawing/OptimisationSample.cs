using FractalEngine.Core.Images;
using FractalEngine.Render;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>One measurement of a scene. Times are in milliseconds.</summary>
/// <param name="StartMilliseconds">Time of loading, preparing and drawing the first frame.</param>
/// <param name="MovingMilliseconds">Time of a frame whose camera has moved since the frame before.</param>
/// <param name="StillMilliseconds">Time of a frame like the one before.</param>
/// <param name="AllocatedBytes">Bytes allocated until the first frame was drawn.</param>
/// <param name="StillStatistics">Statistics of the last frame.</param>
/// <param name="StillImage">Image of the last frame.</param>
internal sealed record OptimisationSample(
    double StartMilliseconds, double MovingMilliseconds, double StillMilliseconds, long AllocatedBytes, FrameStatistics StillStatistics,
    PixelImage StillImage)
{
    /// <summary>Returns the better of two measurements, value by value.</summary>
    public OptimisationSample BestWith(OptimisationSample? other) => other is null ? this : this with
    {
        StartMilliseconds = Math.Min(StartMilliseconds, other.StartMilliseconds),
        MovingMilliseconds = Math.Min(MovingMilliseconds, other.MovingMilliseconds),
        StillMilliseconds = Math.Min(StillMilliseconds, other.StillMilliseconds),
        AllocatedBytes = Math.Min(AllocatedBytes, other.AllocatedBytes),
    };
}
