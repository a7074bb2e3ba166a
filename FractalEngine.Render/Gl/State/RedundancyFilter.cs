namespace FractalEngine.Render.Gl.State;

/// <summary>Decides whether an operation would change anything, and counts those that are performed and skipped.</summary>
internal sealed class RedundancyFilter
{
    private long _performed;
    private long _skipped;

    /// <summary>True to skip redundant operations; false to perform all of them, for comparison.</summary>
    public bool IsEnabled { get; set; } = true;

    /// <summary>Number of operations so far: performed, and skipped.</summary>
    public RedundancyCounts Counts => new(_performed, _skipped);

    /// <summary>Compares a value with the current one, and stores it.</summary>
    /// <param name="current">Value in effect; the new value afterwards.</param>
    /// <param name="value">Value that is to be in effect.</param>
    /// <returns>True when the operation must be performed.</returns>
    public bool Update<T>(ref T current, T value)
    {
        var mustPerform = ShouldPerform(EqualityComparer<T>.Default.Equals(current, value));
        current = value;
        return mustPerform;
    }

    /// <summary>Counts an operation that the caller has compared itself.</summary>
    /// <param name="isRedundant">Whether the operation would change nothing.</param>
    /// <param name="count">Number of operations that go together.</param>
    /// <returns>True when the operation must be performed.</returns>
    public bool ShouldPerform(bool isRedundant, int count = 1)
    {
        if (isRedundant && IsEnabled)
        {
            _skipped += count;
            return false;
        }

        _performed += count;
        return true;
    }
}
