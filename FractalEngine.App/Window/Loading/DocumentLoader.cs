using FractalEngine.App.Shell;
using FractalEngine.App.Window.Drawing;
using FractalEngine.App.Window.State;
using FractalEngine.Core;
using FractalEngine.Core.Files;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window.Loading;

/// <summary>
/// Does what the <see cref="WindowState"/> asks for: loads files in the background, replaces the document by what was loaded, and shows
/// progress and errors in the overlay. A file that can't be loaded leaves the document as it is.
/// </summary>
/// <param name="window">The window that shows the document.</param>
/// <param name="area">The part of the window that panels leave free.</param>
/// <param name="overlay">The overlay of the window.</param>
/// <param name="options">The options of the window.</param>
/// <param name="opened">Called with the full path of each file that was opened.</param>
/// <param name="report">Shows a message.</param>
/// <param name="settings">Returns the present render settings.</param>
/// <param name="clock">Tells the present time.</param>
/// <param name="first">The load of the first file, which began before there was a window; null for none.</param>
internal sealed class DocumentLoader(
    RenderWindow window, ViewArea area, WindowOverlay overlay, WindowOptions options, Action<string> opened, Action<string> report,
    Func<RenderSettings> settings, Func<TimeSpan> clock, BackgroundLoad? first = null) : IDisposable
{
    private readonly FileWatcher? _watcher = options.WatchesFiles ? new(window.Wake) : null;
    private readonly AssetCache _cache = first?.Cache ?? new();
    private readonly WindowStore _store = new() { State = first is null ? new() : WindowState.Opening(first.Request) };
    private BackgroundLoad? _load = first;

    /// <summary>The state of the window. What it asks for is done by the next <see cref="Poll"/>.</summary>
    public WindowState State
    {
        get => _store.State;
        set => _store.State = value;
    }

    /// <summary>The document shown; null until the first file is loaded.</summary>
    public Document? Document { get; private set; }

    /// <summary>What overrides the files, such as whether they may refer to others outside their folder.</summary>
    public LoadOptions Options => options.Load;

    /// <summary>The exit code of the first load.</summary>
    public int ExitCode { get; private set; }

    /// <summary>True while anything is loaded or prepared in the background, so that progress must be shown.</summary>
    public bool IsBusy => State.IsBusy || Document?.FirstSightLoader.IsRunning == true;

    /// <summary>True while a load is asked for that <see cref="Poll"/> has not begun.</summary>
    public bool IsDue => State.Loading is { } request && !ReferenceEquals(request, _load?.Request);

    /// <summary>Takes over the results that are ready, and begins what the state asks for. Must be called on the window's thread.</summary>
    public Redraw Poll()
    {
        if (_watcher?.TakeChange() == true)
        {
            State = State.FilesChanged();
        }

        var redraw = PollLoad();
        if (!State.IsBusy && Document?.Film?.NeedsLoad == true)
        {
            State = State.Reload();
        }

        State = State.Tick(clock());
        redraw |= FollowState() | PollFirstSight();
        if (State.AfterLoad is { } action && !State.IsEditLoading)
        {
            State = State with { AfterLoad = null };
            action();
            redraw |= Redraw.Overlay;
        }

        return redraw;
    }

    /// <summary>Shows in the title which file is shown, whether it is edited, and how far its trace is.</summary>
    public void ShowTitle()
    {
        var trace = overlay.TraceText is { } text ? $", {text}" : "";
        var name = DisplayText.Escape(Path.GetFileName(State.FilePath));
        window.Title = $"{name}{(State.Edits.IsEmpty ? "" : "*")}{trace} - FractalEngine";
    }

    public void Dispose()
    {
        _watcher?.Dispose();
        Document?.Dispose();
    }

    private Redraw FollowState()
    {
        var effects = State.Effects;
        foreach (var (effect, text) in effects)
        {
            switch (effect)
            {
                case WindowEffect.Print:
                    Console.Error.WriteLine(text);
                    break;
                case WindowEffect.Report:
                    report(text);
                    break;
                case WindowEffect.ShowProblem:
                    overlay.ShowProblem(text, clock());
                    break;
                case WindowEffect.WatchFiles:
                    _watcher?.Watch(_cache.Files);
                    break;
            }
        }

        State = State with { Effects = [] };
        if (IsDue)
        {
            State = State.Started(State.EditsToLoad.Rebase(report));
            var request = State.Loading!;
            var shown = request.Continues ? Document : null;
            _load = new(
                request, options.Load with { FilmTime = shown?.Film?.BeginLoad() }, settings(), area.Aspect, (window.Width, window.Height),
                _cache, shown, window.Wake);
        }

        ShowTitle();
        overlay.Error = State.Error;
        return effects.IsEmpty ? Redraw.None : Redraw.Overlay;
    }

    private Redraw PollLoad()
    {
        if (_load is not { } load)
        {
            return Redraw.None;
        }

        // Loading again goes on behind the scene that is shown.
        var redraw = load.Request.Continues ? Redraw.None : Redraw.Overlay;
        overlay.Progress = load.IsCompleted || load.Request.Continues ? null : load.Progress;
        if (!load.IsCompleted)
        {
            return redraw;
        }

        _load = null;
        var loaded = load.TakeResult(out var failure);
        if (Document is null)
        {
            ExitCode = failure?.ExitCode ?? Shell.ExitCode.Done;
        }

        State = State.Ended(failure?.Text, clock());
        return State.Showing is null ? redraw : Show(loaded!.Value.File, loaded.Value.Preparation);
    }

    private Redraw Show(LoadedFile file, ScenePreparation preparation)
    {
        var request = State.Showing!;
        var previous = request.Continues ? Document : null;
        Document document;
        try
        {
            // Before anything of the present document is given up: the driver may refuse what is new.
            document = new(window, area, file, preparation, options, _store, previous);
        }
        catch (Exception exception) when (exception is FractalEngineException or OutOfMemoryException)
        {
            State = State.Refused(Failure.Of(exception).Text, clock());
            return Redraw.Overlay;
        }

        if (previous is null)
        {
            Document?.Dispose();
        }

        if (!State.IsReload(request))
        {
            opened(file.Path);
        }

        var known = previous?.File.Warnings.Select(static warning => warning.ToString()).ToHashSet() ?? [];
        foreach (var message in file.Warnings.Select(static warning => warning.ToString()).Concat(preparation.Scene.Notices))
        {
            if (known.Add(message))
            {
                Console.Error.WriteLine(message);
            }
        }

        State = State.Shown(document.Begin(previous));
        Document = document;
        overlay.DescribeFile(file, preparation.Scene);
        return Redraw.Scene;
    }

    private Redraw PollFirstSight()
    {
        if (Document is not { FirstSightLoader.IsRunning: true } document)
        {
            return Redraw.None;
        }

        try
        {
            var scene = document.FirstSightLoader.TakeScene();
            overlay.Progress = document.FirstSightLoader.Progress;
            return scene is null ? Redraw.Overlay : ShowPrepared(document, scene);
        }
        catch (Exception exception) when (exception is FractalEngineException or OutOfMemoryException)
        {
            // What was prepared before stays on the screen.
            overlay.Progress = null;
            State = State.Fail(Failure.Of(exception).Text);
            return FollowState();
        }
    }

    private Redraw ShowPrepared(Document document, DrawableScene scene)
    {
        foreach (var notice in scene.Notices.Skip(document.Renderer.Scene.Notices.Length))
        {
            Console.Error.WriteLine(notice);
        }

        document.Renderer.Update(scene);
        overlay.DescribeFile(document.File, scene);
        return Redraw.Scene;
    }
}
