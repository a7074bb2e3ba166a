namespace FractalEngine.Render;

/// <summary>How often something was done, and how often it would have changed nothing.</summary>
/// <param name="Made">Done.</param>
/// <param name="Skipped">Not needed, and not done.</param>
public readonly record struct ChangeCounts(long Made, long Skipped)
{
    /// <summary>What came to pass between two counts.</summary>
    public static ChangeCounts operator -(ChangeCounts now, ChangeCounts before) => new(now.Made - before.Made, now.Skipped - before.Skipped);
}
