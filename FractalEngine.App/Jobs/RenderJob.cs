using FractalEngine.App.Shell;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Cameras;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Jobs;

/// <summary>What a command draws into images.</summary>
/// <param name="Path">Path of the mesh, fractal or scene.</param>
/// <param name="Load">The load options of the file.</param>
/// <param name="Size">Width and height in pixels.</param>
/// <param name="Projection">Overrides the projection of the scene; null keeps it.</param>
/// <param name="Settings">The render settings of each frame.</param>
internal sealed record RenderJob(
    string Path, LoadOptions Load, (int Width, int Height) Size, Projection? Projection, RenderSettings Settings)
{
    /// <summary>The physics time at which the scene is drawn, in seconds.</summary>
    public double Time { get; init; }

    public BackgroundChoice Background { get; init; } = BackgroundChoice.OfScene;

    /// <summary>The format of images with more than 8 bits; null for others.</summary>
    public LightFormat? Format { get; init; }

    /// <summary>Creates the view of a scene for an aspect ratio, before any zoom.</summary>
    public required Func<LoadedScene, double, View> CreateView { get; init; }

    /// <summary>Number of levels that the camera flies into a fractal.</summary>
    public double ZoomLevels { get; init; }

    public LoadedScene WithProjection(LoadedScene scene) =>
        Projection is { } projection ? scene with { Scene = scene.Scene with { Projection = projection } } : scene;

    /// <summary>Returns the view of a scene before any zoom: by its film if it has a camera then, by its own camera, or framed.</summary>
    /// <param name="scene">The scene, perhaps with another projection.</param>
    /// <param name="time">Time of the film, seconds; null for the scene's own camera.</param>
    public View CreateFilmView(LoadedScene scene, double? time)
    {
        if (time is { } seconds && scene.Scene.Film is { } film && film.Cameras.Any())
        {
            var camera = new CameraPath(film.Cameras, scene.Scene.Handedness).At(seconds);
            scene = scene with { Scene = scene.Scene with { Camera = camera } };
        }

        return CreateView(scene, (double)Size.Width / Size.Height);
    }

    /// <summary>Loads a file as it is at a time of its film.</summary>
    /// <param name="seconds">Time of the film.</param>
    /// <param name="cache">What was read before.</param>
    public LoadedScene LoadAt(double seconds, AssetCache cache) => WithProjection(
        AssetLoader.Load(Path, StandardInput.AddTo(Load with { FilmTime = seconds }, Path), null, cache).Scene);

    /// <summary>
    /// Returns the view of a still image, or of the first frame. A default camera frames the scene as it is at time 0, so that images of
    /// several times show the same view.
    /// </summary>
    /// <param name="scene">The scene at the time of the job, without physics.</param>
    public View CreateFirstView(LoadedScene scene)
    {
        var isFramed = scene.Scene is { Camera: null, Film: { } film } && !film.Cameras.Any();
        return CreateFilmView(isFramed && Load.FilmTime > 0 ? LoadAt(0, new()) : scene, Load.FilmTime);
    }

    /// <summary>Returns a scene as it is at the time of the job.</summary>
    /// <param name="file">The file that the scene was loaded from.</param>
    /// <param name="scene">The scene, perhaps with another projection.</param>
    /// <exception cref="SourceException">A body is invalid, or leaves the range of a double.</exception>
    /// <exception cref="UsageException">Nothing in the scene moves.</exception>
    public LoadedScene AtTime(LoadedFile file, LoadedScene scene)
    {
        if (!(Time > 0) || (scene.Scene.Film is not null && !HasBodies(scene)))
        {
            return scene;
        }

        RequireMotion(scene, "--time has no effect");
        return AnimatedBodies.SceneAfter(Path, file, scene, Time);
    }

    /// <summary>Gives a scene the exposure that a view of it needs, where it leaves that open.</summary>
    public LoadedScene Exposed(LoadedScene scene, View view) => ExposureMeter.Expose(scene, view, Size.Width, Size.Height, Settings);

    /// <summary>Requires a scene to have physics objects or moving ones, and shapes that stay.</summary>
    /// <exception cref="UsageException">It has none, or its film changes numbers.</exception>
    public void RequireMotion(LoadedScene scene, string consequence)
    {
        UsageException.ThrowIf(!HasBodies(scene), $"{Path} has no physics objects, so {consequence}");
        UsageException.ThrowIf(
            scene.Scene.Film?.HasNumbers == true, $"{Path} has physics objects, which can't move while the film changes numbers");
    }

    private static bool HasBodies(LoadedScene scene) =>
        scene.Objects.Any(static placed => placed.Declaration is PhysicsObject or { Motion: not null });

    /// <summary>Plans the flight into a fractal, which takes long for hundreds of levels.</summary>
    /// <exception cref="UsageException">There is no single fractal, the view is orthographic, or it meets no surface.</exception>
    public (CameraZoom Zoom, double Steps) PlanZoom(DrawableScene drawable, View view)
    {
        if (drawable.SingleFractal is not { } fractal)
        {
            throw new UsageException("--zoom needs a fractal, or a scene whose only object is one, and --detail above 0");
        }

        UsageException.ThrowIf(view.Projection != Core.Scenes.Cameras.Projection.Perspective, "--zoom needs the perspective projection");
        try
        {
            var zoom = new CameraZoom(drawable.Source.Bounds, fractal, view);
            return (zoom, zoom.CountSteps(ZoomLevels));
        }
        catch (InvalidOperationException exception)
        {
            throw new UsageException(exception.Message);
        }
    }
}
