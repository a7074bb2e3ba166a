using System.Diagnostics;
using FractalEngine.App.Commands;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;
using FractalEngine.Render;
using FractalEngine.Render.Pictures;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>
/// The window: loads a file in the background, draws when something has changed, and sleeps otherwise. What keys and mouse do to
/// the camera is <see cref="CameraControls"/>; here are the keys that do something else.
/// </summary>
internal sealed class SceneWindow : IDisposable
{
    private static readonly TimeSpan FrameTime = TimeSpan.FromSeconds(1 / 60.0);
    private static readonly TimeSpan ProgressInterval = TimeSpan.FromSeconds(0.1);

    // A frame that took long must not make the camera jump.
    private static readonly TimeSpan LongestStep = TimeSpan.FromSeconds(0.1);

    private readonly LoadOptions _options;
    private readonly Projection? _projection;
    private readonly int _trailLength;
    private readonly RenderWindow _window;
    private readonly FrameRenderer _frame;
    private readonly WindowOverlay _overlay = new();
    private readonly Stopwatch _clock = Stopwatch.StartNew();
    private RenderSettings _settings;
    private readonly MovingDetail _moving = new();
    private BackgroundLoad _load;
    private readonly LatestProgress _preparingProgress = new();
    private Document? _document;
    private Task? _preparing;
    private TimeSpan _advanced;
    private View? _next;
    private long _drawnFrames;
    private int _exitCode;
    private bool _isClosing;
    private bool _isVisible = true;

    // What the window shows is older than the scene, or than the text over it. A new text costs no new drawing.
    private bool _isDrawingStale = true;
    private bool _isWindowStale = true;

    private SceneWindow(string path, LoadOptions options, Projection? projection, RenderSettings settings, int trailLength, (int Width, int Height) size)
    {
        (_options, _projection, _settings, _trailLength) = (options, projection, settings, trailLength);
        _window = new("FractalEngine", size.Width, size.Height);
        _frame = new(_window);
        _load = StartLoading(path);
    }

    private double Aspect => (double)Math.Max(1, _window.Width) / Math.Max(1, _window.Height);

    /// <summary>Opens a window on a file and returns when it is closed.</summary>
    /// <returns>The exit code: that of the load, since everything else succeeds or says so on the screen.</returns>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL.</exception>
    public static int Show(string path, LoadOptions options, Projection? projection, RenderSettings settings, int trailLength, (int Width, int Height) size)
    {
        using var window = new SceneWindow(path, options, projection, settings, trailLength, size);
        window.Run();
        return window._exitCode;
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _preparing?.GetAwaiter().GetResult();
        _document?.Renderer.Dispose();
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

    private bool IsStale => _isVisible && (_isDrawingStale || _isWindowStale);

    private TimeSpan TimeToSleep() =>
        IsStale ? TimeSpan.Zero
        : _document?.Controls.IsMoving == true ? Max(TimeSpan.Zero, FrameTime - (_clock.Elapsed - _advanced))
        : !_load.IsTaken ? ProgressInterval
        : _preparing is not null ? ProgressInterval
        : _overlay.NextExpiry is { } expiry ? Max(TimeSpan.Zero, expiry - _clock.Elapsed)
        : Timeout.InfiniteTimeSpan;

    private static TimeSpan Max(TimeSpan time1, TimeSpan time2) => time1 > time2 ? time1 : time2;

    private BackgroundLoad StartLoading(string path)
    {
        _window.Title = $"{Path.GetFileName(path)} - FractalEngine";
        return new(path, _options, _settings, Aspect, _window.Wake);
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

        (_overlay.Progress, _overlay.Error, _isWindowStale) = (null, null, true);
        try
        {
            var (file, preparation) = _load.Take();
            Open(file, preparation);
            _exitCode = ExitCode.Done;
        }
        catch (SourceException exception)
        {
            _exitCode = exception.Diagnostic.IsLimit ? ExitCode.OverLimit : ExitCode.BadInput;
            _overlay.Error = exception.Diagnostic.ToString();
            Console.Error.WriteLine(exception.Diagnostic);
        }
        catch (FractalLimitException exception)
        {
            _exitCode = ExitCode.OverLimit;
            _overlay.Error = $"error: {exception.Message}";
            Console.Error.WriteLine(_overlay.Error);
        }
    }

    /// <summary>Shows what has been prepared since it came in sight.</summary>
    private void FinishPreparing()
    {
        if (_preparing is null || _document is not { } document)
        {
            return;
        }

        if (!_preparing.IsCompleted)
        {
            _overlay.Progress = _preparingProgress.Latest;
            _isWindowStale = true;
            return;
        }

        _preparing.GetAwaiter().GetResult();
        (_preparing, _overlay.Progress) = (null, null);
        var (before, now) = (document.Renderer.Scene.Notices, document.Preparation.Scene.Notices);
        document.Renderer.Update(document.Preparation.Scene);
        foreach (var notice in now.Skip(before.Length))
        {
            Console.Error.WriteLine(notice);
        }

        _overlay.Describe(document.File, document.Preparation.Scene);
        _isDrawingStale = true;
    }

    /// <summary>Begins to prepare what has come in sight.</summary>
    private void PrepareInSight(Document document, View view)
    {
        if (_preparing is not null || document.Preparation.IsComplete || !document.Preparation.NeedsPreparation(view, Aspect))
        {
            return;
        }

        var (preparation, aspect) = (document.Preparation, Aspect);
        _preparing = Task.Run(() =>
        {
            preparation.PrepareInSight(view, aspect, _preparingProgress);
            _window.Wake();
        });
        _isWindowStale = true;
    }

    private void Open(LoadedFile file, ScenePreparation preparation)
    {
        var drawable = preparation.Scene;
        _preparing?.GetAwaiter().GetResult();
        _preparing = null;
        _document?.Renderer.Dispose();
        var scene = file.Scene.Scene;
        var view = View.Of(file.Scene, Aspect);
        var controls = new CameraControls(
            file.Scene.Bounds, view.Camera, _projection ?? scene.Projection, scene.OrthographicHeight, FractalIn(drawable));
        _document = new(file, preparation, new(_window, drawable), controls)
        {
            Trail = file.Scene.Objects is [{ Model: FractalModel { Fractal: var fractal } }] ? new(fractal, _trailLength) : null,
        };
        foreach (var message in file.Warnings.Select(warning => warning.ToString()).Concat(drawable.Notices))
        {
            Console.Error.WriteLine(message);
        }

        _overlay.Describe(file, drawable);
        _isDrawingStale = true;
    }

    /// <summary>The fractal, where it is all there is: the camera can then go into it as deep as it likes.</summary>
    private static FractalPlace? FractalIn(DrawableScene drawable) =>
        drawable.Source.Objects is [{ Model: FractalModel, Map: var map }] && drawable.Objects[0].Model.Detail is { } table ? new(0, table, map) : null;

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
            var wasMoving = document.Controls.IsMoving;
            _isDrawingStale |= document.Controls.Handle(windowEvent, Aspect);
            if (!wasMoving)
            {
                _advanced = _clock.Elapsed;
            }
        }
    }

    private void Press(KeyPressed pressed)
    {
        var isCommand = pressed.Modifiers.HasFlag(KeyModifiers.Control);
        switch (pressed.Key)
        {
            case Key.H:
                _overlay.ShowsKeys = !_overlay.ShowsKeys;
                _isWindowStale = true;
                break;
            case Key.G:
                _settings = _settings with { Grid = !_settings.Grid, Axes = !_settings.Grid };
                _isDrawingStale = true;
                break;
            case Key.X:
                _settings = _settings with { Wireframe = !_settings.Wireframe };
                _isDrawingStale = true;
                break;
            case Key.L:
                _settings = _settings with { Shading = _settings.Shading == Shading.PerVertex ? Shading.PerPixel : Shading.PerVertex };
                _overlay.Say(_settings.Shading == Shading.PerPixel ? "light at every pixel" : "light at the vertices", _clock.Elapsed);
                _isDrawingStale = true;
                break;
            case Key.T when _document is { Trail: { } trail } document:
                document.UsesTrail = !document.UsesTrail;
                document.Renderer.Move(0, document.Placement);
                _overlay.Say(document.UsesTrail ? $"m becomes m·t, with a trail of {trail.Length}" : "parts of the fractal are chosen from all its levels", _clock.Elapsed);
                _isDrawingStale = true;
                break;
            case Key.I:
                _overlay.ShowsStatistics = !_overlay.ShowsStatistics;
                _isWindowStale = true;
                break;
            case Key.F12 when _document is { } document:
                TrySay(() => SaveScreenshot(document));
                break;
            case Key.S when isCommand && _document is { } document:
                TrySay(() => SaveScene(document));
                break;
        }
    }

    private void Advance()
    {
        var time = _clock.Elapsed - _advanced;
        if (_document?.Controls.IsMoving == true && time >= FrameTime)
        {
            _advanced = _clock.Elapsed;
            _isDrawingStale |= _document.Controls.Advance(time < LongestStep ? time : LongestStep);
        }

        // What was drawn while moving was one picture behind.
        _isDrawingStale |= _next is not null && _document?.Controls.IsMoving != true;
    }

    private void Refresh()
    {
        var start = _clock.Elapsed;
        if (_isDrawingStale)
        {
            Draw();
        }

        _frame.Present(_window, _overlay.Panels);
        if (_isDrawingStale && _next is not null)
        {
            _moving.Measure(_clock.Elapsed - start);
        }

        (_isDrawingStale, _isWindowStale) = (false, false);
    }

    private void Draw()
    {
        var start = _clock.Elapsed;
        var view = _document is { } document
            ? View.Of(document.File.Scene with { Scene = document.SceneNow() }, Aspect)
            : new(Camera.Default, Projection.Perspective);
        if (_document is { UsesTrail: true, Trail: { } trail } shown)
        {
            shown.Renderer.Move(0, trail.Follow(shown.Placement, view.Camera.Position));
        }
        else
        {
            view = _document?.Controls.Deepened(view) ?? view;
        }

        if (_document?.Controls.IsMoving == true)
        {
            // One picture behind: while it is drawn, the next one's instances are chosen.
            (var drawn, _next) = (_next ?? view, view);
            _frame.Draw(_document.Renderer, drawn, _window.Width, _window.Height, _moving.Adapt(_settings), view);
        }
        else
        {
            _next = null;
            _frame.Draw(_document?.Renderer, view, _window.Width, _window.Height, _settings);
        }

        if (_document is not null)
        {
            PrepareInSight(_document, view);
        }

        _drawnFrames++;
        if (_document is not null)
        {
            var detail = (_next is null ? _settings : _moving.Adapt(_settings)).Detail;
            _overlay.Measure(_document.Renderer.Statistics, detail, _clock.Elapsed - start, _drawnFrames, _document.Controls.Depth, _document.Controls.Enlargement);
        }
    }

    private string SaveScreenshot(Document document)
    {
        // What was drawn last is the scene alone; the text is added on the way to the window.
        Draw();
        Directory.CreateDirectory("out");
        var name = Path.GetFileNameWithoutExtension(document.File.Path);
        var output = Enumerable.Range(1, int.MaxValue)
            .Select(number => Path.Combine("out", $"{name}-{number:D3}.png"))
            .First(candidate => !File.Exists(candidate));
        ImageFile.SavePng(_frame.Capture(), output);
        return $"saved {output}";
    }

    private static string SaveScene(Document document)
    {
        var output = Path.ChangeExtension(document.File.Path, ".sdo");
        if (document.File.Kind != FileKind.Scene && File.Exists(output))
        {
            throw new IOException($"{Path.GetFileName(output)} exists already and is another scene: it is not overwritten");
        }

        SaveCommand.Save(document.File, document.SceneNow(), output);
        return $"saved {Path.GetFileName(output)}";
    }

    /// <summary>Does something with files, and says on the screen and the terminal what came of it.</summary>
    private void TrySay(Func<string> act)
    {
        string message;
        try
        {
            message = act();
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            message = $"error: {exception.Message}";
        }

        Console.Error.WriteLine(message);
        _overlay.Say(message, _clock.Elapsed);
        _isWindowStale = true;
    }

    /// <summary>What the window shows.</summary>
    private sealed record Document(LoadedFile File, ScenePreparation Preparation, SceneRenderer Renderer, CameraControls Controls)
    {
        /// <summary>Where the first object stands.</summary>
        public AffineMap Placement => File.Scene.Objects[0].Map;

        /// <summary>The paper's way into a fractal; null where there is not exactly one.</summary>
        public FractalTrail? Trail { get; init; }

        /// <summary>Whether it is taken.</summary>
        public bool UsesTrail { get; set; }

        /// <summary>The scene as it would be saved: with the present camera and projection.</summary>
        public Scene SceneNow() => File.Scene.Scene with
        {
            Camera = Controls.Camera,
            Projection = Controls.Projection,
            OrthographicHeight = Controls.OrthographicHeight,
        };
    }
}
