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
        (File, Sight) = (file, new(preparation, window.Wake));
        var (scene, drawable) = (file.Scene.Scene, preparation.Scene);
        var camera = View.Of(file.Scene, window.Aspect).Camera;
        Controls = new(file.Scene.Bounds, camera, options.Projection ?? scene.Projection, scene.OrthographicHeight, FractalIn(drawable));
        Trail = file.Scene.Objects is [{ Model: FractalModel { Fractal: var fractal } }] ? new(fractal, options.TrailLength) : null;
        Renderer = new(window, drawable);
        Physics = new(file.Scene, window.Wake, buildsAll: !options.Settings.PreparesOnSight);
    }

    /// <summary>The file.</summary>
    public LoadedFile File { get; }

    /// <summary>Draws it.</summary>
    public SceneRenderer Renderer { get; }

    /// <summary>Moves the camera.</summary>
    public CameraControls Controls { get; }

    /// <summary>Moves the bodies.</summary>
    public ScenePhysics Physics { get; }

    /// <summary>Tells the player where to go.</summary>
    public WalkControls Walk { get; } = new();

    /// <summary>True while camera or bodies move.</summary>
    public bool IsMoving => Physics.IsRunning || (!Physics.IsWalking && Controls.IsMoving);

    /// <summary>Prepares what comes in sight.</summary>
    public SightPreparation Sight { get; }

    /// <summary>The paper's way into a fractal; null where there is not exactly one.</summary>
    public FractalTrail? Trail { get; }

    /// <summary>Whether it is taken.</summary>
    public bool UsesTrail { get; private set; }

    /// <summary>Takes the paper's way into the fractal, or ours again.</summary>
    public void ToggleTrail()
    {
        UsesTrail = Trail is not null && !UsesTrail;
        Renderer.Move(0, File.Scene.Objects[0].Map);
    }

    /// <summary>The view as the camera is now. Moves the fractal where the paper's way is taken.</summary>
    /// <param name="aspect">Width divided by height of the picture.</param>
    public View ViewNow(double aspect)
    {
        Physics.Place(Renderer);
        var view = View.Of(File.Scene with { Scene = SceneNow() }, aspect);
        if (Physics.IsWalking)
        {
            return view;
        }

        if (!UsesTrail)
        {
            return Controls.Deepened(view);
        }

        Renderer.Move(0, Trail!.Follow(File.Scene.Objects[0].Map, view.Camera.Position));
        return view;
    }

    /// <summary>Takes in an event: the player's, or the camera's.</summary>
    /// <returns>True when the view changed.</returns>
    public bool Handle(WindowEvent windowEvent, double aspect) =>
        Physics.IsWalking ? Walk.Handle(windowEvent, Physics.Walker!) : Controls.Handle(windowEvent, aspect);

    /// <summary>Moves on for a while.</summary>
    /// <returns>True when something may look different.</returns>
    public bool Advance(TimeSpan time)
    {
        var moves = Physics.Advance(time);
        return (!Physics.IsWalking && Controls.Advance(time)) || moves;
    }

    /// <summary>Lets the player walk from where the camera looks, or the camera fly from where the player stands.</summary>
    /// <returns>What to say.</returns>
    public string ToggleWalking()
    {
        var (camera, walked) = (Camera, Physics.IsWalking);
        var message = Physics.ToggleWalking(camera);
        if (Physics.IsWalking)
        {
            Walk.Release();
            Walk.Direction = camera;
        }
        else if (walked)
        {
            Controls.MoveTo(camera);
        }

        return message;
    }

    /// <summary>Where the scene is seen from: the camera's place, or the player's eyes.</summary>
    public Camera Camera => Physics is { IsWalking: true, Walker: { } walker } ? Walk.Eyes(walker, Physics.Part) : Controls.Camera;

    /// <summary>The scene as it would be saved: with the present camera and projection.</summary>
    public Scene SceneNow() => File.Scene.Scene with
    {
        Camera = Camera,
        Projection = Controls.Projection,
        OrthographicHeight = Controls.OrthographicHeight,
    };

    /// <inheritdoc/>
    public void Dispose()
    {
        Sight.Wait();
        Renderer.Dispose();
    }

    /// <summary>The fractal, where it is all there is: the camera can then go into it as deep as it likes.</summary>
    private static FractalPlace? FractalIn(DrawableScene drawable) =>
        drawable.Source.Objects is [{ Model: FractalModel, Map: var map }] && drawable.Objects[0].Model.Detail is { } table ? new(0, table, map) : null;
}
