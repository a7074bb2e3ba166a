using System.Diagnostics;
using FractalEngine.Render;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>
/// The window: loads a file in the background, draws when something has changed, and sleeps otherwise. What keys and mouse do to
/// the camera is <see cref="CameraControls"/>, how pictures are drawn is <see cref="WindowRenderer"/>; here are the loop, and the keys that
/// do something else.
/// </summary>
internal sealed class SceneWindow : IDisposable
{
    private static readonly TimeSpan FrameTime = TimeSpan.FromSeconds(1 / 60.0);
    private static readonly TimeSpan ProgressInterval = TimeSpan.FromSeconds(0.1);

    // A frame that took long must not make the camera jump.
    private static readonly TimeSpan MaxTimeStep = TimeSpan.FromSeconds(0.1);

    private readonly WindowOptions _options;
    private readonly RenderWindow _window;
    private readonly FrameRenderer _frameRenderer;
    private readonly WindowRenderer _windowRenderer;
    private readonly WindowOverlay _overlay = new();
    private readonly Stopwatch _clock = Stopwatch.StartNew();
    private RenderSettings _settings;
    private BackgroundLoad _load;
    private Document? _document;
    private TimeSpan _lastAdvance;
    private TimeSpan _lastRefresh;
    private int _exitCode;
    private bool _isClosing;
    private bool _isVisible = true;

    // What the window shows is older than the scene, or than the text over it. A new text costs no new drawing.
    private bool _needsDraw = true;
    private bool _needsPresent = true;

    private SceneWindow(string path, WindowOptions options)
    {
        (_options, _settings) = (options, options.Settings);
        _window = new("FractalEngine", options.Size.Width, options.Size.Height);
        _frameRenderer = new(_window);
        _windowRenderer = new(_frameRenderer);
        _load = StartLoading(path);
    }

    /// <summary>Opens a window on a file and returns when it is closed.</summary>
    /// <returns>The exit code: that of the load, since everything else succeeds or says so on the screen.</returns>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL.</exception>
    public static int Show(string path, WindowOptions options)
    {
        using var window = new SceneWindow(path, options);
        window.Run();
        return window._exitCode;
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _document?.Dispose();
        _frameRenderer.Dispose();
        _window.Dispose();
    }

    private void Run()
    {
        while (!_isClosing)
        {
            foreach (var windowEvent in _window.WaitEvents(WaitTimeout()))
            {
                Handle(windowEvent);
            }

            PollLoading();
            PollPreparation();
            Advance();
            _needsPresent |= _overlay.Expire(_clock.Elapsed);
            if (NeedsRefresh && _window.Width > 0 && _window.Height > 0 && !_isClosing)
            {
                Refresh();
            }
        }
    }

    private bool NeedsRefresh => (_isVisible || !_options.IdleWhenUnchanged) && (_needsDraw || _needsPresent);

    private TimeSpan WaitTimeout() =>
        NeedsRefresh ? TimeSpan.Zero
        : !_options.IdleWhenUnchanged ? TimeUntil(_lastRefresh + FrameTime)
        : _document?.IsMoving == true ? TimeUntil(_lastAdvance + FrameTime)
        : !_load.IsResultTaken || _document?.FirstSightLoader.IsRunning == true ? ProgressInterval
        : _overlay.NextExpiry is { } expiry ? TimeUntil(expiry)
        : Timeout.InfiniteTimeSpan;

    private TimeSpan TimeUntil(TimeSpan time) => time - _clock.Elapsed is { Ticks: > 0 } left ? left : TimeSpan.Zero;

    private BackgroundLoad StartLoading(string path)
    {
        _window.Title = $"{Path.GetFileName(path)} - FractalEngine";
        return new(path, _options.Load, _settings, _window.Aspect, _window.Wake);
    }

    private void PollLoading()
    {
        if (_load.IsResultTaken)
        {
            return;
        }

        if (!_load.IsCompleted)
        {
            _overlay.Progress = _load.Progress;
            _needsPresent = true;
            return;
        }

        (_overlay.Progress, _needsPresent) = (null, true);
        var loaded = _load.TakeResult(out _exitCode, out var error);
        _overlay.Error = error;
        if (loaded is not var (file, preparation))
        {
            Console.Error.WriteLine(error);
            return;
        }

        _document?.Dispose();
        _document = null;
        _windowRenderer.Reset();
        _document = new(_window, file, preparation, _options);
        foreach (var message in file.Warnings.Select(warning => warning.ToString()).Concat(preparation.Scene.Notices))
        {
            Console.Error.WriteLine(message);
        }

        _overlay.DescribeFile(file, preparation.Scene);
        _needsDraw = true;
    }

    /// <summary>Shows what has been prepared since it came in sight.</summary>
    private void PollPreparation()
    {
        if (_document is not { FirstSightLoader.IsRunning: true } document)
        {
            return;
        }

        _needsPresent = true;
        var prepared = document.FirstSightLoader.TakeScene();
        _overlay.Progress = document.FirstSightLoader.Progress;
        if (prepared is not null)
        {
            foreach (var notice in prepared.Notices.Skip(document.Renderer.Scene.Notices.Length))
            {
                Console.Error.WriteLine(notice);
            }

            document.Renderer.Update(prepared);
            _overlay.DescribeFile(document.File, prepared);
            _needsDraw = true;
        }
    }

    private void Handle(WindowEvent windowEvent)
    {
        switch (windowEvent)
        {
            case CloseRequested or KeyPressed { Key: Key.Escape }:
                _isClosing = true;
                return;
            case WindowResized:
                _needsDraw = true;
                break;
            case WindowExposed:
                _needsPresent = true;
                break;
            case VisibilityChanged visibility:
                _isVisible = visibility.IsVisible;
                _needsPresent = true;
                break;
            case FileDropped dropped when _load.IsResultTaken:
                _load = StartLoading(dropped.Path);
                break;
            case KeyPressed { IsRepeat: false } pressed:
                HandleKey(pressed);
                break;
        }

        if (_document is { } document)
        {
            var wasMoving = document.IsMoving;
            _needsDraw |= document.Handle(windowEvent, _window.Aspect);
            if (!wasMoving)
            {
                _lastAdvance = _clock.Elapsed;
            }
        }
    }

    private void HandleKey(KeyPressed pressed)
    {
        switch (pressed.Key)
        {
            case Key.H:
                _overlay.ShowsKeys = !_overlay.ShowsKeys;
                _needsPresent = true;
                break;
            case Key.I:
                _overlay.ShowsStatistics = !_overlay.ShowsStatistics;
                _needsPresent = true;
                break;
            case Key.T when _document is { Trail: { } trail } document:
                document.ToggleTrail();
                _overlay.ShowMessage(document.IsTrailEnabled
                    ? $"m becomes m·t, with a trail of {trail.Length}"
                    : "parts of the fractal are chosen from all its levels", _clock.Elapsed);
                _needsDraw = true;
                break;
            case Key.F12 when _document is { } document:
                ShowMessage(WindowFiles.SaveScreenshot(_windowRenderer.Capture(document, _settings, _window.Width, _window.Height),
                    document.File.Path));
                _needsDraw = true;
                break;
            case Key.S when pressed.Modifiers.HasFlag(KeyModifiers.Control) && _document is { } document:
                ShowMessage(WindowFiles.SaveScene(document));
                break;
            case var key when !pressed.Modifiers.HasFlag(KeyModifiers.Control) && _document is { } document
            && PhysicsKeys.Apply(document, key) is { } message:
                _lastAdvance = _clock.Elapsed;
                _overlay.PhysicsStatus = document.Physics.StatusText;
                _overlay.ShowMessage(message, _clock.Elapsed);
                _needsDraw = true;
                break;
            default:
                ApplySettings(SettingKeys.Apply(_settings, pressed.Key));
                break;
        }
    }

    private void ApplySettings((RenderSettings Settings, string? Message)? change)
    {
        if (change is var (settings, message))
        {
            (_settings, _needsDraw) = (settings, true);
            if (message is not null)
            {
                _overlay.ShowMessage(message, _clock.Elapsed);
            }
        }
    }

    private void Advance()
    {
        var now = _clock.Elapsed;
        var time = now - _lastAdvance;
        if (_document?.IsMoving == true && time >= FrameTime)
        {
            _lastAdvance = now;
            _needsDraw |= _document.Advance(time < MaxTimeStep ? time : MaxTimeStep);
            _overlay.PhysicsStatus = _document.Physics.StatusText;
        }

        if (_document?.Physics.TakeProblem() is { } problem)
        {
            ShowMessage(problem);
        }

        // What was drawn while moving was coarse, and one picture behind.
        _needsDraw |= _windowRenderer.IsReducedQuality && _document?.IsMoving != true;
        _needsDraw |= !_options.IdleWhenUnchanged && now - _lastRefresh >= FrameTime;
    }

    private void Refresh()
    {
        var start = _lastRefresh = _clock.Elapsed;
        if (_needsDraw)
        {
            Draw();
        }
        else
        {
            _windowRenderer.CountPresentedAgain();
        }

        _overlay.FrameCounts = _windowRenderer.CountFrames((long)(start / FrameTime));
        _frameRenderer.Present(_window, _overlay.Panels);
        if (_needsDraw)
        {
            _windowRenderer.RecordFrameTime(_clock.Elapsed - start);
        }

        (_needsDraw, _needsPresent) = (false, false);
    }

    private void Draw()
    {
        var start = _clock.Elapsed;
        var usedSettings = _windowRenderer.Draw(_document, _settings, _window.Width, _window.Height);
        if (_document is { } document)
        {
            document.FirstSightLoader.Start(_windowRenderer.LatestView!, _window.Aspect);
            var controls = document.CameraControls;
            _overlay.SetReport(
                new(document.Renderer, usedSettings.Culling, _clock.Elapsed - start, controls.Depth, controls.Log10Magnification,
                document.Physics));
        }
    }

    /// <summary>Says on the screen and the terminal what came of something.</summary>
    private void ShowMessage(string message)
    {
        Console.Error.WriteLine(message);
        _overlay.ShowMessage(message, _clock.Elapsed);
        _needsPresent = true;
    }
}
