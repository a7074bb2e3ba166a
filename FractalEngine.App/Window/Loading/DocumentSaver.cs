using FractalEngine.App.Shell;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.Input;
using FractalEngine.App.Window.State;
using FractalEngine.Core;
using FractalEngine.Parsing.Editing;
using FractalEngine.Parsing.Sdo.Merging;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Loading;

/// <summary>Edits the files of the document, and saves them with its view. Asks where another program has changed the same lines.</summary>
internal sealed class DocumentSaver(DocumentLoader loader, PromptHost prompts, Action<string> report)
{
    private WindowState State
    {
        get => loader.State;
        set => loader.State = value;
    }

    /// <summary>Shows another text of a file, as a step that can be undone.</summary>
    /// <param name="path">Full path of the file.</param>
    /// <param name="text">Its text from now on.</param>
    /// <param name="interaction">All edits with the same number are one step; null for a step of its own.</param>
    public void Edit(string path, string text, int? interaction)
    {
        if (loader.Document is { } document)
        {
            Try(() => State = State.Edit(document.UndoView, document.Edits.With(path, text), interaction));
        }
    }

    /// <summary>
    /// Saves the changes of the window into the scene's file. A model that is no scene gets one under a name that is asked for.
    /// </summary>
    /// <param name="proceed">Called once they are saved; null for nothing.</param>
    public void Save(Action? proceed = null) => Save(MergePreference.None, proceed);

    /// <summary>Asks for the name of a new scene file, and saves there.</summary>
    /// <param name="proceed">Called once it is saved; null to show the new file.</param>
    public void SaveAs(Action? proceed = null)
    {
        if (loader.Document is { } document)
        {
            prompts.Open(new TextPrompt(
                "Save as a new scene", PathText.Shorten(NewSceneFile.Propose(document.File.Path)),
                text => TrySaveAs(PathText.Expand(text, ".sdo"), proceed)));
        }
    }

    private void Save(MergePreference preference, Action? proceed)
    {
        if (loader.Document is not { } document)
        {
            return;
        }

        if (State.IsEditLoading)
        {
            // Only what can be opened again is saved.
            report($"saving {Path.GetFileName(document.File.Path)} once its last change is loaded");
            State = State with { AfterLoad = () => Save(preference, proceed) };
        }
        else if (!document.Edits.IsEmpty)
        {
            SaveEdits(document, proceed);
        }
        else if (document.File.Kind != FileKind.Scene)
        {
            SaveAs(proceed);
        }
        else
        {
            Try(() => SaveView(document, preference, proceed));
        }
    }

    private void SaveView(Document document, MergePreference preference, Action? proceed)
    {
        var (view, state) = (document.SceneView, State.Document!);
        var merged = SceneFileMerge.Write(document.File.Path, state.Draft.SavedText, state.Draft.Write(view), preference);
        if (merged.Conflicts.Length > 0)
        {
            AskAboutConflicts(document, merged, proceed);
            return;
        }

        State = State.Saved(state.ViewSaved(merged.Text, view));
        report($"saved {Path.GetFileName(document.File.Path)}");
        proceed?.Invoke();
    }

    private void AskAboutConflicts(Document document, MergedScene merged, Action? proceed) => prompts.Open(new ChoicePrompt(
        $"{Path.GetFileName(document.File.Path)} has changed in the same place",
        merged.Conflicts.SelectMany(static conflict => (string[])
        [
            $"window: {conflict.Mine ?? "(no such line)"}",
            $"file:   {conflict.Theirs ?? "(no such line)"}",
        ]),
        new(Key.K, "keep mine: write the window's line", () => Save(MergePreference.Mine, proceed)),
        new(Key.T, "take theirs: show what the file says", () => Try(() => TakeTheirs(proceed))),
        new(Key.A, "save as another file", () => SaveAs(proceed))));

    /// <summary>Saves what does not conflict, and shows the file's view.</summary>
    private void TakeTheirs(Action? proceed)
    {
        // The file may have been loaded again while the question was open.
        var (view, state) = (loader.Document!.SceneView, State.Document!);
        var merged = SceneFileMerge.Write(state.File.Path, state.Draft.SavedText, state.Draft.Write(view), MergePreference.Theirs);
        State = State.Saved(state with { Draft = state.Draft.Saved(merged.Text, view) }).Reload();
        report($"took the view of {Path.GetFileName(state.File.Path)}");
        proceed?.Invoke();
    }

    /// <summary>Writes the edited texts into their files, and the view with that of the scene.</summary>
    private void SaveEdits(Document document, Action? proceed) => Try(() =>
    {
        try
        {
            foreach (var (path, edited) in document.Edits.Files)
            {
                State = State.Saved(SaveEdit(document, State.Document!, path, edited));
                report($"saved {Path.GetFileName(path)}");
            }
        }
        finally
        {
            // Also where a later file can't be written: those before it are saved.
            State = State.Reload();
        }

        if (document.HasChanges)
        {
            Save(proceed);
        }
        else
        {
            proceed?.Invoke();
        }
    });

    private static DocumentState SaveEdit(Document document, DocumentState state, string path, EditedFile edited)
    {
        if (path != document.File.Path || document.File.Kind != FileKind.Scene)
        {
            EditedFileWriter.Write(path, edited);
            return state.Saved(path, edited.SavedText, edited.Text);
        }

        var (view, draft) = (document.SceneView, state.Draft);
        var isViewWritten = true;
        EditedFileWriter.Write(path, edited, text =>
        {
            // Where an editor has changed the lines of the view, only the numbers are saved, and then the user is asked about the view.
            var withView = draft.TryWriteInto(view, text);
            isViewWritten = withView is not null;
            return withView ?? text;
        });
        if (!isViewWritten)
        {
            return state.Saved(path, edited.SavedText, edited.Text);
        }

        // The view is in the file from now on, so that it is in all texts that an undo returns to.
        var saved = draft.Carry(view, edited.Text);
        return state.Saved(path, edited.SavedText, saved, text => draft.Carry(view, text)) with { Draft = draft.Saved(saved, view) };
    }

    /// <summary>Returns why the scene can't be saved under a name; null if it was saved.</summary>
    private string? TrySaveAs(string path, Action? proceed)
    {
        if (path.Length == 0)
        {
            return "the name is empty";
        }

        if (State.IsEditLoading)
        {
            // A copy without the last change would take it away.
            report($"saving {Path.GetFileName(path)} once the last change is loaded");
            State = State with
            {
                AfterLoad = () =>
                {
                    if (TrySaveAs(path, proceed) is { } reason)
                    {
                        report(reason);
                    }
                },
            };
            return null;
        }

        try
        {
            var document = loader.Document!;
            var scene = document.GetCurrentScene() with { Camera = Document.WithoutNegativeZeros(document.Camera) };
            NewSceneFile.Write(document.File, scene, path, loader.Options.AllowOutsideFiles);
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException or FractalEngineException)
        {
            return exception.Message;
        }

        report($"saved {PathText.Shorten(path)}");
        State = proceed is null ? State.Open(path, continues: true) : State;
        proceed?.Invoke();
        return null;
    }

    private void Try(Action action)
    {
        try
        {
            action();
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException or FractalEngineException)
        {
            report(Failure.Of(exception).Text);
        }
    }
}
