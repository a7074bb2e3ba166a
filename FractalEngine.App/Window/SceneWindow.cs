using System.Diagnostics;
using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.Drawing;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.Input;
using FractalEngine.App.Window.Loading;
using FractalEngine.App.Window.Panels;
using FractalEngine.App.Window.State;
using FractalEngine.Core;
using FractalEngine.Parsing.Editing;
using FractalEngine.Render;
using FractalEngine.Render.Windowing;
using FractalEngine.Render.Windowing.Events;

namespace FractalEngine.App.Window;

/// <summary>
/// The event loop of a window: passes events on, advances time, draws when something has changed, and sleeps otherwise.
/// </summary>
/// <remarks>
/// <see cref="EventDispatch"/> passes events on, <see cref="DocumentLoader"/> loads files, and <see cref="WindowRenderer"/> draws frames.
/// </remarks>
internal sealed class SceneWindow : IDisposable
{
    private static readonly TimeSpan FrameTime = TimeSpan.FromSeconds(1 / 60.0);
    private static readonly TimeSpan ProgressInterval = TimeSpan.FromSeconds(0.1);

    // After a frame that took long, camera and bodies must not jump.
    private static readonly TimeSpan MaxTimeStep = TimeSpan.FromSeconds(0.1);

    private readonly RenderWindow _window;
    private readonly FrameRenderer _frameRenderer;
    private readonly WindowRenderer _windowRenderer;
    private readonly WindowOverlay _overlay = new();
    private readonly WindowTracing _tracing;
    private readonly ViewArea _area;
    private readonly DocumentLoader _loader;
    private readonly PanelLayout _panels;
    private readonly WindowActions _actions;
    private readonly WindowInterface _interface;
    private readonly EventDispatch _events;
    private readonly Stopwatch _clock = Stopwatch.StartNew();
    private TimeSpan _lastAdvance;
    private TimeSpan _refreshTime;
    private Redraw _redraw = Redraw.Overlay | Redraw.Scene;
    private bool _isClosing;
    private bool _isVisible = true;

    // Of the last frame, and one that was beyond the driver, in pixels.
    private (int Width, int Height)? _shownSize;
    private (int Width, int Height)? _refusedSize;

    private SceneWindow(string path, WindowOptions options)
    {
        // To open a window takes about as long as to load a file.
        var first = new BackgroundLoad(
            new(path, Continues: false, FileEdits.None), options.Load, options.Settings, (double)options.Size.Width / options.Size.Height,
            options.Size, new(), null, () => _window?.Wake());
        _window = new("FractalEngine", options.Size.Width, options.Size.Height);
        _frameRenderer = new(_window);
        _windowRenderer = new(_frameRenderer);
        var prompts = new PromptHost(() => _window.ClipboardText);
        var recent = new RecentFiles(options.RecentFilesPath, Report);
        _area = new(_window);
        _loader = new(_window, _area, _overlay, options, recent.Add, Report, () => _actions!.Settings, () => _clock.Elapsed, first);
        _tracing = new(options, _window.Wake);
        var saver = new DocumentSaver(_loader, prompts, Report);
        var files = new FileCommands(_loader, saver, prompts, recent, Report, () => _isClosing = true);
        var search = new WindowApproximation(_loader, files, prompts, Report, _window.Wake);
        var export = new WindowExport(_loader, prompts, Report, _window.Wake);
        _panels = new(_window, options.SettingsPath, Report, ui => _interface!.Build(ui));
        _actions = new(
            _window, _windowRenderer, _overlay, _tracing, _panels, _loader, files, saver, search, export, options.Settings,
            () => _clock.Elapsed, () => _redraw |= Redraw.Scene);
        _interface = new(_actions);
        _events = new(_window, _frameRenderer, _actions, prompts);
        _tracing.IsEnabled = options.IsTraced ?? _panels.IsTraced;
    }

    /// <summary>Opens a window on a file, and returns when the user closes it.</summary>
    /// <returns>The exit code of the load. Later errors are shown in the window.</returns>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL.</exception>
    public static int Show(string path, WindowOptions options)
    {
        using var window = new SceneWindow(path, options);
        window.Run();
        return window._loader.ExitCode;
    }

    public void Dispose()
    {
        Array.ForEach([.. _actions.Jobs], static job => job.Dispose());
        _tracing.Dispose();
        _loader.Dispose();
        _frameRenderer.Dispose();
        _window.Dispose();
    }

    private Document? Document => _loader.Document;

    /// <summary>Whether the last frame was coarse, and nothing moves any more.</summary>
    private bool NeedsFullFrame =>
        _windowRenderer.IsReducedQuality && Document?.IsMoving != true && _windowRenderer.TimeToFinerFrame <= TimeSpan.Zero;

    private bool NeedsRefresh =>
        _isVisible && _redraw != Redraw.None && _window is { Width: > 0, Height: > 0 } && Size != _refusedSize;

    // While the view is traced, nothing is seen of the frame below.
    private bool CanGather => _isVisible && !NeedsRefresh && Document is { IsMoving: false } && !_tracing.IsTracing
        && Size == _shownSize && _windowRenderer.CanGather(_actions.Settings);

    private (int Width, int Height) Size => (_window.Width, _window.Height);

    private void Run()
    {
        while (!_isClosing)
        {
            foreach (var windowEvent in _window.WaitEvents(WaitTimeout()))
            {
                Handle(windowEvent);
            }

            PollLoader();
            Advance();
            if (_overlay.Expire(_clock.Elapsed) | _tracing.TakeUpdate())
            {
                _redraw |= Redraw.Overlay;
            }

            if (NeedsRefresh && !_isClosing)
            {
                Refresh();
            }
            else if (CanGather && !_isClosing && _windowRenderer.Gather(Document!, _actions.Settings))
            {
                _redraw |= Redraw.Overlay;
            }
        }
    }

    private void Handle(WindowEvent windowEvent)
    {
        if (windowEvent is VisibilityChanged visibility)
        {
            _isVisible = visibility.IsVisible;
        }

        var wasMoving = Document?.IsMoving == true;
        // A slow frame between two clicks does not part a double click.
        var redraw = _events.Dispatch(windowEvent, _clock.Elapsed - _refreshTime);
        _redraw |= redraw;
        if (redraw != Redraw.None)
        {
            _windowRenderer.RecordInput();
        }

        if (!wasMoving)
        {
            // Time begins to count with the event that starts a movement.
            _lastAdvance = _clock.Elapsed;
        }
    }

    /// <summary>Returns the time until the loop must run again, even if no event arrives.</summary>
    private TimeSpan WaitTimeout()
    {
        if (NeedsRefresh || CanGather || _loader.IsDue)
        {
            return TimeSpan.Zero;
        }

        if (Document?.IsMoving == true)
        {
            return TimeUntil(_lastAdvance + FrameTime);
        }

        if (_windowRenderer is { IsReducedQuality: true, TimeToFinerFrame: { Ticks: > 0 } left })
        {
            return left;
        }

        if (_loader.IsBusy || _actions.Jobs.Any(static job => job.IsRunning))
        {
            return ProgressInterval;
        }

        return _overlay.NextExpiry is { } expiry ? TimeUntil(expiry) : Timeout.InfiniteTimeSpan;
    }

    private TimeSpan TimeUntil(TimeSpan time) => time - _clock.Elapsed is { Ticks: > 0 } remaining ? remaining : TimeSpan.Zero;

    private void PollLoader()
    {
        var previousDocument = Document;
        // Messages ask for frames meanwhile.
        var redraw = _actions.Jobs.Aggregate(_loader.Poll(), static (redraw, job) => redraw | job.Poll());
        _redraw |= redraw;
        if (Document != previousDocument)
        {
            _windowRenderer.Reset();
        }
    }

    private void Report(string message)
    {
        _overlay.Report(message, _clock.Elapsed);
        _redraw |= Redraw.Overlay;
    }

    private void Advance()
    {
        var now = _clock.Elapsed;
        var time = now - _lastAdvance;
        if (Document is { IsMoving: true } document && time >= FrameTime)
        {
            _lastAdvance = now;
            if (document.Advance(time < MaxTimeStep ? time : MaxTimeStep))
            {
                _redraw |= Redraw.Scene;
            }

            _overlay.PhysicsStatus = document.Physics.HasMovers ? document.Physics.StatusText : null;
        }

        if (Document?.Physics.TakeProblem() is { } problem)
        {
            _overlay.Report(problem, now);
            _redraw |= Redraw.Overlay;
        }

        // The last frame of a movement was coarse and one view behind, so a full one follows it.
        if (NeedsFullFrame)
        {
            _redraw |= Redraw.Scene;
        }
    }

    private void Refresh()
    {
        var size = Size;
        try
        {
            ShowFrame();
            _shownSize = size;
            _refusedSize = null;
        }
        catch (FractalEngineException exception)
            when (exception.Kind == ErrorKind.Limit && _shownSize is { } shown && shown != size && size != _refusedSize)
        {
            // A window of another size can be drawn, and has what was not saved.
            _refusedSize = size;
            _redraw = Redraw.Scene | Redraw.Overlay;
            _overlay.Report(exception.Message, _clock.Elapsed);
        }
    }

    private void ShowFrame()
    {
        var start = _clock.Elapsed;
        var needsDraw = _redraw.HasFlag(Redraw.Scene) | _area.Update(_panels.Ui);
        _redraw = Redraw.None;
        if (needsDraw)
        {
            // First of all, so that a trace of an earlier view takes no time from the frame.
            var isStill = Document?.IsMoving != true && !_windowRenderer.FollowsAtOnce;
            _tracing.Update(Document, _actions.Settings, _window.Width, _window.Height, isStill);
            Draw();
        }
        else
        {
            _windowRenderer.CountPresentedAgain();
        }

        _overlay.FrameCounts = _windowRenderer.CountFrames((long)(start / FrameTime));
        _overlay.TraceText = _tracing.StatusText;
        _loader.ShowTitle();
        _panels.Update(_window.Width, _window.Height);
        // By the panels as they are now.
        _overlay.HidesPhysics = _panels.IsShown && !_panels.HasRoomForPhysics;
        _overlay.MessageReplacesStatus = _panels.IsShown && !_panels.HasRoomForTexts;
        if (_area.Update(_panels.Ui) && Document is not null)
        {
            _redraw |= Redraw.Scene;
        }

        _frameRenderer.Present(_window, _tracing.Layer, _panels.Ui, _overlay.Panels);
        if (needsDraw)
        {
            _windowRenderer.RecordFrameTime(_clock.Elapsed - start);
        }

        _refreshTime += _clock.Elapsed - start;
        if (NeedsFullFrame)
        {
            // After a preview, as soon as the events until now are handled.
            _redraw |= Redraw.Scene;
        }
    }

    private void Draw()
    {
        var start = _clock.Elapsed;
        var usedSettings = _windowRenderer.Draw(Document, _actions.Settings, _window.Width, _window.Height);
        if (Document is { } document)
        {
            document.FirstSightLoader.Start(_windowRenderer.LatestView!, _window.Aspect, _actions.Settings);
            var camera = document.FlyingCamera;
            var drawTime = _clock.Elapsed - start;
            _overlay.ViewText = ViewName.Of(document.Camera, camera.Projection, document.VisibleDepth, camera.Log10Magnification);
            _overlay.SetReport(new(
                document.Renderer, usedSettings.Culling, drawTime, camera.Depth, camera.Log10Magnification, document.Physics));
        }
    }
}
