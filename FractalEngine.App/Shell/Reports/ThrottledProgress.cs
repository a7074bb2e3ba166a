using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Preparation;

namespace FractalEngine.App.Shell.Reports;

/// <summary>
/// Keeps only the latest report, so that another thread reads progress at its own rate, however often it is reported.
/// </summary>
internal sealed class ThrottledProgress : IProgress<LoadProgress>, IProgress<PreparationProgress>
{
    private volatile Tuple<string, double> _latest = Tuple.Create("", 0.0);

    /// <summary>The latest file name, and the completed fraction from 0 to 1.</summary>
    public (string Text, double Fraction) Latest => _latest.ToValueTuple();

    public void Report(LoadProgress value) => _latest = Tuple.Create(value.File, value.Fraction);

    public void Report(PreparationProgress value) => _latest = Tuple.Create(value.FileName, value.Fraction);
}
