using FractalEngine.App.Window.State;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Editing;
using FractalEngine.Render.Cameras;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.State;

/// <summary>Undoes, saves and reloads of a document, without a window.</summary>
public sealed class DocumentStateTests : IDisposable
{
    private const string CameraLine = "c (0, 0, -8) (0, 0, 0) 60";
    private const string OtherCameraLine = "c (5, 0, -8) (0, 0, 0) 60";
    private const string Text = $"{CameraLine}\no \"cube.obj\" #\n";
    private const string Red = Text + "background (1, 0, 0)\n";
    private const string ProjectionLine = "projection orthographic 7\n";

    private readonly TemporaryFolder _folder = new();
    private readonly string _path;

    public DocumentStateTests()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _path = _folder.Write("scene.sdo", Text);
    }

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Record_WhileAPlayerWalks_IsNoStep()
    {
        var state = Load();
        Assert.Same(state, state.Record(null));
        Assert.Null(state.BeginStep(null, 1).Undo(isRedo: false));
    }

    [Fact]
    public void Undo_OfAnEdit_ReturnsToTheViewAndStaysThere()
    {
        var state = Edited().Record(StepOf(2));
        var undone = state.Undo(isRedo: false)!;
        Assert.Equal((StepOf(1), true, false), (undone.History.Present.Camera, undone.Edits.IsEmpty, undone.FollowsShape));
        var redone = undone.Undo(isRedo: true)!;
        Assert.Equal((StepOf(2), Red), (redone.History.Present.Camera, redone.SceneText(redone.Edits)));
        Assert.Null(redone.Undo(isRedo: true));
        // A view that looks the same is no step.
        Assert.Equal(StepOf(3), redone.WithPresentView(StepOf(3)).Record(StepOf(3)).History.Present.Camera);
    }

    [Fact]
    public void Saved_OfAnEdit_MakesTheTextBeforeItTheEdit()
    {
        var state = Edited() with { ShownEdits = Edited().Edits };
        var saved = state.Record(StepOf(2)).Saved(_path, Text, Red);
        Assert.True(saved.Edits.IsEmpty && saved.ShownEdits.IsEmpty);
        var undone = saved.Undo(isRedo: false)!;
        Assert.Equal(Text, undone.SceneText(undone.Edits));
    }

    [Fact]
    public void ViewSaved_BetweenEdits_IsInTheTextsThatAnUndoReturnsTo()
    {
        var state = Edited().Record(StepOf(2));
        var view = Moved(ViewOf(state.File));
        var saved = state.ViewSaved(Text.Replace(CameraLine, OtherCameraLine, StringComparison.Ordinal), view);
        Assert.False(saved.Draft.IsChanged(view));
        // The edit itself is of the text before the save: the file is loaded again.
        Assert.Equal(Red, saved.SceneText(saved.Edits));
        Assert.Equal(
            Red.Replace(CameraLine, OtherCameraLine, StringComparison.Ordinal), saved.SceneText(saved.History.Present.Edits));
    }

    [Fact]
    public void Forget_OfTheScene_DropsItsEditInAllSteps()
    {
        var state = Edited().Record(StepOf(2)).Forget(_path);
        Assert.True(state.Edits.IsEmpty && state.History.Present.Edits.IsEmpty);
    }

    [Theory]
    [InlineData(false, false, false)]
    [InlineData(true, false, true)]
    [InlineData(false, true, false)]
    [InlineData(true, true, false)]
    public void Continue_OfAFileWithAnotherCamera_FollowsItUnlessTheWindowHasMoved(bool isFileNew, bool isMoved, bool follows)
    {
        var state = Load();
        var file = isFileNew ? Reload(Text.Replace(CameraLine, OtherCameraLine, StringComparison.Ordinal)) : state.File;
        var view = isMoved ? Moved(ViewOf(state.File)) : ViewOf(state.File);
        // By less than the file, so that these are two places.
        view = isMoved ? view with { Camera = view.Camera with { FieldOfView = 50 } } : view;
        var (next, followsCamera, followsProjection) = state.Continue(file, ViewOf(file), view);
        Assert.Equal((follows, false), (followsCamera, followsProjection));
        Assert.Equal(ViewOf(file), next.Draft.LayoutView);
    }

    [Fact]
    public void Continue_OfTheCameraThatTheWindowHasSaved_KeepsItAsItIs()
    {
        var text = Text.Replace(CameraLine, OtherCameraLine, StringComparison.Ordinal);
        var state = Load();
        var view = Moved(ViewOf(state.File));
        var file = Reload(text);
        // As the file has it, to fewer digits than the window.
        var fileView = ViewOf(file) with { Camera = view.Camera with { FieldOfView = 60.000001 } };
        var (next, followsCamera, _) = state.ViewSaved(text, view).Continue(file, fileView, view);
        Assert.False(followsCamera || next.Draft.IsChanged(view));
    }

    [Theory]
    [InlineData(false, true)]
    [InlineData(true, false)]
    public void Continue_OfAFileWithAnotherProjection_FollowsItUnlessTheWindowHasChangedIt(bool isChanged, bool follows)
    {
        var state = Load();
        var file = Reload(Text + ProjectionLine);
        // A move of the camera leaves the projection to the file.
        var view = Moved(ViewOf(state.File)) with { OrthographicHeight = isChanged ? 3 : null };
        var (next, followsCamera, followsProjection) = state.Continue(file, ViewOf(file), view);
        Assert.Equal((false, follows), (followsCamera, followsProjection));
        Assert.Equal(7, next.Draft.LayoutView.OrthographicHeight);
    }

    private static SceneView ViewOf(LoadedFile file) =>
        new(file.Scene.Scene.Camera!, file.Scene.Scene.Projection, file.Scene.Scene.OrthographicHeight);

    private static SceneView Moved(SceneView view) => view with { Camera = view.Camera with { Position = new Vector(5, 0, -8) } };

    private static CameraState StepOf(double x)
    {
        var camera = Camera.Default with { Position = new(x, 0, -8) };
        return new(new(camera, Projection.Perspective, null, 0), camera, 1, null);
    }

    private DocumentState Load()
    {
        var file = AssetLoader.Load(_path);
        return new(new(file, ViewOf(file)), new(new(StepOf(1), FileEdits.None)));
    }

    private LoadedFile Reload(string text)
    {
        _folder.Write("scene.sdo", text);
        return AssetLoader.Load(_path);
    }

    /// <summary>Returns a document with one edit that is no step yet.</summary>
    private DocumentState Edited()
    {
        var state = Load().BeginStep(StepOf(1), null);
        return state with { Edits = state.Edits.With(_path, Red) };
    }
}
