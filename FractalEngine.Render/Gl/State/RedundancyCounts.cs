namespace FractalEngine.Render.Gl.State;

/// <summary>Counts how often an operation was performed, and how often it was skipped since it would have changed nothing.</summary>
/// <param name="Performed">Number of operations that were performed.</param>
/// <param name="Skipped">Number of operations that were redundant and skipped.</param>
public readonly record struct RedundancyCounts(long Performed, long Skipped)
{
    /// <summary>Returns the counts between two moments.</summary>
    public static RedundancyCounts operator -(RedundancyCounts later, RedundancyCounts earlier) =>
        new(later.Performed - earlier.Performed, later.Skipped - earlier.Skipped);
}
