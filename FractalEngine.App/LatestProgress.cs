using FractalEngine.Parsing.Assets;

namespace FractalEngine.App;

/// <summary>Keeps only the last report, for whoever looks at it from another thread.</summary>
internal sealed class LatestProgress : IProgress<LoadProgress>
{
    private readonly Lock _lock = new();
    private LoadProgress _latest = new("Loading", 0);

    /// <summary>The last report.</summary>
    public LoadProgress Latest
    {
        get
        {
            lock (_lock)
            {
                return _latest;
            }
        }
    }

    /// <inheritdoc/>
    public void Report(LoadProgress value)
    {
        lock (_lock)
        {
            _latest = value;
        }
    }
}
