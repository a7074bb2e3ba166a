using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Threading;
using FractalEngine.Parsing.Approximation;

namespace FractalEngine.App.Approximation;

/// <summary>Looks for a fractal until it is found, its time is over, or a signal ends the command.</summary>
/// <param name="mesh">The mesh.</param>
/// <param name="settings">What the fractal may cost.</param>
/// <param name="report">Receives what is looked for.</param>
internal sealed class ApproximationRun(Mesh mesh, ApproximationSettings settings, WrittenReport report) : IProgress<ApproximationProgress>
{
    // What asks for cancellation in time ends in its own way; what does not is left behind, as the program ends soon.
    private const double Grace = 0.03;

    private volatile ApproximationResult? _best;

    /// <summary>What ended the search, once it has ended.</summary>
    public ApproximationEnd End { get; private set; }

    /// <summary>Runs the search, and waits for its end.</summary>
    /// <param name="seconds">The most time that it may take; null for any.</param>
    /// <returns>What was found, or the best of it when the search was ended; null for nothing.</returns>
    public ApproximationResult? Find(double? seconds)
    {
        using var interruption = new InterruptSignal();
        var job = new BackgroundJob<ApproximationResult>(
            cancellation => MeshApproximator.Find(mesh, settings, this, cancellation), static () => { });
        try
        {
            if (Task.WaitAny([job.Result], Milliseconds(seconds), interruption.Token) >= 0)
            {
                return job.Result.GetAwaiter().GetResult();
            }

            End = ApproximationEnd.Time;
            job.Cancel();
            Task.WaitAny([job.Result], Milliseconds(Grace * seconds));
        }
        catch (OperationCanceledException)
        {
            End = ApproximationEnd.Interruption;
            job.Cancel();
            interruption.Acknowledge();
        }

        return _best;
    }

    public void Report(ApproximationProgress value)
    {
        _best = value.Best;
        var best = value.Best is { } result
            ? FormattableString.Invariant($"; best so far: {result.Bytes} bytes, {new ApproximationText(mesh, result).Distances}")
            : "";
        report.Progress($"looking for {value.Stage}{best}");
    }

    private static int Milliseconds(double? seconds) => seconds is { } value ? (int)Math.Min(1000 * value, int.MaxValue) : Timeout.Infinite;
}
