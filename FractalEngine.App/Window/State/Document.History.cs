using FractalEngine.App.Cameras;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.Input;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App.Window.State;

/// <content>Edits and views that can be undone, and what goes on when the files are loaded again.</content>
internal sealed partial class Document
{
    private int? _lastInteraction;

    // An undo returns to a view, which the shapes that are loaded on the way to its own must not move.
    private bool _followsShape = true;

    /// <summary>The files that were edited and not saved. After an undo the document must be loaded again.</summary>
    public FileEdits Edits { get; private set; }

    /// <summary>The views and edits that the user can return to.</summary>
    public UndoHistory<WindowState> History { get; private set; }

    /// <summary>Returns to the view before the last change, or makes it again.</summary>
    /// <param name="isRedo">True to make a change again that was undone.</param>
    /// <returns>A message for the user.</returns>
    public string Undo(bool isRedo)
    {
        if (Physics.IsWalking)
        {
            ToggleWalking();
        }

        RecordView();
        if (!(isRedo ? History.TryRedo() : History.TryUndo()))
        {
            return isRedo ? "nothing to redo" : "nothing to undo";
        }

        _followsShape = false;
        CameraControls.ReleaseKeys();
        FlyingCamera.Restore(History.Present.Camera);
        Edits = History.Present.Edits;
        // In a fractal that has been changed since, the same view has another address.
        History.ReplacePresent(State);
        return isRedo ? "redone" : "undone";
    }

    private WindowState State => new(FlyingCamera.State, Edits);

    /// <summary>Replaces the edits, as a step that can be undone.</summary>
    /// <param name="edits">The edits from now on.</param>
    /// <param name="interaction">All edits with the same number are one step; null for a step of its own.</param>
    public void Edit(FileEdits edits, int? interaction)
    {
        if (interaction is null || interaction != _lastInteraction)
        {
            RecordView();
        }

        _lastInteraction = interaction;
        _followsShape = true;
        Edits = edits;
    }

    /// <summary>Takes over that a file was saved, also in all states that an undo returns to.</summary>
    /// <param name="path">Full path of the file.</param>
    /// <param name="before">Text of the file before.</param>
    /// <param name="after">Text of the file now.</param>
    /// <param name="carry">Makes in a text what the save has changed beside the edits; null for nothing.</param>
    public void MarkSaved(string path, string before, string after, Func<string, string>? carry = null)
    {
        Edits = Edits.AfterSave(path, before, after, carry);
        History.Transform(state => state with { Edits = state.Edits.AfterSave(path, before, after, carry) });
    }

    /// <summary>Takes over that the view was saved, also in the texts that an undo returns to.</summary>
    /// <param name="text">Text of the scene's file now.</param>
    /// <param name="view">The view that it contains.</param>
    public void MarkViewSaved(string text, SceneView view)
    {
        var path = File.Path;
        History.Transform(state => state with { Edits = state.Edits.Carry(path, before => Draft.Carry(view, before)) });
        Draft.MarkSaved(text, view);
    }

    /// <summary>Drops the edit of a file that can't be loaded, also in all states that an undo returns to.</summary>
    /// <param name="path">Full path of the file.</param>
    /// <param name="refused">The text that can't be loaded.</param>
    /// <param name="kept">The edits without it.</param>
    public void DropEdit(string path, string refused, FileEdits kept)
    {
        Edits = kept;
        History.Transform(state => state.Edits.Texts.GetValueOrDefault(path) == refused
            ? state with { Edits = state.Edits.WithEditOf(path, kept) } : state);
    }

    /// <summary>Drops the edits of a file that is not shown any more, also in all states that an undo returns to.</summary>
    public void ForgetEdits(string path)
    {
        Edits = Edits.Without(path);
        History.Transform(state => state with { Edits = state.Edits.Without(path) });
    }

    /// <summary>Continues the same edits, as they are after other programs have changed the files.</summary>
    public void RebaseEdits(FileEdits edits) => Edits = edits;

    /// <summary>Makes the present view a step that can be undone, unless it is one already.</summary>
    private void RecordView()
    {
        if (!Physics.IsWalking)
        {
            History.Record(State);
        }
    }

    /// <summary>
    /// Continues the view of the previous document. Camera and projection are each those of the window where it has changed them, and
    /// else those of the file.
    /// </summary>
    private (SceneDraft Draft, UndoHistory<WindowState> History) ContinueView(Document previous)
    {
        var (before, after) = (previous.File.Scene.Scene, File.Scene.Scene);
        var (saved, mine) = (previous.Draft.SavedView, previous.SceneView);
        var fileView = new SceneView(FlyingCamera.Camera, FlyingCamera.Projection, FlyingCamera.OrthographicHeight);
        var followsCamera = before.Camera != after.Camera;
        var followsProjection = !HaveSameProjection(before, after);
        // What the lines of the file stand for. A file without a camera stands for what was framed first.
        var layoutView = previous.Draft.LayoutView;
        if (followsCamera)
        {
            // After a save of the window, the file has the window's own camera, which stays as it is to the last bit.
            followsCamera = after.Camera != mine.Camera;
            layoutView = layoutView with { Camera = followsCamera ? fileView.Camera : mine.Camera };
        }

        layoutView = followsProjection
            ? layoutView with { Projection = fileView.Projection, OrthographicHeight = fileView.OrthographicHeight }
            : layoutView;

        followsCamera &= mine.Camera == saved.Camera;
        followsProjection &= mine with { Camera = saved.Camera } == saved;
        if (followsCamera)
        {
            if (!followsProjection)
            {
                FlyingCamera.SetProjection(mine.Projection, mine.OrthographicHeight);
            }
        }
        else
        {
            FlyingCamera.ContinueFrom(previous.FlyingCamera);
            if (followsProjection)
            {
                FlyingCamera.SetProjection(fileView.Projection, fileView.OrthographicHeight);
            }
        }

        _followsShape = previous._followsShape;
        if (File.Kind == FileKind.Fractal && !Physics.IsWalking && _followsShape)
        {
            FlyingCamera.FollowShape(Area.Aspect);
        }

        CameraControls.ContinueFrom(previous.CameraControls);
        WalkControls.ContinueFrom(previous.WalkControls);
        IsTrailEnabled = Trail is not null && previous.IsTrailEnabled;
        if (previous.State.Equals(previous.History.Present))
        {
            previous.History.ReplacePresent(State);
        }

        return (previous.Draft.Rebase(File, layoutView, mine), previous.History);
    }

    private static bool HaveSameProjection(Scene scene1, Scene scene2) =>
        scene1.Projection == scene2.Projection && scene1.OrthographicHeight.Equals(scene2.OrthographicHeight);
}
