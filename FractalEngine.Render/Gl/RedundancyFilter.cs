namespace FractalEngine.Render.Gl;

/// <summary>Tells whether something that is about to be done would change anything, and counts both cases.</summary>
internal sealed class RedundancyFilter
{
    /// <summary>Whether what would change nothing is not done. Where false everything is, for comparison.</summary>
    public bool IsEnabled { get; set; } = true;

    /// <summary>How often it was done so far.</summary>
    public long Performed { get; private set; }

    /// <summary>How often it was not needed, and not done.</summary>
    public long Skipped { get; private set; }

    /// <summary>Both, so far.</summary>
    public RedundancyCounts Counts => new(Performed, Skipped);

    /// <summary>Compares with the last value and keeps the new one.</summary>
    /// <param name="current">What holds now; the new value afterwards.</param>
    /// <param name="value">What shall hold.</param>
    /// <returns>True when it must be done.</returns>
    public bool Update<T>(ref T current, T value)
    {
        var mustPerform = ShouldPerform(EqualityComparer<T>.Default.Equals(current, value));
        current = value;
        return mustPerform;
    }

    /// <summary>Counts something whose caller has compared.</summary>
    /// <param name="isRedundant">Whether it would change nothing.</param>
    /// <param name="count">How many such things go together.</param>
    /// <returns>True when it must be done.</returns>
    public bool ShouldPerform(bool isRedundant, int count = 1)
    {
        if (isRedundant && IsEnabled)
        {
            Skipped += count;
            return false;
        }

        Performed += count;
        return true;
    }
}
