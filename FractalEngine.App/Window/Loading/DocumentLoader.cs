using FractalEngine.App.Shell;
using FractalEngine.App.Window.Drawing;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.State;
using FractalEngine.Core;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window.Loading;

/// <summary>
/// Owns the document of a window, and replaces it when another file, or the same one after a change, has been loaded in the background.
/// Progress and errors are shown in the overlay. A file that can't be loaded leaves the document as it is.
/// </summary>
/// <param name="window">The window that shows the document.</param>
/// <param name="area">The part of the window that panels leave free.</param>
/// <param name="overlay">The overlay of the window.</param>
/// <param name="options">The options of the window.</param>
/// <param name="opened">Called with the full path of each file that was opened.</param>
/// <param name="report">Shows a message.</param>
internal sealed partial class DocumentLoader(
    RenderWindow window, ViewArea area, WindowOverlay overlay, WindowOptions options, Action<string> opened, Action<string> report)
    : IDisposable
{
    private readonly FileWatcher? _watcher = options.WatchesFiles ? new(window.Wake) : null;
    private readonly AssetCache _cache = new();
    private string _path = "";
    private FileEdits _edits = FileEdits.None;
    private FileEdits _editsAtStart = FileEdits.None;
    private BackgroundLoad? _load;

    // The file to open after the one that is being loaded, with the edits of the document when the user asked for that.
    private (string Path, bool KeepsState, FileEdits Edits)? _next;
    private bool _needsReload;

    // So many files were saved by now, and when the load in progress began.
    private int _saveCount;
    private int _saveCountAtStart;
    private (string Error, TimeSpan Time)? _pendingFault;

    /// <summary>The document shown; null until the first file is loaded.</summary>
    public Document? Document { get; private set; }

    /// <summary>What the title tells beside the name of the file; null for nothing.</summary>
    public string? TitleNote
    {
        get;
        set
        {
            if (field != value)
            {
                field = value;
                ShowTitle(_path);
            }
        }
    }

    /// <summary>Whether files may refer to others outside their folder.</summary>
    public bool AllowsOutsideFiles => options.Load.AllowOutsideFiles;

    /// <summary>The exit code of the first load.</summary>
    public int ExitCode { get; private set; }

    /// <summary>True while anything is loaded or prepared in the background, so that progress must be shown.</summary>
    public bool IsBusy => _load is not null || _pendingFault is not null || Document?.FirstSightLoader.IsRunning == true;

    /// <summary>Starts to load a file. If another one is being loaded, it comes next.</summary>
    /// <param name="path">Path of the mesh, fractal or scene.</param>
    /// <param name="settings">The present render settings.</param>
    /// <param name="keepsState">True for the same scene under another name: its camera and bodies go on.</param>
    public void Open(string path, RenderSettings settings, bool keepsState = false)
    {
        _next = (path, keepsState, Document?.Edits ?? FileEdits.None);
        StartNext(settings);
    }

    /// <summary>Shows other texts of the files, in the place of those on the disk.</summary>
    /// <param name="edits">The files that are edited and not saved.</param>
    /// <param name="settings">The present render settings.</param>
    public void Edit(FileEdits edits, RenderSettings settings)
    {
        _edits = edits;
        ShowTitle(_path);
        Reload(settings);
    }

    /// <summary>Loads the files of the document again that have changed. Camera and unchanged bodies go on.</summary>
    public void Reload(RenderSettings settings)
    {
        _needsReload = true;
        StartNext(settings);
    }

    /// <summary>Takes over the results that are ready. Must be called on the window's thread.</summary>
    /// <param name="settings">The present render settings.</param>
    /// <param name="now">The present time.</param>
    public Redraw Poll(RenderSettings settings, TimeSpan now)
    {
        if (_watcher?.TakeChange() == true)
        {
            _pendingFault = null;
            Reload(settings);
        }

        return PollLoad(settings, now) | PollFault(settings, now) | PollFirstSight() | PollWaiting();
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _watcher?.Dispose();
        Document?.Dispose();
    }

    /// <summary>Starts the next load, unless one is in progress.</summary>
    private void StartNext(RenderSettings settings)
    {
        if (_load is not null)
        {
            return;
        }

        if (_next is var (path, keepsState, edits))
        {
            _next = null;
            _editsAtStart = edits;
            Start(path, settings, keepsState ? Document : null);
        }
        else if (_needsReload)
        {
            Start(_path, settings, Document);
        }
    }

    private void Start(string path, RenderSettings settings, Document? previous, FileEdits? trial = null)
    {
        _saveCountAtStart = _saveCount;
        if (Document is null)
        {
            _path = path;
            ShowTitle(path);
        }

        _needsReload &= path != _path;
        var edits = FileEdits.None;
        if (trial is not null)
        {
            edits = trial;
        }
        else if (previous is not null)
        {
            edits = _edits.Rebase(report);
            if (!ReferenceEquals(edits, _edits))
            {
                _edits = edits;
                previous.RebaseEdits(edits);
            }
        }

        _startedEdits = edits;
        _load = new(path, options.Load with { EditedTexts = edits.Texts }, settings, area.Aspect, _cache, previous, window.Wake);
    }

    private void ShowTitle(string path)
    {
        var note = TitleNote is { } text ? $", {text}" : "";
        window.Title = $"{Path.GetFileName(path)}{(_edits.IsEmpty ? "" : "*")}{note} - FractalEngine";
    }

    private Redraw PollLoad(RenderSettings settings, TimeSpan now)
    {
        if (_load is not { } load)
        {
            return Redraw.None;
        }

        if (!load.IsCompleted)
        {
            // Loading again goes on behind the scene that is shown.
            overlay.Progress = load.Previous is null ? load.Progress : null;
            return load.Previous is null ? Redraw.Overlay : Redraw.None;
        }

        _load = null;
        overlay.Progress = null;
        var loaded = load.TakeResult(out var exitCode, out var error);
        ExitCode = Document is null ? exitCode : ExitCode;
        var redraw = EndTrial(now, isSuccessful: loaded is not null) is { } ended ? ended
            : IsOutdated(load) ? LoadAgain(load)
            : loaded is not var (file, preparation) ? Refuse(load, error!, now)
            : WasEditedDuring(load) ? KeepEdited(load)
            : Show(load, file, preparation, now);
        StartNext(settings);
        return redraw;
    }

    private Redraw Show(BackgroundLoad load, LoadedFile file, ScenePreparation preparation, TimeSpan now)
    {
        var isSameFile = load.Previous is not null && load.Previous == Document && load.Path == _path;
        var previous = load.Previous == Document ? load.Previous : null;
        Document document;
        try
        {
            // Before anything of the present document is given up: the driver may refuse what is new.
            document = new(window, area, file, preparation, options, previous, previous?.Edits ?? FileEdits.None);
        }
        catch (Exception exception) when (exception is FractalEngineException or OutOfMemoryException)
        {
            return Refuse(load, Failure.Of(exception).Text, now);
        }

        if (previous is null)
        {
            Document?.Dispose();
            _edits = FileEdits.None;
            _needsReload = false;
            _waiting = null;
        }
        else if (!isSameFile && previous.File.Kind == FileKind.Scene)
        {
            // The scene has another file now, which has all that was changed.
            document.ForgetEdits(previous.File.Path);
            _edits = document.Edits;
        }

        var known = previous?.File.Warnings.Select(static warning => warning.ToString()).ToHashSet() ?? [];
        Document = document;
        _path = load.Path;
        _shownEdits = _startedEdits;
        _pendingFault = null;
        overlay.Error = null;
        foreach (var message in file.Warnings.Select(static warning => warning.ToString()).Concat(preparation.Scene.Notices))
        {
            if (known.Add(message))
            {
                Console.Error.WriteLine(message);
            }
        }

        ShowTitle(_path);
        overlay.DescribeFile(file, preparation.Scene);
        _watcher?.Watch(load.Files);
        if (!isSameFile)
        {
            opened(file.Path);
        }

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
            overlay.Error = Failure.Of(exception).Text;
            Console.Error.WriteLine(overlay.Error);
            return Redraw.Overlay;
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
