using System.Diagnostics;
using System.Globalization;

namespace FractalEngine.App.Animation;

/// <summary>Tells on a terminal which frame is drawn and how long the rest takes. Elsewhere it tells nothing.</summary>
/// <param name="frameCount">Number of all frames.</param>
/// <param name="isQuiet">Whether nothing is told on a terminal either.</param>
internal sealed class AnimationProgress(int frameCount, bool isQuiet)
{
    private readonly Stopwatch _clock = Stopwatch.StartNew();
    private readonly bool _isShown = !isQuiet && !Console.IsErrorRedirected;

    /// <summary>Tells how many frames are done, and the time left.</summary>
    public void Report(int done)
    {
        if (_isShown)
        {
            var secondsLeft = _clock.Elapsed.TotalSeconds * (frameCount - done) / done;
            Console.Error.Write(string.Create(CultureInfo.InvariantCulture, $"\rframe {done} of {frameCount}, {secondsLeft:F0} s left   "));
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
