using FractalEngine.Core.Images;
using FractalEngine.Render;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>One measurement of a scene.</summary>
/// <param name="StartMilliseconds">Loading, preparing, and the first picture: milliseconds.</param>
/// <param name="MovingMilliseconds">A picture from another place than the one before: milliseconds.</param>
/// <param name="StillMilliseconds">A picture like the one before: milliseconds.</param>
/// <param name="AllocatedBytes">Allocated until the first picture.</param>
/// <param name="StillStatistics">What the last picture took.</param>
/// <param name="StillImage">The last picture.</param>
internal sealed record OptimisationSample(double StartMilliseconds, double MovingMilliseconds, double StillMilliseconds,
    long AllocatedBytes, FrameStatistics StillStatistics,
    PixelImage StillImage)
{
    /// <summary>The better of two measurements, value by value.</summary>
    public OptimisationSample BestWith(OptimisationSample? other) => other is null ? this : this with
    {
        StartMilliseconds = Math.Min(StartMilliseconds, other.StartMilliseconds),
        MovingMilliseconds = Math.Min(MovingMilliseconds, other.MovingMilliseconds),
        StillMilliseconds = Math.Min(StillMilliseconds, other.StillMilliseconds),
        AllocatedBytes = Math.Min(AllocatedBytes, other.AllocatedBytes),
    };
}
