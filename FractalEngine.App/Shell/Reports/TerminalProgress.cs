using System.Diagnostics;
using System.Globalization;

namespace FractalEngine.App.Shell.Reports;

/// <summary>Tells on a terminal how far a long work is and how long the rest takes. Elsewhere it tells nothing.</summary>
/// <param name="step">The word for one step, such as "frame".</param>
/// <param name="stepCount">Number of all steps.</param>
/// <param name="isQuiet">Whether nothing is told on a terminal either.</param>
internal sealed class TerminalProgress(string step, int stepCount, bool isQuiet)
{
    private readonly Stopwatch _clock = Stopwatch.StartNew();
    private readonly bool _isShown = !isQuiet && !Console.IsErrorRedirected;

    public void Report(int done)
    {
        if (_isShown)
        {
            var secondsLeft = _clock.Elapsed.TotalSeconds * (stepCount - done) / done;
            Console.Error.Write(string.Create(CultureInfo.InvariantCulture, $"\r{step} {done} of {stepCount}, {secondsLeft:F0} s left   "));
        }
    }

    /// <summary>Clears the line of the terminal, so that a report can follow.</summary>
    public void End()
    {
        if (_isShown)
        {
            Console.Error.Write($"\r{new string(' ', 60)}\r");
        }
    }
}
