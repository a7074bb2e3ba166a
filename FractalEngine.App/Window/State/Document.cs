using FractalEngine.App.Window.Input;
using FractalEngine.App.Window.Simulation;
using FractalEngine.App.Window.Tools;
using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Editing;
using FractalEngine.Parsing.Text;
using FractalEngine.Render;
using FractalEngine.Render.Cameras;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using FractalEngine.Render.Windowing.Events;

namespace FractalEngine.App.Window.State;

/// <summary>
/// The file that a window shows, with its camera, its physics and its renderer. What was changed of it is in the
/// <see cref="DocumentState"/>.
/// </summary>
internal sealed class Document : IDisposable
{
    private readonly WindowStore _store;

    // The view that the film has set last; null for none.
    private CameraState? _filmView;

    /// <summary>Uploads the prepared models. Must be called on the window's thread.</summary>
    /// <param name="window">The window that shows the file.</param>
    /// <param name="area">The part of the window that panels leave free.</param>
    /// <param name="file">The loaded file.</param>
    /// <param name="preparation">The preparation of the file's scene, with the visible models prepared.</param>
    /// <param name="options">The options of the window.</param>
    /// <param name="store">The state of the window.</param>
    /// <param name="previous">
    /// The same document before its files were changed, which is replaced by this one; null for none. Its renderer is used further.
    /// </param>
    public Document(
        RenderWindow window, ViewArea area, LoadedFile file, ScenePreparation preparation, WindowOptions options, WindowStore store,
        Document? previous = null)
    {
        File = file;
        Area = area;
        IsReload = previous is not null;
        _store = store;
        Tool = previous?.Tool ?? new(this);
        Section = previous?.Section ?? new(options.Section);
        FirstSightLoader = new(preparation, window.Wake);
        var scene = file.Scene.Scene;
        var camera = View.Of(file.Scene, area.Aspect).Camera;
        FlyingCamera = new(
            file.Scene.Bounds, camera, options.Projection ?? scene.Projection, scene.OrthographicHeight, preparation.Scene.SingleFractal,
            file.Scene, scene.Camera is null ? area.Aspect : null);
        Trail = file.Scene.Objects is [{ Model: FractalModel { Fractal: { Description.Parts.IsEmpty: true } fractal } }]
            ? new(fractal, options.TrailLength) : null;
        // Before anything of the previous document ends, since the driver may refuse the new one.
        previous?.Renderer.Replace(preparation.Scene);
        Renderer = previous?.Renderer ?? new(window, preparation.Scene);
        Physics = new(file.Scene, window.Wake, previous?.Physics, alwaysBuild: !options.Settings.LazyLoading);
        if (scene.Film is { } film)
        {
            Film = new(film, scene.Handedness, previous?.Film);
            // Bodies begin with the film.
            Physics.IsPaused |= previous is null;
        }

        CameraControls = previous?.CameraControls ?? new(FlyingCamera);
        WalkControls = previous?.WalkControls ?? new();
        // Until the first frame, which shows nearly the same: handles that are dragged need a view.
        LatestView = previous?.LatestView;
        previous?.FirstSightLoader.Dispose();
    }

    public LoadedFile File { get; }

    /// <summary>The part of the window that panels leave free.</summary>
    public ViewArea Area { get; }

    /// <summary>Whether this replaces the same document before its files were changed.</summary>
    public bool IsReload { get; }

    public SceneRenderer Renderer { get; }

    /// <summary>The loader that prepares models when they first become visible.</summary>
    public FirstSightLoader FirstSightLoader { get; }

    public ScenePhysics Physics { get; }

    /// <summary>The film of the scene; null for none.</summary>
    public FilmPlayer? Film { get; }

    /// <summary>The camera while no player walks.</summary>
    public FlyingCamera FlyingCamera { get; }

    public CameraControls CameraControls { get; }

    public WalkControls WalkControls { get; }

    /// <summary>Selects and measures what is clicked.</summary>
    public SelectionTool Tool { get; }

    /// <summary>The plane that cuts the scene open.</summary>
    public SectionTool Section { get; }

    /// <summary>The paper's zoom into the fractal; null unless the scene is one fractal.</summary>
    public FractalTrail? Trail { get; }

    public FileEdits Edits => State.Edits;

    /// <summary>The view of the last frame; null before the first.</summary>
    public View? LatestView { get; private set; }

    /// <summary>The view that an undo returns to; null while a player walks.</summary>
    public CameraState? UndoView => Physics.IsWalking ? null : FlyingCamera.State;

    /// <summary>The part of the scene that the window changes, as it is now.</summary>
    public SceneView SceneView => new(WithoutNegativeZeros(Camera), FlyingCamera.Projection, FlyingCamera.OrthographicHeight);

    /// <summary>True when the view differs from the one that was loaded or saved, and is not that of the film.</summary>
    public bool HasChanges => !ShowsFilm && State.Draft.IsChanged(SceneView);

    /// <summary>Whether the paper's zoom replaces that of the engine.</summary>
    public bool IsTrailEnabled { get; private set; }

    /// <summary>True while the film, the camera or a body moves.</summary>
    public bool IsMoving => IsPlaying || (!Physics.IsWalking && CameraControls.IsMoving);

    /// <summary>True while a film plays or bodies move.</summary>
    public bool IsPlaying => Film is { IsPlaying: true } || Physics.IsRunning;

    /// <summary>The present camera in world space: the flying one, or the one at the player's eyes.</summary>
    public Camera Camera => Physics is { IsWalking: true, Character: { } controller }
        ? WalkControls.EyeCamera(controller, Physics.InterpolationAlpha)
        : FlyingCamera.Camera;

    /// <summary>Number of levels of the fractal that the present view is in; 0 outside, and for views that show the whole.</summary>
    public int VisibleDepth =>
        Physics.IsWalking || IsTrailEnabled || FlyingCamera.Projection != Projection.Perspective ? 0 : FlyingCamera.Depth;

    /// <summary>Whether nobody has moved the camera since the film has.</summary>
    private bool ShowsFilm => _filmView?.Equals(FlyingCamera.State) == true;

    private DocumentState State
    {
        get => _store.State.Document!;
        set => _store.State = _store.State with { Document = value };
    }

    /// <summary>Begins with the view of the file, or continues that of the previous document.</summary>
    /// <param name="previous">The same document before its files were changed; null for none.</param>
    /// <returns>The state of the document.</returns>
    public DocumentState Begin(Document? previous)
    {
        if (previous is null)
        {
            return new(new(File, SceneView), new(new(FlyingCamera.State, FileEdits.None)));
        }

        var (view, viewBefore) = (previous.SceneView, previous.FlyingCamera.State);
        var fileView = new SceneView(FlyingCamera.Camera, FlyingCamera.Projection, FlyingCamera.OrthographicHeight);
        var (state, followsCamera, followsProjection) = State.Continue(File, fileView, view);
        if (!followsCamera)
        {
            FlyingCamera.Restore(viewBefore);
        }

        var projectionView = followsProjection ? fileView : view;
        FlyingCamera.SetProjection(projectionView.Projection, projectionView.OrthographicHeight);
        if (previous.ShowsFilm && Film is { } film)
        {
            FollowFilm(film);
        }

        if (File.Kind == FileKind.Fractal && !Physics.IsWalking && state.FollowsShape)
        {
            FlyingCamera.FollowShape(Area.Aspect);
        }

        CameraControls.Camera = FlyingCamera;
        IsTrailEnabled = Trail is not null && previous.IsTrailEnabled;
        Tool.ContinueIn(this);
        return new UndoStep(viewBefore, state.Edits).Equals(state.History.Present) ? state.WithPresentView(FlyingCamera.State) : state;
    }

    /// <summary>Returns to the view before the last change, or makes it again. Edits of files must be loaded then.</summary>
    /// <param name="isRedo">True to make a change again that was undone.</param>
    /// <returns>A message for the user.</returns>
    public string Undo(bool isRedo)
    {
        if (Physics.IsWalking)
        {
            ToggleWalking();
        }

        State = State.Record(UndoView);
        if (State.Undo(isRedo) is not { } undone)
        {
            return isRedo ? "nothing to redo" : "nothing to undo";
        }

        CameraControls.ReleaseKeys();
        FlyingCamera.Restore(undone.History.Present.Camera);
        // In a fractal that has been changed since, the same view has another address.
        State = undone.WithPresentView(FlyingCamera.State);
        return isRedo ? "redone" : "undone";
    }

    /// <summary>Switches between the paper's zoom into the fractal and that of the engine.</summary>
    public void ToggleTrail()
    {
        IsTrailEnabled = Trail is not null && !IsTrailEnabled;
        Renderer.Move(0, File.Scene.Objects[0].ObjectToWorld);
    }

    /// <summary>Passes an event to the controls of the player or the camera.</summary>
    /// <param name="windowEvent">Any event of the window.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    /// <param name="move">Moves the flying camera where the event is a key of such an action; null for other events.</param>
    /// <returns>True when the view has changed.</returns>
    public bool Handle(WindowEvent windowEvent, int width, int height, Action<FlyingCamera, double>? move)
    {
        CameraControls.Viewport = LatestView?.Viewport(width, height);
        if (windowEvent is KeyPressed { IsRepeat: false } or MousePressed or WheelTurned)
        {
            // A key, a drag and a turn of the wheel each begin a step that can be undone.
            State = State.Record(UndoView);
        }

        return Physics.IsWalking
            ? WalkControls.Handle(windowEvent, Physics.Character!)
            : CameraControls.Handle(windowEvent, Area.Aspect, move);
    }

    /// <summary>Moves the flying camera by one command. Nothing happens while a player walks.</summary>
    /// <param name="move">Takes the camera, and the width of the frame divided by its height.</param>
    /// <param name="aspect">Width divided by height of the frame.</param>
    /// <param name="interaction">All moves with the same number are one step that can be undone; null for a step of its own.</param>
    public void MoveCamera(Action<FlyingCamera, double> move, double aspect, int? interaction = null)
    {
        if (!Physics.IsWalking)
        {
            State = State.BeginStep(UndoView, interaction);
            move(FlyingCamera, aspect);
        }
    }

    /// <summary>Drops a ball where the camera looks.</summary>
    /// <returns>A message for the user.</returns>
    public string DropBall() => AddBall(BodySpawner.DropSphere);

    /// <summary>Throws a ball from the camera.</summary>
    /// <returns>A message for the user.</returns>
    public string ThrowBall() => AddBall(BodySpawner.ThrowSphere);

    private string AddBall(Func<PhysicsWorld, double, Camera, string> add) => VisibleDepth > 0
        ? "a ball is too large for this depth: zoom out first"
        : Physics.WhenReady(world => add(world, Physics.SceneExtent, Camera));

    public void ReleaseKeys()
    {
        CameraControls.ReleaseKeys();
        WalkControls.ReleaseKeys();
    }

    /// <summary>Advances film, bodies and camera by a time.</summary>
    /// <returns>True when the view may have changed.</returns>
    public bool Advance(TimeSpan time)
    {
        var mayHaveMoved = Physics.Advance(time);
        if (Film is { IsPlaying: true } film)
        {
            film.Advance(Physics.Speed * time.TotalSeconds);
            Physics.IsPaused |= !film.IsPlaying;
            FollowFilm(film);
            mayHaveMoved = true;
        }

        return (!Physics.IsWalking && CameraControls.Advance(time)) || mayHaveMoved;
    }

    /// <summary>Plays or pauses the film with the bodies, or the bodies alone where there is none.</summary>
    /// <returns>A message for the user.</returns>
    public string TogglePlaying()
    {
        if (Film is not { } film)
        {
            return Physics.TogglePause();
        }

        State = State.Record(UndoView);
        if (film.Time >= film.Duration && Physics.HasMovers)
        {
            Physics.Reset();
        }

        film.Toggle();
        FollowFilm(film);
        Physics.IsPaused = Physics.IsBroken || !film.IsPlaying;
        return FormattableString.Invariant(
            $"film: {(film.IsPlaying ? "playing from" : "paused at")} {film.Time:0.##} s of {film.Duration:0.##} s");
    }

    /// <summary>Shows a time of the film.</summary>
    /// <param name="time">Seconds since its beginning.</param>
    /// <param name="interaction">All changes with the same number are one step that can be undone.</param>
    public void SeekFilm(double time, int? interaction)
    {
        State = State.BeginStep(UndoView, interaction);
        Film!.Seek(time);
        FollowFilm(Film);
    }

    /// <summary>Ends the film, and returns to the camera and the numbers of the files.</summary>
    /// <returns>A message for the user.</returns>
    public string StopFilm()
    {
        State = State.Record(UndoView);
        Film!.Stop();
        FlyingCamera.Reset();
        return "film: stopped";
    }

    private void FollowFilm(FilmPlayer film)
    {
        if (film.Camera is { } camera && !Physics.IsWalking)
        {
            FlyingCamera.MoveTo(camera);
            _filmView = FlyingCamera.State;
        }
    }

    /// <summary>Starts walking in the direction of the camera, or continues flying from the player's eyes.</summary>
    /// <returns>A message for the user.</returns>
    public string ToggleWalking()
    {
        // A walk may end anywhere, so the view before it is a step that can be undone.
        State = State.Record(UndoView);
        var camera = Camera;
        var wasWalking = Physics.IsWalking;
        var message = Physics.ToggleWalking(camera);
        if (Physics.IsWalking)
        {
            WalkControls.Begin(camera, Physics.Character!, Physics.InterpolationAlpha);
        }
        else if (wasWalking)
        {
            CameraControls.ReleaseKeys();
            FlyingCamera.MoveTo(camera);
        }

        return message;
    }

    /// <summary>Moves what is drawn to its present place, and returns the view of the present camera.</summary>
    /// <remarks>Bodies move to their interpolated positions, and the fractal to that of the paper's zoom where it is enabled.</remarks>
    /// <param name="aspect">Width divided by height of the frame.</param>
    /// <param name="isBesidePanels">False for a view in the middle of the frame, as if there were no panels.</param>
    public View UpdateView(double aspect, bool isBesidePanels = true)
    {
        Physics.ApplyTo(Renderer);
        Tool.Measure.Follow(Physics.CurrentScene, Physics.IsRunning);
        Tool.Follow(Physics.CurrentScene);
        var view = View.Of(File.Scene with { Scene = GetCurrentScene() }, aspect) with
        {
            Section = Section.Shown,
            HorizontalShift = isBesidePanels ? Area.HorizontalShift : 0,
        };
        DocumentLines.Update(this, view);
        if (!Physics.IsWalking && IsTrailEnabled)
        {
            Renderer.Move(0, Trail!.Update(File.Scene.Objects[0].ObjectToWorld, view.Camera.Position));
        }

        LatestView = Physics.IsWalking || IsTrailEnabled ? view : FlyingCamera.WithDeepZoom(view);
        return LatestView;
    }

    /// <summary>Returns the map from points of the world, or about another camera in the fractal, to the frame that is drawn.</summary>
    /// <param name="viewpoint">Address of that other camera, in whose unit the points are; null for points in world space.</param>
    /// <returns>Null where a double can't tell both places.</returns>
    public Func<Vector, Vector>? MapToDrawnFrame(FractalAddress? viewpoint) =>
        FlyingCamera.MapToDrawnFrame(viewpoint, isDeep: VisibleDepth > 0);

    /// <summary>Returns a camera as it is saved and shown: without the negative zeros that mirroring and turning leave.</summary>
    public static Camera WithoutNegativeZeros(Camera camera) =>
        camera with { Position = camera.Position + Vector.Zero, Rotation = camera.Rotation + Vector.Zero };

    /// <summary>Returns what the file says, or another scene, with the present view.</summary>
    public Scene GetCurrentScene(Scene? other = null) => (other ?? File.Scene.Scene) with
    {
        Camera = Camera,
        Projection = FlyingCamera.Projection,
        OrthographicHeight = FlyingCamera.OrthographicHeight,
    };

    /// <summary>The scene with its bodies where they are, and the exposure that is drawn where the file leaves that open.</summary>
    public LoadedScene LitScene => Physics.CurrentScene is { Scene: { HasAutoExposure: true } scene } current
        ? current with { Scene = scene with { Exposure = Renderer.Scene.Source.Scene.Exposure, HasAutoExposure = false } }
        : Physics.CurrentScene;

    /// <summary>
    /// Returns what is on the screen: bodies where they are, and the present view where that is not the file's. A fractal or mesh that was
    /// opened alone is without its stage, unless that is wanted.
    /// </summary>
    public LoadedScene GetShownScene(bool isStaged)
    {
        var shown = Physics.CurrentScene;
        if (!isStaged && File.Kind != FileKind.Scene)
        {
            shown = LoadedScene.Of(new()
            {
                Handedness = shown.Scene.Handedness,
                Objects = [.. shown.Objects.Select(static placed => placed.Declaration with { Gradient = null })],
            });
        }

        return State.Draft.IsChanged(SceneView) ? shown with { Scene = GetCurrentScene(shown.Scene) } : shown;
    }

    public void Dispose()
    {
        FirstSightLoader.Dispose();
        Physics.Dispose();
        Renderer.Dispose();
    }
}
