using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Editing;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Cameras;

namespace FractalEngine.App.Window.State;

/// <summary>What the user has changed of the document that is shown, and can undo and save. Immutable.</summary>
/// <param name="Draft">What the window has changed of the scene's view.</param>
/// <param name="History">The views and edits that the user can return to.</param>
internal sealed record DocumentState(SceneDraft Draft, UndoHistory<UndoStep> History)
{
    public LoadedFile File => Draft.File;

    public FileEdits Edits { get; init; } = FileEdits.None;

    /// <summary>The edits that are in the scene that is shown, which is loaded later than they are made.</summary>
    public FileEdits ShownEdits { get; init; } = FileEdits.None;

    /// <summary>Number of the last interaction: all its moves and edits are one step.</summary>
    public int? Interaction { get; init; }

    /// <summary>
    /// Whether the camera follows the shape of a fractal. An undo returns to a view, which the shapes that are loaded on the way to its own
    /// must not move.
    /// </summary>
    public bool FollowsShape { get; init; } = true;

    /// <summary>Whether the scene is shown without its last edit.</summary>
    public bool HasUnshownEdit => SceneText(Edits) != SceneText(ShownEdits);

    /// <summary>Returns the text of the scene in edits; null where that is not edited, or the file is no scene.</summary>
    public string? SceneText(FileEdits edits) => File.Kind == FileKind.Scene ? edits.Texts.GetValueOrDefault(File.Path) : null;

    /// <summary>Makes a view a step that can be undone, unless it is one already.</summary>
    /// <param name="view">The present view; null while a player walks.</param>
    public DocumentState Record(CameraState? view) => view is null ? this : this with { History = History.Record(new(view, Edits)) };

    /// <summary>Begins a move or an edit.</summary>
    /// <param name="view">The present view; null while a player walks.</param>
    /// <param name="interaction">All moves and edits with the same number are one step; null for a step of its own.</param>
    public DocumentState BeginStep(CameraState? view, int? interaction) =>
        (interaction is null || interaction != Interaction ? Record(view) : this) with { Interaction = interaction };

    /// <summary>Returns to the step before the present one, or to the one after it. Null where there is none.</summary>
    public DocumentState? Undo(bool isRedo) => (isRedo ? History.Redo() : History.Undo()) is not { } history ? null
        : this with { History = history, Edits = history.Present.Edits, FollowsShape = false };

    /// <summary>Replaces the view of the present step by one that looks the same.</summary>
    public DocumentState WithPresentView(CameraState view) => this with { History = History with { Present = new(view, Edits) } };

    /// <summary>Takes over that a file was saved, also in all steps that an undo returns to.</summary>
    /// <inheritdoc cref="FileEdits.AfterSave"/>
    public DocumentState Saved(string path, string before, string after, Func<string, string>? carry = null)
    {
        FileEdits AfterSave(FileEdits edits) => edits.AfterSave(path, before, after, carry);
        return InHistory(AfterSave) with { Edits = AfterSave(Edits), ShownEdits = AfterSave(ShownEdits) };
    }

    /// <summary>Takes over that the view was saved, also in the texts that an undo returns to.</summary>
    public DocumentState ViewSaved(string text, SceneView view) =>
        InHistory(edits => edits.Carry(File.Path, before => Draft.Carry(view, before))) with { Draft = Draft.Saved(text, view) };

    /// <summary>Drops the edit of the scene that can't be loaded, also in all steps that an undo returns to.</summary>
    public DocumentState Drop(string refused, FileEdits loaded)
    {
        var kept = Edits.WithEditOf(File.Path, loaded);
        return InHistory(edits => SceneText(edits) == refused ? edits.WithEditOf(File.Path, kept) : edits) with { Edits = kept };
    }

    /// <summary>Drops the edits of a file that is not shown any more, also in all steps that an undo returns to.</summary>
    public DocumentState Forget(string path) => InHistory(edits => edits.Without(path)) with { Edits = Edits.Without(path) };

    /// <summary>
    /// Continues with the document as it was loaded again. Camera and projection are each those of the window where it has changed them,
    /// and else those of the file.
    /// </summary>
    /// <param name="file">The file as it is now.</param>
    /// <param name="fileView">The view that it has.</param>
    /// <param name="view">The view that the window has shown before.</param>
    /// <returns>The state, and whether the camera and the projection of the file replace those of the window.</returns>
    public (DocumentState State, bool FollowsCamera, bool FollowsProjection) Continue(LoadedFile file, SceneView fileView, SceneView view)
    {
        var (before, after, saved) = (File.Scene.Scene, file.Scene.Scene, Draft.SavedView);
        var isCameraNew = before.Camera != after.Camera;
        var isProjectionNew =
            !(before.Projection, before.OrthographicHeight).Equals((after.Projection, after.OrthographicHeight));
        // What the lines of the file stand for. A file without a camera stands for what was framed first.
        var layoutView = Draft.LayoutView;
        if (isCameraNew)
        {
            // After a save of the window, the file has the window's own camera, which stays as it is to the last bit.
            isCameraNew = after.Camera != view.Camera;
            layoutView = layoutView with { Camera = isCameraNew ? fileView.Camera : view.Camera };
        }

        layoutView = isProjectionNew ? fileView with { Camera = layoutView.Camera } : layoutView;
        return (this with { Draft = Draft.Rebase(file, layoutView, view) }, isCameraNew && view.Camera == saved.Camera,
            isProjectionNew && view with { Camera = saved.Camera } == saved);
    }

    private DocumentState InHistory(Func<FileEdits, FileEdits> change) =>
        this with { History = History.Transform(step => step with { Edits = change(step.Edits) }) };
}

/// <summary>What an undo returns to: the view, and the texts of the files.</summary>
internal sealed record UndoStep(CameraState Camera, FileEdits Edits);
