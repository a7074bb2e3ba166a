using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>The file that a window shows, with its camera, its physics and its renderer.</summary>
internal sealed class Document : IDisposable
{
    /// <summary>Uploads the prepared models. Must be called on the window's thread.</summary>
    /// <param name="window">The window that shows the file.</param>
    /// <param name="file">The loaded file.</param>
    /// <param name="preparation">The preparation of the file's scene, with the visible models prepared.</param>
    /// <param name="options">The options of the window.</param>
    public Document(RenderWindow window, LoadedFile file, ScenePreparation preparation, WindowOptions options)
    {
        File = file;
        FirstSightLoader = new(preparation, window.Wake);
        var scene = file.Scene.Scene;
        var camera = View.Of(file.Scene, window.Aspect).Camera;
        FlyingCamera = new(
            file.Scene.Bounds, camera, options.Projection ?? scene.Projection, scene.OrthographicHeight, FindFractal(preparation.Scene));
        CameraControls = new(FlyingCamera);
        Trail = file.Scene.Objects is [{ Model: FractalModel { Fractal: var fractal } }] ? new(fractal, options.TrailLength) : null;
        Renderer = new(window, preparation.Scene);
        Physics = new(file.Scene, window.Wake, alwaysBuild: !options.Settings.LazyLoading);
    }

    /// <summary>The loaded file with its scene.</summary>
    public LoadedFile File { get; }

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

    /// <summary>The paper's zoom into the fractal; null unless the scene is one fractal.</summary>
    public FractalTrail? Trail { get; }

    /// <summary>Whether the paper's zoom replaces that of the engine.</summary>
    public bool IsTrailEnabled { get; private set; }

    /// <summary>True while the camera or a body moves.</summary>
    public bool IsMoving => Physics.IsRunning || (!Physics.IsWalking && CameraControls.IsMoving);

    /// <summary>The present camera in world space: the flying one, or the one at the player's eyes.</summary>
    public Camera Camera => Physics is { IsWalking: true, Character: { } controller }
        ? WalkControls.EyeCamera(controller, Physics.InterpolationAlpha)
        : FlyingCamera.Camera;

    /// <summary>Switches between the paper's zoom into the fractal and that of the engine.</summary>
    public void ToggleTrail()
    {
        IsTrailEnabled = Trail is not null && !IsTrailEnabled;
        Renderer.Move(0, File.Scene.Objects[0].ObjectToWorld);
    }

    /// <summary>Moves what is drawn to its present place, and returns the view of the present camera.</summary>
    /// <remarks>Bodies move to their interpolated positions, and the fractal to that of the paper's zoom where it is enabled.</remarks>
    /// <param name="aspect">Width divided by height of the frame.</param>
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
            return FlyingCamera.WithDeepZoom(view);
        }

        Renderer.Move(0, Trail!.Update(File.Scene.Objects[0].ObjectToWorld, view.Camera.Position));
        return view;
    }

    /// <summary>Passes an event to the controls of the player or the camera.</summary>
    /// <returns>True when the view has changed.</returns>
    public bool Handle(WindowEvent windowEvent, double aspect) =>
        Physics.IsWalking ? WalkControls.Handle(windowEvent, Physics.Character!) : CameraControls.Handle(windowEvent, aspect);

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
        FirstSightLoader.Wait();
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
