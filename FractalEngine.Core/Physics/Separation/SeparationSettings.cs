using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Islands;

namespace FractalEngine.Core.Physics.Separation;

/// <summary>How far the bodies of an island are moved apart where they overlap.</summary>
/// <param name="Overlap">Overlap at which a displacement ends, of the smaller radius; negative for a gap.</param>
/// <param name="Relaxation">How much of an overlap is taken back at once, relative to it, since others will push in again.</param>
/// <param name="MaxGap">Gap, relative to the distance at which two touch, beyond which they are not near touching.</param>
internal readonly record struct SeparationSettings(double Overlap, double Relaxation, double MaxGap)
{
    private const double Near = 0.01;

    // Where something pushes bodies together, all of a row come to touch at once.
    private const double PushedNear = 0.25;

    /// <summary>
    /// Aims at a small overlap; and where bodies keep a margin, at a gap, so that they need not be displaced again soon. The more there
    /// are, the more they push one another, and the farther they are moved.
    /// </summary>
    public static SeparationSettings Of(in Island island)
    {
        var maxGap = island.IsPushed ? PushedNear : Near;
        return !island.IsLarge ? new(1e-7, 1.3, maxGap)
            : island.PartCount == 1 ? new(-0.3 * ContactTolerances.HeapMargin, 1.3, maxGap)
            : new(-0.6 * ContactTolerances.HeapMargin, 1.6, maxGap);
    }
}
