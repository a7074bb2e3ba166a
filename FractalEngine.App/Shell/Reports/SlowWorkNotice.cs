namespace FractalEngine.App.Shell.Reports;

/// <summary>Says once on stderr that work takes long, and that it can be ended: drawing tells nothing by itself.</summary>
internal sealed class SlowWorkNotice : IDisposable
{
    public static readonly TimeSpan DefaultDelay = TimeSpan.FromSeconds(10);

    private readonly Timer? _timer;

    /// <summary>Waits for the work: if it has not ended after the delay, the notice is written.</summary>
    /// <param name="work">What is done, as the first words of the sentence.</param>
    /// <param name="isQuiet">Whether nothing is told.</param>
    /// <param name="delay">Time after which the notice is written; null for the default.</param>
    /// <param name="output">Receives the notice; null for stderr.</param>
    public SlowWorkNotice(string work, bool isQuiet, TimeSpan? delay = null, TextWriter? output = null)
    {
        var time = delay ?? DefaultDelay;
        if (!isQuiet)
        {
            _timer = new(
                _ => (output ?? Console.Error).WriteLine(FormattableString.Invariant(
                    $"{work} takes more than {time.TotalSeconds:0.##} s; Ctrl+C ends it, and leaves no file")),
                null, time, Timeout.InfiniteTimeSpan);
        }
    }

    /// <summary>Tells that the work has ended, so that no notice is written any more.</summary>
    public void Dispose() => _timer?.Dispose();
}
