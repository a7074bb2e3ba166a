namespace FractalEngine.Render;

/// <summary>How often something was done, and how often it would have changed nothing.</summary>
/// <param name="Performed">Done.</param>
/// <param name="Skipped">Not needed, and not done.</param>
public readonly record struct RedundancyCounts(long Performed, long Skipped)
{
    /// <summary>What came to pass between two counts.</summary>
    public static RedundancyCounts operator -(RedundancyCounts now, RedundancyCounts before) =>
        new(now.Performed - before.Performed, now.Skipped - before.Skipped);
}
