using System.Collections.Immutable;
using FractalEngine.App.Shell;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.Input;
using FractalEngine.App.Window.State;
using FractalEngine.Core;
using FractalEngine.Parsing.Sdo.Merging;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Loading;

/// <summary>Saves and opens files, and closes the window. Asks before anything is lost.</summary>
/// <param name="loader">Loads files, and owns the document.</param>
/// <param name="prompts">Shows the questions.</param>
/// <param name="recent">The files that were opened last.</param>
/// <param name="report">Shows a message.</param>
/// <param name="settings">Returns the present render settings.</param>
/// <param name="close">Closes the window.</param>
internal sealed partial class FileCommands(
    DocumentLoader loader, PromptHost prompts, RecentFiles recent, Action<string> report, Func<RenderSettings> settings, Action close)
{
    /// <summary>
    /// Saves the changes of the window into the scene's file. A model that is no scene gets one under a name that is asked for.
    /// </summary>
    public void Save() => Save(MergePreference.None, null);

    /// <summary>Shows another text of a file, as a step that can be undone.</summary>
    /// <param name="path">Full path of the file.</param>
    /// <param name="text">Its text from now on.</param>
    /// <param name="interaction">All edits with the same number are one step; null for a step of its own.</param>
    public void Edit(string path, string text, int? interaction)
    {
        if (loader.Document is { } document)
        {
            Try(() =>
            {
                document.Edit(document.Edits.With(path, text), interaction);
                loader.Edit(document.Edits, settings());
            });
        }
    }

    /// <summary>Shows the texts of a state that an undo has returned to.</summary>
    public void ShowEdits() => loader.Edit(loader.Document!.Edits, settings());

    /// <summary>Asks for the name of a new scene file, and saves there.</summary>
    public void SaveAs() => SaveAs(null);

    /// <summary>Asks for a file, and opens it. The files that were opened last are suggested first.</summary>
    public void AskForFile() => prompts.Open(new TextPrompt("Open a file", "", TryOpen, SuggestFiles));

    /// <summary>Asks what a new fractal begins with and for its name, writes it, and opens it.</summary>
    /// <param name="created">Called once it is written.</param>
    public void NewFractal(Action created) => AskAboutChanges("Begin a new fractal?", () => prompts.Open(new ChoicePrompt(
        "A new fractal begins as", [],
        [.. FractalTemplate.All.Select(template => new PromptChoice(template.Key, template.Help, () => AskForName(template, created)))])));

    private void AskForName(FractalTemplate template, Action created) => prompts.Open(new TextPrompt(
        "Name of the new fractal", PathText.Shorten(NewFractalFile.Propose(template, Directory.GetCurrentDirectory())), text =>
        {
            var path = PathText.Expand(text);
            path = path.Length > 0 && Path.GetExtension(path).Length == 0 ? path + ".fdo" : path;
            try
            {
                NewFractalFile.Write(template, path);
            }
            catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
            {
                return exception.Message;
            }

            report($"saved {PathText.Shorten(path)}");
            loader.Open(PathText.Shorten(path), settings());
            created();
            return null;
        }));

    /// <summary>Opens another file, after asking about unsaved changes.</summary>
    public void Open(string path) =>
        AskAboutChanges("Open another file?", () => loader.Open(path, settings()));

    /// <summary>Closes the window, after asking about unsaved changes.</summary>
    public void Close() => AskAboutChanges("Close?", close);

    private ImmutableArray<string> SuggestFiles(string text) =>
        text.Length > 0 ? PathCompletion.Suggest(text)
            : [.. recent.Read().Where(File.Exists).Select(PathText.Shorten).Union(PathCompletion.Suggest(""))];

    /// <summary>Returns why a file can't be opened; null if it is being loaded, or the user is asked about unsaved changes first.</summary>
    private string? TryOpen(string text)
    {
        var path = PathText.Expand(text);
        if (!File.Exists(path))
        {
            return Directory.Exists(path) ? $"{text} is a folder" : "there is no such file";
        }

        Open(PathText.Shorten(path));
        return null;
    }

    private void AskAboutChanges(string question, Action proceed)
    {
        if (loader.Document is not { } document || (!document.HasChanges && document.Edits.IsEmpty))
        {
            proceed();
            return;
        }

        if (!document.Edits.IsEmpty)
        {
            var names = string.Join(", ", document.Edits.Files.Keys.Select(Path.GetFileName));
            prompts.Open(new ChoicePrompt(
                question, [$"{names}: changed in the window, and not saved."],
                new(Key.S, "save first", () => Save(MergePreference.None, proceed)), new(Key.D, "discard the changes", proceed)));
            return;
        }

        prompts.Open(new ChoicePrompt(
            question, [$"The view of {Path.GetFileName(document.File.Path)} has changed since it was saved."],
            new(Key.S, "save first", () => Save(MergePreference.None, proceed)), new(Key.D, "discard the changes", proceed)));
    }

    private void Save(MergePreference preference, Action? proceed)
    {
        if (loader.Document is not { } document)
        {
            return;
        }

        if (loader.IsEditLoading)
        {
            // Only what can be opened again is saved.
            report($"saving {Path.GetFileName(document.File.Path)} once its last change is loaded");
            loader.WhenEditIsLoaded(() => Save(preference, proceed));
            return;
        }

        if (!document.Edits.IsEmpty)
        {
            SaveEdits(document, proceed);
            return;
        }

        if (document.File.Kind != FileKind.Scene)
        {
            SaveAs(proceed);
            return;
        }

        var view = document.SceneView;
        Try(() =>
        {
            var merged = SceneFileMerge.Write(document.File.Path, document.Draft.SavedText, document.Draft.Write(view), preference);
            if (merged.Conflicts.Length > 0)
            {
                AskAboutConflicts(document, merged, proceed);
                return;
            }

            loader.MarkSaved();
            document.MarkViewSaved(merged.Text, view);
            report($"saved {Path.GetFileName(document.File.Path)}");
            proceed?.Invoke();
        });
    }

    private void AskAboutConflicts(Document document, MergedScene merged, Action? proceed) => prompts.Open(new ChoicePrompt(
        $"{Path.GetFileName(document.File.Path)} has changed in the same place",
        merged.Conflicts.SelectMany(static conflict => (string[])
        [
            $"window: {conflict.Mine ?? "(no such line)"}",
            $"file:   {conflict.Theirs ?? "(no such line)"}",
        ]),
        new(Key.K, "keep mine: write the window's line", () => Save(MergePreference.Mine, proceed)),
        new(Key.T, "take theirs: show what the file says", () => TakeTheirs(document, proceed)),
        new(Key.A, "save as another file", () => SaveAs(proceed))));

    /// <summary>Saves what does not conflict, and shows the file's view.</summary>
    private void TakeTheirs(Document document, Action? proceed) => Try(() =>
    {
        // The file may have been loaded again while the question was open.
        document = loader.Document ?? document;
        var draft = document.Draft;
        var merged = SceneFileMerge.Write(document.File.Path, draft.SavedText, draft.Write(document.SceneView), MergePreference.Theirs);
        loader.MarkSaved();
        draft.MarkSaved(merged.Text, document.SceneView);
        report($"took the view of {Path.GetFileName(document.File.Path)}");
        loader.Reload(settings());
        proceed?.Invoke();
    });

    private void SaveAs(Action? proceed)
    {
        if (loader.Document is { } document)
        {
            prompts.Open(new TextPrompt(
                "Save as a new scene", PathText.Shorten(NewSceneFile.Propose(document.File.Path)),
                text => TrySaveAs(loader.Document ?? document, PathText.Expand(text), proceed)));
        }
    }

    /// <summary>Returns why the scene can't be saved under a name; null if it was saved.</summary>
    private string? TrySaveAs(Document document, string path, Action? proceed)
    {
        if (path.Length == 0)
        {
            return "the name is empty";
        }

        if (Path.GetExtension(path).Length == 0)
        {
            path += ".sdo";
        }

        if (loader.IsEditLoading)
        {
            // A copy without the last change would take it away.
            report($"saving {Path.GetFileName(path)} once the last change is loaded");
            loader.WhenEditIsLoaded(() =>
            {
                if (TrySaveAs(loader.Document!, path, proceed) is { } reason)
                {
                    report(reason);
                }
            });
            return null;
        }

        try
        {
            var scene = document.GetCurrentScene() with { Camera = Document.WithoutNegativeZeros(document.Camera) };
            NewSceneFile.Write(document.File, scene, path, loader.AllowsOutsideFiles);
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException or FractalEngineException)
        {
            return exception.Message;
        }

        report($"saved {PathText.Shorten(path)}");
        if (proceed is null)
        {
            loader.Open(path, settings(), keepsState: true);
        }

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
