using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.State;
using FractalEngine.Parsing.Sdo.Merging;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App.Window.Loading;

/// <content>Saves what was edited in panels.</content>
internal sealed partial class FileCommands
{
    /// <summary>Writes the edited texts into their files, and the view with that of the scene.</summary>
    private void SaveEdits(Document document, Action? proceed) => Try(() =>
    {
        try
        {
            foreach (var (path, edited) in document.Edits.Files)
            {
                SaveEdit(document, path, edited);
                report($"saved {Path.GetFileName(path)}");
            }
        }
        finally
        {
            // Also where a later file can't be written: those before it are saved.
            loader.Edit(document.Edits, settings());
        }

        if (document.HasChanges)
        {
            Save(MergePreference.None, proceed);
        }
        else
        {
            proceed?.Invoke();
        }
    });

    private void SaveEdit(Document document, string path, EditedFile edited)
    {
        if (path != document.File.Path || document.File.Kind != FileKind.Scene)
        {
            EditedFileWriter.Write(path, edited);
            MarkSaved(document, path, edited, edited.Text);
            return;
        }

        var view = document.SceneView;
        var draft = document.Draft;
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
            MarkSaved(document, path, edited, edited.Text);
            return;
        }

        // The view is in the file from now on, so that it is in all texts that an undo returns to.
        var saved = draft.Carry(view, edited.Text);
        MarkSaved(document, path, edited, saved, text => draft.Carry(view, text));
        draft.MarkSaved(saved, view);
    }

    private void MarkSaved(Document document, string path, EditedFile edited, string saved, Func<string, string>? carry = null)
    {
        document.MarkSaved(path, edited.SavedText, saved, carry);
        loader.MarkSaved(path, edited.SavedText, saved, carry);
    }
}
