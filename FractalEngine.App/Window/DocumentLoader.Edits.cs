using FractalEngine.App.Window.Editing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;

namespace FractalEngine.App.Window;

/// <content>Edits of a scene that can't be loaded are dropped, and a save waits until it is known whether they can.</content>
internal sealed partial class DocumentLoader
{
    // The edits of the document that is shown, and of the load that was started last.
    private FileEdits _shownEdits = FileEdits.None;
    private FileEdits _startedEdits = FileEdits.None;

    // A load without an edit that was refused, which tells whether it was the edit that failed.
    private (string Text, string Error)? _trial;

    private Action? _waiting;

    /// <summary>True until it is known whether the last edit of the scene can be loaded.</summary>
    public bool IsEditLoading => (_load?.Previous is not null || _pendingFault is not null)
        && Document is { File: { Kind: FileKind.Scene, Path: var path } }
        && TextIn(_edits, path) is { } text && text != TextIn(_shownEdits, path);

    /// <summary>Calls back once the last edit of the scene is loaded. An edit that is refused drops the call.</summary>
    public void WhenEditIsLoaded(Action action) => _waiting = action;

    private static string? TextIn(FileEdits edits, string path) => edits.Texts.GetValueOrDefault(path);

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
