using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.State;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Loading;

/// <content>Edits of a scene that can't be loaded are dropped, and a save waits until it is known whether they can.</content>
internal sealed partial class DocumentLoader
{
    // The edits of the document that is shown, and of the load that was started last.
    private FileEdits _shownEdits = FileEdits.None;
    private FileEdits _startedEdits = FileEdits.None;

    // A load without an edit that was refused, which tells whether it was the edit that failed.
    private (string Text, string Error)? _trial;

    private Action? _waiting;

    /// <summary>
    /// True until it is known whether the last edit of the scene can be loaded, and until a scene that was saved as another is shown.
    /// </summary>
    public bool IsEditLoading => IsChangingPath || ((_load is not null || _pendingFault is not null)
        && Document is { File: { Kind: FileKind.Scene, Path: var path } } && TextIn(_edits, path) != TextIn(_shownEdits, path));

    private bool IsChangingPath => (_load is { Previous: not null } load && load.Path != _path) || _next is (_, true, _);

    /// <summary>Takes over that a file of the document was saved: what a load has read before may be older than that.</summary>
    public void MarkSaved() => _saveCount++;

    /// <summary>Takes over that the edits of a file were saved, which is shown already where they were.</summary>
    /// <inheritdoc cref="FileEdits.AfterSave"/>
    public void MarkSaved(string path, string before, string after, Func<string, string>? carry = null)
    {
        MarkSaved();
        _shownEdits = _shownEdits.AfterSave(path, before, after, carry);
    }

    /// <summary>Calls back once the last edit of the scene is loaded. An edit that is refused drops the call.</summary>
    public void WhenEditIsLoaded(Action action) => _waiting = action;

    private static string? TextIn(FileEdits edits, string path) => edits.Texts.GetValueOrDefault(path);

    /// <summary>
    /// Tells whether the user has changed the present document while another was loading, which would replace it.
    /// </summary>
    private bool WasEditedDuring(BackgroundLoad load) =>
        (load.Previous is null || load.Path != _path) && Document is { } document && !document.Edits.Equals(_editsAtStart);

    private Redraw KeepEdited(BackgroundLoad load)
    {
        report($"{Path.GetFileName(load.Path)} was not opened, since {Path.GetFileName(_path)} was changed meanwhile: save that first");
        return Redraw.Overlay;
    }

    /// <summary>Tells whether a file of the document was saved while it was loaded, so that the load may have read an older one.</summary>
    private bool IsOutdated(BackgroundLoad load) => _saveCountAtStart != _saveCount && Document is { } document
        && (load.Previous is not null || Path.GetFullPath(load.Path) == document.File.Path);

    private Redraw LoadAgain(BackgroundLoad load)
    {
        if (load.Previous is not null && load.Path == _path)
        {
            _needsReload = true;
        }
        else
        {
            _next ??= (load.Path, load.Previous is not null, _editsAtStart);
        }

        return Redraw.None;
    }

    private Redraw PollWaiting()
    {
        if (_waiting is not { } action || IsEditLoading)
        {
            return Redraw.None;
        }

        _waiting = null;
        action();
        return Redraw.Overlay;
    }

    /// <summary>Loads the scene without its last edit, to learn whether that or a file on the disk is at fault.</summary>
    /// <returns>False where the load that failed has no other edit than the document that is shown.</returns>
    private bool TryWithoutEdit(string error, RenderSettings settings)
    {
        if (Document is not { File: { Kind: FileKind.Scene, Path: var path } } document
            || TextIn(_startedEdits, path) is not { } text || text == TextIn(_shownEdits, path))
        {
            return false;
        }

        _trial = (text, error);
        Start(_path, settings, document, _edits.WithEditOf(path, _shownEdits).Rebase(report));
        return true;
    }

    /// <summary>Takes the result of a trial: drops the edit if the scene loads without it, and else shows what is wrong.</summary>
    /// <returns>Null where the load was none, or is to be shown.</returns>
    private Redraw? EndTrial(TimeSpan now, bool isSuccessful)
    {
        if (_trial is not var (text, error))
        {
            return null;
        }

        _trial = null;
        if (!isSuccessful)
        {
            return ShowFault(error);
        }

        var path = Document!.File.Path;
        if (TextIn(_edits, path) != text)
        {
            // Another edit was made meanwhile, which is loaded next.
            return Redraw.None;
        }

        _waiting = null;
        Document.DropEdit(path, text, _edits.WithEditOf(path, _startedEdits));
        _edits = Document.Edits;
        Console.Error.WriteLine(error);
        overlay.ShowProblem(error, now);
        return null;
    }
}
