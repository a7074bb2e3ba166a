using System.Collections.Immutable;
using FractalEngine.Parsing.Editing;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Cameras;

namespace FractalEngine.App.Window.State;

/// <summary>
/// All that a window knows of its files: what is shown, edited and saved, what loads, what comes next and what has failed. Immutable: each
/// event returns the state after it, with what the window has to do then.
/// </summary>
internal sealed record WindowState
{
    // A file that is faulty only because it is still being written is mended sooner.
    private static readonly TimeSpan FaultDelay = TimeSpan.FromSeconds(0.2);

    /// <summary>Path of the file shown, or of the first one until that is loaded, as it was opened.</summary>
    public string FilePath { get; init; } = "";

    /// <summary>What the user has changed of the document; null until the first file is shown.</summary>
    public DocumentState? Document { get; init; }

    /// <summary>The load in progress; null for none.</summary>
    public LoadRequest? Loading { get; init; }

    /// <summary>What was loaded, and is to be shown now unless the driver refuses it; null for nothing.</summary>
    public LoadRequest? Showing { get; init; }

    /// <summary>The file to open after the load in progress; null for none.</summary>
    public LoadRequest? Next { get; init; }

    /// <summary>Whether the document is to be loaded again after that.</summary>
    public bool NeedsReload { get; init; }

    /// <summary>Number of times that a file of the document was saved.</summary>
    public int SaveCount { get; init; }

    /// <summary>Why the document can't be loaded again, until that is shown; null for no reason.</summary>
    public LoadFault? Fault { get; init; }

    /// <summary>The error that is shown until a file is; null for none.</summary>
    public string? Error { get; init; }

    /// <summary>Called once the last edit of the scene is loaded. An edit that is refused drops it.</summary>
    public Action? AfterLoad { get; init; }

    /// <summary>What the window has to do, in this order.</summary>
    public ImmutableArray<(WindowEffect Effect, string Text)> Effects { get; init; } = [];

    public FileEdits Edits => Document?.Edits ?? FileEdits.None;

    /// <summary>The edits that the load in progress begins with.</summary>
    public FileEdits EditsToLoad => Loading is { Continues: true, Refused: null } ? Edits : Loading!.Edits;

    /// <summary>True while a load, or its failure, is not shown.</summary>
    public bool IsBusy => Loading is not null || Fault is not null;

    /// <summary>
    /// True until it is known whether the last edit of the scene can be loaded, and until a scene that was saved as another is shown.
    /// </summary>
    public bool IsEditLoading => (Loading is { Continues: true } && !IsReload(Loading)) || Next is { Continues: true }
        || (IsBusy && Document is { HasUnshownEdit: true });

    /// <summary>The state of a window whose first file loads already.</summary>
    public static WindowState Opening(LoadRequest request) => new WindowState().Start(request);

    /// <summary>Asks for a file. If another one is being loaded, it comes next.</summary>
    /// <param name="path">Path of the mesh, fractal or scene.</param>
    /// <param name="continues">True for the same scene under another name: its camera and bodies go on.</param>
    public WindowState Open(string path, bool continues = false) => (this with { Next = new(path, continues, Edits) }).StartNext();

    /// <summary>Loads the files of the document again that have changed. Camera and unchanged bodies go on.</summary>
    public WindowState Reload() => (this with { NeedsReload = true }).StartNext();

    /// <summary>Takes over that files of the document have changed on the disk.</summary>
    public WindowState FilesChanged() => (this with { Fault = null }).Reload();

    /// <summary>Replaces the edits, as a step that can be undone, and loads them.</summary>
    /// <param name="view">The present view; null while a player walks.</param>
    /// <param name="edits">The edits from now on.</param>
    /// <param name="interaction">All moves and edits with the same number are one step; null for a step of its own.</param>
    public WindowState Edit(CameraState? view, FileEdits edits, int? interaction) => (this with
    {
        Document = Document!.BeginStep(view, interaction) with { Edits = edits, FollowsShape = true },
    }).Reload();

    /// <summary>Takes over that a file was saved: what a load has read before may be older than that.</summary>
    public WindowState Saved(DocumentState document) => this with { SaveCount = SaveCount + 1, Document = document };

    /// <summary>Takes over that the load in progress has begun.</summary>
    /// <param name="edits">The edits that it loads, as they are after other programs have changed the files.</param>
    public WindowState Started(FileEdits edits) => this with
    {
        Loading = Loading! with { Edits = edits, SaveCount = SaveCount },
        Document = Loading is { Continues: true, Refused: null } ? Document! with { Edits = edits } : Document,
    };

    /// <summary>Takes over that the load in progress has ended. Its result is the one to show next, or is dropped.</summary>
    /// <param name="error">Why the file can't be loaded; null if it was.</param>
    /// <param name="now">The present time.</param>
    public WindowState Ended(string? error, TimeSpan now)
    {
        var request = Loading!;
        var ended = this with { Loading = null };
        return (request.Refused is { } fault ? ended.TrialEnded(request, fault, error, now) : ended.LoadEnded(request, error, now))
            .StartNext();
    }

    public WindowState Shown(DocumentState document)
    {
        var request = Showing!;
        if (request.Continues && !IsReload(request) && Document!.File.Kind == FileKind.Scene)
        {
            // The scene has another file now, which has all that was changed.
            document = document.Forget(Document.File.Path);
        }

        return (this with
        {
            FilePath = request.Path,
            Document = document with { ShownEdits = request.Edits },
            NeedsReload = NeedsReload && request.Continues,
            AfterLoad = request.Continues ? AfterLoad : null,
            Showing = null,
            Fault = null,
            Error = null,
        }).Tell(WindowEffect.WatchFiles).StartNext();
    }

    /// <summary>Takes over that what was loaded can't be shown.</summary>
    /// <inheritdoc cref="Ended"/>
    public WindowState Refused(string error, TimeSpan now) => (this with { Showing = null }).Refuse(Showing!, error, now).StartNext();

    /// <summary>Shows a reason that has stood for a while, or first tries whether the last edit of the scene is at fault.</summary>
    public WindowState Tick(TimeSpan now)
    {
        // What loads now tells more.
        if (Fault is not { } fault || now < fault.ShownFrom || Loading is not null)
        {
            return this;
        }

        var rest = this with { Fault = null };
        return Document is { } document && document.SceneText(fault.Request.Edits) is { } text
            && text != document.SceneText(document.ShownEdits)
            ? rest.Start(new(FilePath, Continues: true, Edits)
            {
                Edits = Edits.WithEditOf(document.File.Path, document.ShownEdits),
                Refused = fault,
            })
            : rest.ShowError(fault.Error);
    }

    /// <summary>Shows an error that stays until a file is shown.</summary>
    public WindowState Fail(string error) => (this with { Error = error }).Tell(WindowEffect.Print, error);

    public bool IsReload(LoadRequest request) => request.Continues && request.Path == FilePath;

    private WindowState ShowError(string error) => error == Error ? this : Fail(error);

    private WindowState Tell(WindowEffect effect, string text = "") => this with { Effects = Effects.Add((effect, text)) };

    private WindowState StartNext() => Loading is not null || Showing is not null ? this
        : Next is { } next ? (this with { Next = null }).Start(next)
        : NeedsReload ? Start(new(FilePath, Document is not null, Edits))
        : this;

    private WindowState Start(LoadRequest request) => this with
    {
        FilePath = Document is null ? request.Path : FilePath,
        // The same file opened anew has nothing of an edit that is to be loaded, and may yet be refused.
        NeedsReload = NeedsReload && Document is not null && !IsReload(request),
        Loading = request,
    };

    /// <summary>Drops the last edit of the scene if that loads without it, and else shows what is wrong.</summary>
    private WindowState TrialEnded(LoadRequest request, LoadFault fault, string? error, TimeSpan now)
    {
        var refused = Document!.SceneText(fault.Request.Edits)!;
        return error is not null ? ShowError(fault.Error)
            // Another edit was made meanwhile, which is loaded next.
            : Document.SceneText(Edits) != refused ? this
            : (this with { AfterLoad = null, Document = Document.Drop(refused, request.Edits) })
                .Tell(WindowEffect.ShowProblem, fault.Error).LoadEnded(request, null, now);
    }

    private WindowState LoadEnded(LoadRequest request, string? error, TimeSpan now)
    {
        var isReload = IsReload(request);
        if (request.SaveCount != SaveCount && Document is { File.Path: var shown }
            && (request.Continues || Path.GetFullPath(request.Path) == shown))
        {
            // A file of the document was saved meanwhile, and the load may have read an older one.
            return isReload ? this with { NeedsReload = true } : this with { Next = Next ?? request };
        }

        return error is not null ? Refuse(request, error, now)
            : !isReload && Document is not null && !Edits.Equals(request.EditsBefore) ? Tell(WindowEffect.Report, KeptMessage(request))
            : this with { Showing = request };
    }

    /// <summary>Keeps the document, and says why the file can't be loaded: at once, or later if the file may be unfinished.</summary>
    private WindowState Refuse(LoadRequest request, string error, TimeSpan now) =>
        request.Path != FilePath ? Tell(WindowEffect.ShowProblem, error)
        // What is wrong may be mended in any file that the load has come to, or in one that was fine before.
        : (Document is null ? Fail(error) : this with { Fault = new(request, error, now + FaultDelay) }).Tell(WindowEffect.WatchFiles);

    private string KeptMessage(LoadRequest request) =>
        $"{Path.GetFileName(request.Path)} was not opened, since {Path.GetFileName(FilePath)} was changed meanwhile: save that first";
}

/// <summary>Holds the present state of a window.</summary>
internal sealed class WindowStore
{
    /// <summary>The state; each change replaces it.</summary>
    public WindowState State { get; set; } = new();
}

/// <summary>What a window does once when its state has changed.</summary>
internal enum WindowEffect
{
    /// <summary>Writes an error to stderr.</summary>
    Print,

    /// <summary>Writes a message to stderr, and shows it for a few seconds.</summary>
    Report,

    /// <summary>Writes an error to stderr, and shows it for some time over the scene.</summary>
    ShowProblem,

    /// <summary>Watches the files that the load which has just ended has come to.</summary>
    WatchFiles,
}
