using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Preparation;

namespace FractalEngine.App.Shell.Reports;

/// <summary>
/// Keeps only the latest report, so that another thread reads progress at its own rate, however often it is reported.
/// </summary>
internal sealed class ThrottledProgress : IProgress<LoadProgress>, IProgress<PreparationProgress>
{
    private readonly Lock _lock = new();
    private (string Text, double Fraction) _latest = ("", 0);

    /// <summary>The latest file name, and the completed fraction from 0 to 1.</summary>
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

    public void Report(LoadProgress value) => Latest = (value.File, value.Fraction);

    public void Report(PreparationProgress value) => Latest = (value.FileName, value.Fraction);
}
