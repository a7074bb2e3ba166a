using FractalEngine.Core.Images;
using FractalEngine.Render;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>One measurement of a scene.</summary>
/// <param name="Start">Loading, preparing, and the first picture: milliseconds.</param>
/// <param name="MovingTime">A picture from another place than the one before: milliseconds.</param>
/// <param name="StandingTime">A picture like the one before: milliseconds.</param>
/// <param name="Bytes">Allocated until the first picture.</param>
/// <param name="Standing">What the last picture took.</param>
/// <param name="Picture">The last picture.</param>
internal sealed record SkipSample(double Start, double MovingTime, double StandingTime, long Bytes, FrameStatistics Standing,
    PixelImage Picture)
{
    /// <summary>The better of two measurements, value by value.</summary>
    public SkipSample BestWith(SkipSample? other) => other is null ? this : this with
    {
        Start = Math.Min(Start, other.Start),
        MovingTime = Math.Min(MovingTime, other.MovingTime),
        StandingTime = Math.Min(StandingTime, other.StandingTime),
        Bytes = Math.Min(Bytes, other.Bytes),
    };
}
