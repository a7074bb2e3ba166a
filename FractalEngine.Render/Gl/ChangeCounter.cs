namespace FractalEngine.Render.Gl;

/// <summary>Tells whether something that is about to be done would change anything, and counts both cases.</summary>
internal sealed class ChangeCounter
{
    /// <summary>Whether what would change nothing is not done. Where false everything is, for comparison.</summary>
    public bool SkipsSame { get; set; } = true;

    /// <summary>How often it was done so far.</summary>
    public long Made { get; private set; }

    /// <summary>How often it was not needed, and not done.</summary>
    public long Skipped { get; private set; }

    /// <summary>Both, so far.</summary>
    public ChangeCounts Counts => new(Made, Skipped);

    /// <summary>Compares with the last value and keeps the new one.</summary>
    /// <param name="last">What holds now; the new value afterwards.</param>
    /// <param name="now">What shall hold.</param>
    /// <returns>True when it must be done.</returns>
    public bool IsNew<T>(ref T last, T now)
    {
        var isNew = IsNeeded(EqualityComparer<T>.Default.Equals(last, now));
        last = now;
        return isNew;
    }

    /// <summary>Counts something whose caller has compared.</summary>
    /// <param name="isSame">Whether it would change nothing.</param>
    /// <param name="count">How many such things go together.</param>
    /// <returns>True when it must be done.</returns>
    public bool IsNeeded(bool isSame, int count = 1)
    {
        if (isSame && SkipsSame)
        {
            Skipped += count;
            return false;
        }

        Made += count;
        return true;
    }
}
