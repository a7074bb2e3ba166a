using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>The file that a window shows, and where it is seen from.</summary>
internal sealed class Document : IDisposable
{
    /// <summary>Uploads what is prepared. On the window's thread.</summary>
    /// <param name="window">Shows it.</param>
    /// <param name="file">Loaded.</param>
    /// <param name="preparation">What has been in sight is prepared.</param>
    /// <param name="options">Projection and trail.</param>
    public Document(RenderWindow window, LoadedFile file, ScenePreparation preparation, WindowOptions options)
    {
        (File, FirstSightLoader) = (file, new(preparation, window.Wake));
        var (scene, drawable) = (file.Scene.Scene, preparation.Scene);
        var camera = View.Of(file.Scene, window.Aspect).Camera;
        CameraControls = new(file.Scene.Bounds, camera, options.Projection ?? scene.Projection, scene.OrthographicHeight,
            FindFractal(drawable));
        Trail = file.Scene.Objects is [{ Model: FractalModel { Fractal: var fractal } }] ? new(fractal, options.TrailLength) : null;
        Renderer = new(window, drawable);
        Physics = new(file.Scene, window.Wake, alwaysBuild: !options.Settings.LazyLoading);
    }

    /// <summary>The file.</summary>
    public LoadedFile File { get; }

    /// <summary>Draws it.</summary>
    public SceneRenderer Renderer { get; }

    /// <summary>Moves the camera.</summary>
    public CameraControls CameraControls { get; }

    /// <summary>Moves the bodies.</summary>
    public ScenePhysics Physics { get; }

    /// <summary>Tells the player where to go.</summary>
    public WalkControls WalkControls { get; } = new();

    /// <summary>True while camera or bodies move.</summary>
    public bool IsMoving => Physics.IsRunning || (!Physics.IsWalking && CameraControls.IsMoving);

    /// <summary>Prepares what comes in sight.</summary>
    public FirstSightLoader FirstSightLoader { get; }

    /// <summary>The paper's way into a fractal; null where there is not exactly one.</summary>
    public FractalTrail? Trail { get; }

    /// <summary>Whether it is taken.</summary>
    public bool IsTrailEnabled { get; private set; }

    /// <summary>Takes the paper's way into the fractal, or ours again.</summary>
    public void ToggleTrail()
    {
        IsTrailEnabled = Trail is not null && !IsTrailEnabled;
        Renderer.Move(0, File.Scene.Objects[0].ObjectToWorld);
    }

    /// <summary>The view as the camera is now. Moves the fractal where the paper's way is taken.</summary>
    /// <param name="aspect">Width divided by height of the picture.</param>
    public View UpdateView(double aspect)
    {
        Physics.ApplyTo(Renderer);
        var view = View.Of(File.Scene with { Scene = GetCurrentScene() }, aspect);
        if (Physics.IsWalking)
        {
            return view;
        }

        if (!IsTrailEnabled)
        {
            return CameraControls.WithDeepZoom(view);
        }

        Renderer.Move(0, Trail!.Update(File.Scene.Objects[0].ObjectToWorld, view.Camera.Position));
        return view;
    }

    /// <summary>Takes in an event: the player's, or the camera's.</summary>
    /// <returns>True when the view changed.</returns>
    public bool Handle(WindowEvent windowEvent, double aspect) =>
        Physics.IsWalking ? WalkControls.Handle(windowEvent, Physics.Character!) : CameraControls.Handle(windowEvent, aspect);

    /// <summary>Moves on for a while.</summary>
    /// <returns>True when something may look different.</returns>
    public bool Advance(TimeSpan time)
    {
        var mayHaveMoved = Physics.Advance(time);
        return (!Physics.IsWalking && CameraControls.Advance(time)) || mayHaveMoved;
    }

    /// <summary>Lets the player walk from where the camera looks, or the camera fly from where the player stands.</summary>
    /// <returns>What to say.</returns>
    public string ToggleWalking()
    {
        var (camera, wasWalking) = (Camera, Physics.IsWalking);
        var message = Physics.ToggleWalking(camera);
        if (Physics.IsWalking)
        {
            WalkControls.ReleaseKeys();
            WalkControls.Direction = camera;
        }
        else if (wasWalking)
        {
            CameraControls.MoveTo(camera);
        }

        return message;
    }

    /// <summary>Where the scene is seen from: the camera's place, or the player's eyes.</summary>
    public Camera Camera =>
        Physics is { IsWalking: true, Character: { } walker }
        ? WalkControls.EyeCamera(walker, Physics.InterpolationAlpha)
        : CameraControls.Camera;

    /// <summary>The scene as it would be saved: with the present camera and projection.</summary>
    public Scene GetCurrentScene() => File.Scene.Scene with
    {
        Camera = Camera,
        Projection = CameraControls.Projection,
        OrthographicHeight = CameraControls.OrthographicHeight,
    };

    /// <inheritdoc/>
    public void Dispose()
    {
        FirstSightLoader.Wait();
        Renderer.Dispose();
    }

    /// <summary>The fractal, where it is all there is: the camera can then go into it as deep as it likes.</summary>
    private static FractalLocation? FindFractal(DrawableScene drawable) =>
        drawable.Source.Objects is [{ Model: FractalModel, ObjectToWorld: var map }] && drawable.Objects[0].Model.LodHierarchy is { } table
        ? new(0, table, map)
        : null;
}
