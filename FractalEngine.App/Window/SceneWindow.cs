using System.Diagnostics;
using FractalEngine.Render;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>
/// The window: loads a file in the background, draws when something has changed, and sleeps otherwise. What keys and mouse do to
/// the camera is <see cref="CameraControls"/>, how pictures are drawn is <see cref="WindowPictures"/>; here are the loop, and the keys that do something else.
/// </summary>
internal sealed class SceneWindow : IDisposable
{
    private static readonly TimeSpan FrameTime = TimeSpan.FromSeconds(1 / 60.0);
    private static readonly TimeSpan ProgressInterval = TimeSpan.FromSeconds(0.1);

    // A frame that took long must not make the camera jump.
    private static readonly TimeSpan LongestStep = TimeSpan.FromSeconds(0.1);

    private readonly WindowOptions _options;
    private readonly RenderWindow _window;
    private readonly FrameRenderer _frame;
    private readonly WindowPictures _pictures;
    private readonly WindowOverlay _overlay = new();
    private readonly Stopwatch _clock = Stopwatch.StartNew();
    private RenderSettings _settings;
    private BackgroundLoad _load;
    private Document? _document;
    private TimeSpan _advanced;
    private TimeSpan _refreshed;
    private int _exitCode;
    private bool _isClosing;
    private bool _isVisible = true;

    // What the window shows is older than the scene, or than the text over it. A new text costs no new drawing.
    private bool _isDrawingStale = true;
    private bool _isWindowStale = true;

    private SceneWindow(string path, WindowOptions options)
    {
        (_options, _settings) = (options, options.Settings);
        _window = new("FractalEngine", options.Size.Width, options.Size.Height);
        _frame = new(_window);
        _pictures = new(_frame);
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
        _frame.Dispose();
        _window.Dispose();
    }

    private void Run()
    {
        while (!_isClosing)
        {
            foreach (var windowEvent in _window.WaitEvents(TimeToSleep()))
            {
                Handle(windowEvent);
            }

            FinishLoading();
            FinishPreparing();
            Advance();
            _isWindowStale |= _overlay.Expire(_clock.Elapsed);
            if (IsStale && _window.Width > 0 && _window.Height > 0 && !_isClosing)
            {
                Refresh();
            }
        }
    }

    private bool IsStale => (_isVisible || !_options.SkipsStillPictures) && (_isDrawingStale || _isWindowStale);

    private TimeSpan TimeToSleep() =>
        IsStale ? TimeSpan.Zero
        : !_options.SkipsStillPictures ? Until(_refreshed + FrameTime)
        : _document?.IsMoving == true ? Until(_advanced + FrameTime)
        : !_load.IsTaken || _document?.Sight.IsRunning == true ? ProgressInterval
        : _overlay.NextExpiry is { } expiry ? Until(expiry)
        : Timeout.InfiniteTimeSpan;

    private TimeSpan Until(TimeSpan time) => time - _clock.Elapsed is { Ticks: > 0 } left ? left : TimeSpan.Zero;

    private BackgroundLoad StartLoading(string path)
    {
        _window.Title = $"{Path.GetFileName(path)} - FractalEngine";
        return new(path, _options.Load, _settings, _window.Aspect, _window.Wake);
    }

    private void FinishLoading()
    {
        if (_load.IsTaken)
        {
            return;
        }

        if (!_load.IsCompleted)
        {
            _overlay.Progress = _load.Progress;
            _isWindowStale = true;
            return;
        }

        (_overlay.Progress, _isWindowStale) = (null, true);
        var loaded = _load.Take(out _exitCode, out var error);
        _overlay.Error = error;
        if (loaded is not var (file, preparation))
        {
            Console.Error.WriteLine(error);
            return;
        }

        _document?.Dispose();
        _document = null;
        _pictures.Reset();
        _document = new(_window, file, preparation, _options);
        foreach (var message in file.Warnings.Select(warning => warning.ToString()).Concat(preparation.Scene.Notices))
        {
            Console.Error.WriteLine(message);
        }

        _overlay.Describe(file, preparation.Scene);
        _isDrawingStale = true;
    }

    /// <summary>Shows what has been prepared since it came in sight.</summary>
    private void FinishPreparing()
    {
        if (_document is not { Sight.IsRunning: true } document)
        {
            return;
        }

        _isWindowStale = true;
        var prepared = document.Sight.Take();
        _overlay.Progress = document.Sight.Progress;
        if (prepared is not null)
        {
            foreach (var notice in prepared.Notices.Skip(document.Renderer.Scene.Notices.Length))
            {
                Console.Error.WriteLine(notice);
            }

            document.Renderer.Update(prepared);
            _overlay.Describe(document.File, prepared);
            _isDrawingStale = true;
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
                _isDrawingStale = true;
                break;
            case WindowExposed:
                _isWindowStale = true;
                break;
            case VisibilityChanged visibility:
                _isVisible = visibility.IsVisible;
                _isWindowStale = true;
                break;
            case FileDropped dropped when _load.IsTaken:
                _load = StartLoading(dropped.Path);
                break;
            case KeyPressed { IsRepeat: false } pressed:
                Press(pressed);
                break;
        }

        if (_document is { } document)
        {
            var wasMoving = document.IsMoving;
            _isDrawingStale |= document.Handle(windowEvent, _window.Aspect);
            if (!wasMoving)
            {
                _advanced = _clock.Elapsed;
            }
        }
    }

    private void Press(KeyPressed pressed)
    {
        switch (pressed.Key)
        {
            case Key.H:
                _overlay.ShowsKeys = !_overlay.ShowsKeys;
                _isWindowStale = true;
                break;
            case Key.I:
                _overlay.ShowsStatistics = !_overlay.ShowsStatistics;
                _isWindowStale = true;
                break;
            case Key.T when _document is { Trail: { } trail } document:
                document.ToggleTrail();
                _overlay.Say(document.UsesTrail ? $"m becomes m·t, with a trail of {trail.Length}" : "parts of the fractal are chosen from all its levels", _clock.Elapsed);
                _isDrawingStale = true;
                break;
            case Key.F12 when _document is { } document:
                Say(WindowFiles.SaveScreenshot(_pictures.Capture(document, _settings, _window.Width, _window.Height), document.File.Path));
                _isDrawingStale = true;
                break;
            case Key.S when pressed.Modifiers.HasFlag(KeyModifiers.Control) && _document is { } document:
                Say(WindowFiles.SaveScene(document));
                break;
            case var key when !pressed.Modifiers.HasFlag(KeyModifiers.Control) && _document is { } document && PhysicsKeys.Apply(document, key) is { } message:
                _advanced = _clock.Elapsed;
                _overlay.Physics = document.Physics.Description;
                _overlay.Say(message, _clock.Elapsed);
                _isDrawingStale = true;
                break;
            default:
                Change(SettingKeys.Apply(_settings, pressed.Key));
                break;
        }
    }

    private void Change((RenderSettings Settings, string? Message)? change)
    {
        if (change is var (settings, message))
        {
            (_settings, _isDrawingStale) = (settings, true);
            if (message is not null)
            {
                _overlay.Say(message, _clock.Elapsed);
            }
        }
    }

    private void Advance()
    {
        var now = _clock.Elapsed;
        var time = now - _advanced;
        if (_document?.IsMoving == true && time >= FrameTime)
        {
            _advanced = now;
            _isDrawingStale |= _document.Advance(time < LongestStep ? time : LongestStep);
            _overlay.Physics = _document.Physics.Description;
        }

        if (_document?.Physics.TakeProblem() is { } problem)
        {
            Say(problem);
        }

        // What was drawn while moving was coarse, and one picture behind.
        _isDrawingStale |= _pictures.IsCoarse && _document?.IsMoving != true;
        _isDrawingStale |= !_options.SkipsStillPictures && now - _refreshed >= FrameTime;
    }

    private void Refresh()
    {
        var start = _refreshed = _clock.Elapsed;
        if (_isDrawingStale)
        {
            Draw();
        }
        else
        {
            _pictures.ShowAgain();
        }

        _overlay.Pictures = _pictures.CountsOf((long)(start / FrameTime));
        _frame.Present(_window, _overlay.Panels);
        if (_isDrawingStale)
        {
            _pictures.Measure(_clock.Elapsed - start);
        }

        (_isDrawingStale, _isWindowStale) = (false, false);
    }

    private void Draw()
    {
        var start = _clock.Elapsed;
        var drawn = _pictures.Draw(_document, _settings, _window.Width, _window.Height);
        if (_document is { } document)
        {
            document.Sight.Start(_pictures.Latest!, _window.Aspect);
            var controls = document.Controls;
            _overlay.Measure(new(document.Renderer, drawn.Detail, _clock.Elapsed - start, controls.Depth, controls.Enlargement, document.Physics));
        }
    }

    /// <summary>Says on the screen and the terminal what came of something.</summary>
    private void Say(string message)
    {
        Console.Error.WriteLine(message);
        _overlay.Say(message, _clock.Elapsed);
        _isWindowStale = true;
    }
}
