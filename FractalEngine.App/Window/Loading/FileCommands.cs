using System.Collections.Immutable;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.Input;
using FractalEngine.Parsing.Editing;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Loading;

/// <summary>Opens files, and closes the window. Asks before anything is lost.</summary>
/// <param name="loader">Loads files, and owns the document.</param>
/// <param name="saver">Saves what is not to be lost.</param>
/// <param name="prompts">Shows the questions.</param>
/// <param name="recent">The files that were opened last.</param>
/// <param name="report">Shows a message.</param>
/// <param name="close">Closes the window.</param>
internal sealed class FileCommands(
    DocumentLoader loader, DocumentSaver saver, PromptHost prompts, RecentFiles recent, Action<string> report, Action close)
{
    // Those of a tree, a Sierpinski triangle and cubes.
    private static readonly Key[] TemplateKeys = [Key.T, Key.S, Key.C];

    /// <summary>Asks for a file, and opens it. The files that were opened last are suggested first.</summary>
    public void AskForFile() => prompts.Open(new TextPrompt("Open a file", "", TryOpen, SuggestFiles));

    /// <summary>Asks what a new fractal begins with and for its name, writes it, and opens it.</summary>
    /// <param name="created">Called once it is written.</param>
    public void NewFractal(Action created) => AskAboutChanges("Begin a new fractal?", () => prompts.Open(new ChoicePrompt(
        "A new fractal begins as", [],
        [
            .. FractalTemplate.All.Zip(
                TemplateKeys, (template, key) => new PromptChoice(key, template.Help, () => AskForName(template, created))),
        ])));

    private void AskForName(FractalTemplate template, Action created) => prompts.Open(new TextPrompt(
        "Name of the new fractal", PathText.Shorten(NewFractalFile.Propose(template, Directory.GetCurrentDirectory())), text =>
        {
            var path = PathText.Expand(text, ".fdo");
            try
            {
                NewFractalFile.Write(template, path);
            }
            catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
            {
                return exception.Message;
            }

            report($"saved {PathText.Shorten(path)}");
            loader.State = loader.State.Open(PathText.Shorten(path));
            created();
            return null;
        }));

    /// <summary>Opens another file, after asking about unsaved changes.</summary>
    public void Open(string path) => AskAboutChanges("Open another file?", () => loader.State = loader.State.Open(path));

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

        var names = string.Join(", ", document.Edits.Files.Keys.Select(Path.GetFileName));
        var changes = names.Length > 0 ? $"{names}: changed in the window, and not saved."
            : $"The view of {Path.GetFileName(document.File.Path)} has changed since it was saved.";
        prompts.Open(new ChoicePrompt(
            question, [changes],
            new(Key.S, "save first", () => saver.Save(proceed)), new(Key.D, "discard the changes", proceed)));
    }
}
