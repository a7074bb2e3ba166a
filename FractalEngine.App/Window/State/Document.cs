using FractalEngine.App.Cameras;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.Input;
using FractalEngine.App.Window.Simulation;
using FractalEngine.App.Window.Tools;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using FractalEngine.Render.Windowing.Events;

namespace FractalEngine.App.Window.State;

/// <summary>The file that a window shows, with its camera, its physics and its renderer.</summary>
internal sealed partial class Document : IDisposable
{
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
            file.Scene, scene.Camera is null ? area.Aspect : null);
        CameraControls = new(FlyingCamera);
        Trail = file.Scene.Objects is [{ Model: FractalModel { Fractal: var fractal } }] ? new(fractal, options.TrailLength) : null;
        // Before anything of the previous document ends, since the driver may refuse the new one.
        previous?.Renderer.Replace(preparation.Scene);
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

    /// <summary>The part of the scene that the window changes, as it is now.</summary>
    public SceneView SceneView => new(WithoutNegativeZeros(Camera), FlyingCamera.Projection, FlyingCamera.OrthographicHeight);

    /// <summary>True when the view differs from the one that was loaded or saved.</summary>
    public bool HasChanges => Draft.IsChanged(SceneView);

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
            RecordView();
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
            WalkControls.Begin(camera, Physics.Character!, Physics.InterpolationAlpha);
        }
        else if (wasWalking)
        {
            CameraControls.ReleaseKeys();
            FlyingCamera.MoveTo(camera);
        }

        return message;
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        FirstSightLoader.Dispose();
        Physics.Dispose();
        Renderer.Dispose();
    }

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
