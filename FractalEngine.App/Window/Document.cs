using FractalEngine.App.Window.Editing;
using FractalEngine.App.Window.Tools;
using FractalEngine.App.Window.Selecting;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>The file that a window shows, with its camera, its physics and its renderer.</summary>
internal sealed class Document : IDisposable
{
    private int? _lastInteraction;

    /// <summary>Uploads the prepared models. Must be called on the window's thread.</summary>
    /// <param name="window">The window that shows the file.</param>
    /// <param name="area">The part of the window that panels leave free.</param>
    /// <param name="file">The loaded file.</param>
    /// <param name="preparation">The preparation of the file's scene, with the visible models prepared.</param>
    /// <param name="options">The options of the window.</param>
    /// <param name="previous">
    /// The same document before its files were changed, which is replaced by this one; null for none. Its renderer is used further.
    /// </param>
    /// <param name="edits">The files that were edited and not saved; null for none.</param>
    public Document(
        RenderWindow window, ViewArea area, LoadedFile file, ScenePreparation preparation, WindowOptions options,
        Document? previous = null, FileEdits? edits = null)
    {
        File = file;
        Area = area;
        IsReload = previous is not null;
        Edits = edits ?? FileEdits.None;
        Tool = new(this);
        Section = previous?.Section ?? new(options.Section);
        FirstSightLoader = new(preparation, window.Wake);
        var scene = file.Scene.Scene;
        var camera = View.Of(file.Scene, area.Aspect).Camera;
        FlyingCamera = new(
            file.Scene.Bounds, camera, options.Projection ?? scene.Projection, scene.OrthographicHeight, FindFractal(preparation.Scene),
            file.Scene);
        CameraControls = new(FlyingCamera);
        Trail = file.Scene.Objects is [{ Model: FractalModel { Fractal: var fractal } }] ? new(fractal, options.TrailLength) : null;
        Physics = new(file.Scene, window.Wake, previous?.Physics, alwaysBuild: !options.Settings.LazyLoading);
        if (previous is null)
        {
            Renderer = new(window, preparation.Scene);
            Draft = new(file, SceneView);
            History = new(State);
        }
        else
        {
            previous.FirstSightLoader.Dispose();
            Renderer = previous.Renderer;
            Renderer.Replace(preparation.Scene);
            // Until the first frame, which shows nearly the same: handles that are dragged need a view.
            LatestView = previous.LatestView;
            // A drag goes on, and stays one step.
            _lastInteraction = previous._lastInteraction;
            (Draft, History) = ContinueView(previous);
            Tool.ContinueFrom(previous.Tool);
        }
    }

    /// <summary>The loaded file with its scene.</summary>
    public LoadedFile File { get; }

    /// <summary>The part of the window that panels leave free.</summary>
    public ViewArea Area { get; }

    /// <summary>Whether this replaces the same document before its files were changed.</summary>
    public bool IsReload { get; }

    /// <summary>The renderer of the scene.</summary>
    public SceneRenderer Renderer { get; }

    /// <summary>The loader that prepares models when they first become visible.</summary>
    public FirstSightLoader FirstSightLoader { get; }

    /// <summary>The bodies of the scene and the player.</summary>
    public ScenePhysics Physics { get; }

    /// <summary>The camera while no player walks.</summary>
    public FlyingCamera FlyingCamera { get; }

    /// <summary>The controls of the flying camera.</summary>
    public CameraControls CameraControls { get; }

    /// <summary>The controls of the player.</summary>
    public WalkControls WalkControls { get; } = new();

    /// <summary>Selects and measures what is clicked.</summary>
    public SelectionTool Tool { get; }

    /// <summary>The plane that cuts the scene open.</summary>
    public SectionTool Section { get; private set; }

    /// <summary>The paper's zoom into the fractal; null unless the scene is one fractal.</summary>
    public FractalTrail? Trail { get; }

    /// <summary>What the window has changed of the scene.</summary>
    public SceneDraft Draft { get; }

    /// <summary>The files that were edited and not saved. After an undo the document must be loaded again.</summary>
    public FileEdits Edits { get; private set; }

    /// <summary>The views and edits that the user can return to.</summary>
    public UndoHistory<WindowState> History { get; private set; }

    /// <summary>The part of the scene that the window changes, as it is now.</summary>
    public SceneView SceneView => new(Camera, FlyingCamera.Projection, FlyingCamera.OrthographicHeight);

    /// <summary>True when the view differs from the one that was loaded or saved.</summary>
    public bool HasChanges => Draft.IsChanged(SceneView);

    /// <summary>The view of the last frame; null before the first.</summary>
    public View? LatestView { get; private set; }

    /// <summary>Whether the paper's zoom replaces that of the engine.</summary>
    public bool IsTrailEnabled { get; private set; }

    /// <summary>True while the camera or a body moves.</summary>
    public bool IsMoving => Physics.IsRunning || (!Physics.IsWalking && CameraControls.IsMoving);

    /// <summary>The present camera in world space: the flying one, or the one at the player's eyes.</summary>
    public Camera Camera => Physics is { IsWalking: true, Character: { } controller }
        ? WalkControls.EyeCamera(controller, Physics.InterpolationAlpha)
        : FlyingCamera.Camera;

    /// <summary>Number of levels of the fractal that the present view is in; 0 outside, and for views that show the whole.</summary>
    public int VisibleDepth =>
        Physics.IsWalking || IsTrailEnabled || FlyingCamera.Projection != Projection.Perspective ? 0 : FlyingCamera.Depth;

    /// <summary>Switches between the paper's zoom into the fractal and that of the engine.</summary>
    public void ToggleTrail()
    {
        IsTrailEnabled = Trail is not null && !IsTrailEnabled;
        Renderer.Move(0, File.Scene.Objects[0].ObjectToWorld);
    }

    /// <summary>Moves what is drawn to its present place, and returns the view of the present camera.</summary>
    /// <remarks>Bodies move to their interpolated positions, and the fractal to that of the paper's zoom where it is enabled.</remarks>
    /// <param name="aspect">Width divided by height of the frame.</param>
    /// <param name="isBesidePanels">False for a view in the middle of the frame, as if there were no panels.</param>
    public View UpdateView(double aspect, bool isBesidePanels = true) => LatestView = ComputeView(aspect, isBesidePanels);

    private View ComputeView(double aspect, bool isBesidePanels)
    {
        Physics.ApplyTo(Renderer);
        Tool.Measure.Follow(Physics.CurrentScene, Physics.IsRunning);
        var view = View.Of(File.Scene with { Scene = GetCurrentScene() }, aspect) with
        {
            Section = Section.Shown,
            HorizontalShift = isBesidePanels ? Area.HorizontalShift : 0,
        };
        AddLines(view);
        if (Physics.IsWalking)
        {
            return view;
        }

        if (!IsTrailEnabled)
        {
            return FlyingCamera.WithDeepZoom(view);
        }

        Renderer.Move(0, Trail!.Update(File.Scene.Objects[0].ObjectToWorld, view.Camera.Position));
        return view;
    }

    /// <summary>Adds the lines of what is selected and measured to those of the bodies, in the frame of the view.</summary>
    private void AddLines(View view)
    {
        var lines = Tool.WorldLines();
        Section.AddLines(File.Scene.Bounds, lines);
        TransformHandles.AddLines(this, view, lines);
        lines.AddRange(Renderer.Lines);
        if (VisibleDepth > 0 && MapToDrawnFrame(null) is { } map)
        {
            lines = lines.ConvertAll(line => line with { From = map(line.From), To = map(line.To) });
        }

        Tool.AddDrawnLines(lines);
        if (lines.Count > 0 || Renderer.Lines.Count > 0)
        {
            Renderer.Lines = lines;
        }
    }

    /// <summary>Returns the map from points of the world, or about another camera in the fractal, to the frame that is drawn.</summary>
    /// <param name="viewpoint">Address of that other camera, in whose unit the points are; null for points in world space.</param>
    /// <returns>Null where a double can't tell both places.</returns>
    public Func<Vector, Vector>? MapToDrawnFrame(FractalAddress? viewpoint) =>
        FlyingCamera.MapToDrawnFrame(viewpoint, isDeep: VisibleDepth > 0);

    /// <summary>Passes an event to the controls of the player or the camera.</summary>
    /// <param name="windowEvent">Any event of the window.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    /// <returns>True when the view has changed.</returns>
    public bool Handle(WindowEvent windowEvent, int width, int height)
    {
        CameraControls.Viewport = LatestView?.Viewport(width, height);
        if (windowEvent is KeyPressed { IsRepeat: false } or MousePressed or WheelTurned)
        {
            // A key, a drag and a turn of the wheel each begin a step that can be undone.
            RecordView();
        }

        return Physics.IsWalking
            ? WalkControls.Handle(windowEvent, Physics.Character!)
            : CameraControls.Handle(windowEvent, Area.Aspect);
    }

    /// <summary>Moves the flying camera by one command. Nothing happens while a player walks.</summary>
    /// <param name="move">Takes the camera, and the width of the frame divided by its height.</param>
    /// <param name="aspect">Width divided by height of the frame.</param>
    /// <param name="interaction">All moves with the same number are one step that can be undone; null for a step of its own.</param>
    public void MoveCamera(Action<FlyingCamera, double> move, double aspect, int? interaction = null)
    {
        if (!Physics.IsWalking)
        {
            if (interaction is null || interaction != _lastInteraction)
            {
                RecordView();
            }

            _lastInteraction = interaction;
            move(FlyingCamera, aspect);
        }
    }

    /// <summary>Drops a ball where the camera looks.</summary>
    /// <returns>A message for the user.</returns>
    public string DropBall() =>
        VisibleDepth > 0 ? "a ball is too large for this depth: zoom out first" : Physics.DropSphere(Camera);

    /// <summary>Throws a ball from the camera.</summary>
    /// <returns>A message for the user.</returns>
    public string ThrowBall() =>
        VisibleDepth > 0 ? "a ball is too large for this depth: zoom out first" : Physics.ThrowSphere(Camera);

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
        Edits = edits;
    }

    /// <summary>Takes over that a file was saved, also in all states that an undo returns to.</summary>
    /// <param name="path">Full path of the file.</param>
    /// <param name="before">Text of the file before.</param>
    /// <param name="after">Text of the file now.</param>
    public void MarkSaved(string path, string before, string after)
    {
        Edits = Edits.AfterSave(path, before, after);
        History.Transform(state => state with { Edits = state.Edits.AfterSave(path, before, after) });
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

    /// <summary>Releases all keys that are held.</summary>
    public void ReleaseKeys()
    {
        CameraControls.ReleaseKeys();
        WalkControls.ReleaseKeys();
    }

    /// <summary>Advances bodies and camera by a time.</summary>
    /// <returns>True when the view may have changed.</returns>
    public bool Advance(TimeSpan time)
    {
        var mayHaveMoved = Physics.Advance(time);
        return (!Physics.IsWalking && CameraControls.Advance(time)) || mayHaveMoved;
    }

    /// <summary>Starts walking in the direction of the camera, or continues flying from the player's eyes.</summary>
    /// <returns>A message for the user.</returns>
    public string ToggleWalking()
    {
        // A walk may end anywhere, so the view before it is a step that can be undone.
        RecordView();
        var camera = Camera;
        var wasWalking = Physics.IsWalking;
        var message = Physics.ToggleWalking(camera);
        if (Physics.IsWalking)
        {
            WalkControls.ReleaseKeys();
            WalkControls.Direction = camera;
        }
        else if (wasWalking)
        {
            CameraControls.ReleaseKeys();
            FlyingCamera.MoveTo(camera);
        }

        return message;
    }

    /// <summary>Returns the scene as it would be saved, with the present camera and projection.</summary>
    public Scene GetCurrentScene() => File.Scene.Scene with
    {
        Camera = Camera,
        Projection = FlyingCamera.Projection,
        OrthographicHeight = FlyingCamera.OrthographicHeight,
    };

    /// <inheritdoc/>
    public void Dispose()
    {
        FirstSightLoader.Dispose();
        Physics.Dispose();
        Renderer.Dispose();
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

        if (File.Kind == FileKind.Fractal && !Physics.IsWalking)
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

    /// <summary>Finds the fractal that the camera can enter: the only object of the scene, if that is a fractal.</summary>
    private static FractalLocation? FindFractal(DrawableScene drawable)
    {
        if (drawable.Source.Objects is not [{ Model: FractalModel, ObjectToWorld: var objectToWorld }])
        {
            return null;
        }

        return drawable.Objects[0].Model.LodHierarchy is { } hierarchy ? new(0, hierarchy, objectToWorld) : null;
    }
}
