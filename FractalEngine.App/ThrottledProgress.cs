using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Preparation;

namespace FractalEngine.App;

/// <summary>Keeps only the last report, for whoever looks at it from another thread.</summary>
internal sealed class ThrottledProgress : IProgress<LoadProgress>, IProgress<PreparationProgress>
{
    private readonly Lock _lock = new();
    private (string Text, double Fraction) _latest = ("", 0);

    /// <summary>What is being done, and the fraction of it that is done.</summary>
    public (string Text, double Fraction) Latest
    {
        get
        {
            lock (_lock)
            {
                return _latest;
            }
        }

        private set
        {
            lock (_lock)
            {
                _latest = value;
            }
        }
    }

    /// <inheritdoc/>
    public void Report(LoadProgress value) => Latest = (value.File, value.Fraction);

    /// <inheritdoc/>
    public void Report(PreparationProgress value) => Latest = (value.FileName, value.Fraction);
}
