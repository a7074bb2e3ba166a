using FractalEngine.App.Shell;
using FractalEngine.App.Window.State;
using FractalEngine.Core;
using FractalEngine.Core.Files;
using FractalEngine.Core.Threading;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Loading;

/// <summary>Long work of a window in the background, with a panel that shows how far it is and has a button to stop it.</summary>
/// <param name="title">Names the work.</param>
/// <param name="report">Shows a message.</param>
/// <param name="wake">Lets the window look at the work once it has ended, from any thread.</param>
internal abstract class WindowJob(string title, Action<string> report, Action wake) : IProgress<double>, IDisposable
{
    // Of the panel, pixels at scale 1, from the lower right corner of what other panels leave free, above the texts there.
    private const double Right = 305;
    private const double Height = 165;

    // Files that are written are taken away when the next part of them is.
    private static readonly TimeSpan StopTimeout = TimeSpan.FromSeconds(3);

    private BackgroundJob<Action>? _job;
    private UiPanel? _panel;
    private volatile string _status = "";
    private double _fraction;
    private bool _isStopped;
    private (bool, string, int) _shown;

    public bool IsRunning => _job is not null;

    private int Percent => (int)(100 * Volatile.Read(ref _fraction));

    /// <summary>What is done at the moment, in lines. Any thread may tell it.</summary>
    protected string Status
    {
        set => _status = value;
    }

    /// <summary>Takes the completed fraction, from 0 to 1, from any thread.</summary>
    public void Report(double value) => Volatile.Write(ref _fraction, value);

    /// <summary>Shows a message for a few seconds.</summary>
    protected void Tell(string message) => report(message);

    /// <summary>Begins the work. None may be running.</summary>
    /// <param name="status">What is done first.</param>
    /// <param name="work">Runs on another thread, and returns what the window's thread does in the end.</param>
    protected void Start(string status, Func<CancellationToken, Action> work)
    {
        (_status, _fraction, _isStopped, _panel) = (status, 0, false, null);
        _job = new(work, wake);
    }

    /// <summary>Ends the work before it is done.</summary>
    /// <returns>False where none runs.</returns>
    public bool Stop()
    {
        _isStopped = true;
        _status = "stopping";
        _job?.Cancel();
        return IsRunning;
    }

    /// <summary>Does what the work ends with. Must be called on the window's thread.</summary>
    public Redraw Poll()
    {
        if (_job is not { } job)
        {
            return Redraw.None;
        }

        if (job.Result.IsCompleted)
        {
            _job = null;
            try
            {
                job.Result.GetAwaiter().GetResult()();
            }
            catch (Exception exception) when (exception
                is OperationCanceledException or FractalEngineException or UsageException or IOException or UnauthorizedAccessException
                or OutOfMemoryException)
            {
                report(_isStopped ? $"{title}: stopped, and nothing is written" : Failure.Of(exception).Text);
            }
        }

        var shown = (_job is null, _status, Percent);
        var redraw = shown == _shown ? Redraw.None : Redraw.Overlay;
        _shown = shown;
        return redraw;
    }

    /// <summary>Returns the panel of the work; null where none runs.</summary>
    /// <param name="ui">The interface, whose lower right corner it begins in.</param>
    /// <param name="index">Number of panels below it.</param>
    public UiPanel? PanelIn(UserInterface ui, int index) => !IsRunning ? null : _panel ??= new(title, Build)
    {
        IsOpen = true,
        Dock = UiDock.Floating,
        X = (ui.SceneArea.Right / ui.Scale) - Right,
        Y = (ui.SceneArea.Bottom / ui.Scale) - (Height * (index + 1)),
    };

    public void Dispose()
    {
        Stop();
        Task.WaitAny([_job?.Result ?? Task.CompletedTask], StopTimeout);
        AtomicFile.DeleteUnfinished();
    }

    private void Build(UserInterface ui)
    {
        ui.Row(1);
        ui.Paragraph(_status);
        if (Percent is > 0 and var percent)
        {
            ui.Progress(percent / 100.0, FormattableString.Invariant($"{percent} %"));
        }

        if (ui.Button("Stop", !_isStopped) || !_panel!.IsOpen)
        {
            Stop();
        }
    }
}
