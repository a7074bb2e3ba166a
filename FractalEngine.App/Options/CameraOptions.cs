using System.CommandLine;
using FractalEngine.App.Jobs;
using FractalEngine.App.Shell;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;
using FractalEngine.Render.Cameras;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Options;

/// <summary>The options that choose the camera of an image, in place of the scene's own.</summary>
internal sealed class CameraOptions
{
    // The directions of looking, in the axes of a camera without rotation: right, up and forward.
    private static readonly (string Word, Vector Direction)[] Views =
    [
        ("front", Vector.K), ("right", -Vector.I), ("top", -Vector.J), ("back", -Vector.K), ("left", Vector.I), ("bottom", Vector.J),
        (Isometric, new(-1, -1, 1)),
    ];

    private const string Isometric = "isometric";

    private readonly Option<string?> _camera = SharedOptions.TextOption(
        "--camera", "\"(x,y,z) (p,y,r) fov\"",
        "Camera as a scene declares it: position, rotation in radians, angle of view in degrees.");

    private readonly Option<string?> _lookFrom = VectorOption(
        "--look-from", "Position of the camera, which looks at the middle of the scene unless --look-at names another point.");

    private readonly Option<string?> _lookAt = VectorOption("--look-at", "Point that the camera looks at.");
    private readonly Option<string?> _up = VectorOption("--up", "Direction that is up in the image, with --look-from or --look-at.");

    private readonly Option<Vector?> _view = WordOption.Single(
        "--view", "Show all of the scene from a side; isometric is orthographic unless --projection says otherwise.", Views);

    private readonly Option<double?> _zoom = NumberOption.Decimal(
        "--zoom", "LEVELS", 0, CameraZoom.MaxLevels, "Fly so many levels into a fractal, towards the surface ahead.");

    private readonly Option<double?> _aperture = NumberOption.Decimal(
        "--aperture", "DIAMETER", 0, 1e30,
        "Blur what is out of focus by a lens of this diameter, in scene units; 0 shows everything sharp.");

    private readonly Option<double?> _focus = NumberOption.Decimal(
        "--focus", "DEPTH", 1e-30, 1e30, "Depth of what a lens shows sharp, in scene units.");

    public void AddTo(Command command) =>
        SharedOptions.AddAll(command, _camera, _lookFrom, _lookAt, _up, _view, _zoom, _aperture, _focus);

    /// <summary>Returns the number of levels that the camera flies into a fractal.</summary>
    public double Zoom(ParseResult result) => result.GetValue(_zoom) ?? 0;

    public bool IsGiven(ParseResult result) =>
        result.GetValue(_camera) is not null || result.GetValue(_view) is not null || HasTarget(result)
        || result.GetValue(_aperture) is not null || result.GetValue(_focus) is not null;

    private bool HasTarget(ParseResult result) => result.GetValue(_lookFrom) is not null || result.GetValue(_lookAt) is not null;

    /// <summary>Returns the view of a scene that the options ask for, without the zoom.</summary>
    /// <param name="result">The parsed command line.</param>
    /// <param name="scene">The scene, with the projection of the command line.</param>
    /// <param name="hasProjection">Whether the command line names a projection.</param>
    /// <param name="aspect">Width divided by height of the image.</param>
    /// <exception cref="UsageException">The options contradict each other, or have a faulty value.</exception>
    public View View(ParseResult result, LoadedScene scene, bool hasProjection, double aspect)
    {
        var view = ViewOf(result, scene, hasProjection, aspect);
        var (aperture, focus) = (result.GetValue(_aperture), result.GetValue(_focus));
        if (aperture is null && focus is null)
        {
            return view;
        }

        UsageException.ThrowIf(view.Projection != Projection.Perspective, "--aperture and --focus need the perspective projection");
        UsageException.ThrowIf(
            focus is null && view.Camera.Aperture == 0, "--aperture needs --focus DEPTH, unless the scene's camera has a focus");
        UsageException.ThrowIf(aperture is null && view.Camera.Aperture == 0, "--focus needs --aperture DIAMETER, or a scene's");
        var camera = view.Camera;
        return view with
        {
            Camera = camera with { Aperture = aperture ?? camera.Aperture, FocusDepth = focus ?? camera.FocusDepth },
        };
    }

    private View ViewOf(ParseResult result, LoadedScene scene, bool hasProjection, double aspect)
    {
        var hasTarget = HasTarget(result);
        if (new[] { result.GetValue(_camera) is not null, hasTarget, result.GetValue(_view) is not null }.Count(static given => given) > 1)
        {
            throw new UsageException("--camera, --view and --look-from or --look-at exclude each other: give one of the three");
        }

        UsageException.ThrowIf(result.GetValue(_up) is not null && !hasTarget, "--up needs --look-from or --look-at");
        var ownView = Render.Views.View.Of(scene, aspect);
        if (result.GetValue(_camera) is { } text)
        {
            return Render.Views.View.Of(scene, aspect, CameraText.ParseCamera("--camera", text, scene.Scene.Handedness));
        }

        if (hasTarget)
        {
            return Render.Views.View.Of(scene, aspect, LookAt(result, scene, ownView.Camera));
        }

        if (result.GetValue(_view) is not { } direction)
        {
            return ownView;
        }

        var isIsometric = direction == Views[^1].Direction && !hasProjection;
        var shown = isIsometric ? scene with { Scene = scene.Scene with { Projection = Projection.Orthographic } } : scene;
        return Framed(shown, ownView.Camera with { Rotation = CameraFraming.LookRotation(direction) }, aspect);
    }

    /// <summary>Shows all of a scene, as the key F does in the window.</summary>
    private static View Framed(LoadedScene scene, Camera camera, double frameAspect)
    {
        var aspect = scene.Scene.Aspect ?? frameAspect;
        var (framed, height) = new SceneFraming(scene.Bounds, scene).Frame(camera, scene.Scene.Projection, aspect);
        var view = Render.Views.View.Of(scene, frameAspect, framed);
        return view with { OrthographicHeight = height ?? view.OrthographicHeight };
    }

    private Camera LookAt(ParseResult result, LoadedScene scene, Camera camera)
    {
        var position = result.GetValue(_lookFrom) is { } from ? CameraText.ParseVector("--look-from", from) : camera.Position;
        var target = result.GetValue(_lookAt) is { } at ? CameraText.ParseVector("--look-at", at) : scene.Bounds.Centre;
        var up = result.GetValue(_up) is { } direction ? CameraText.ParseVector("--up", direction) : Vector.J;
        if (position == target || up == Vector.Zero)
        {
            throw new UsageException(up == Vector.Zero
                ? "--up must not be (0, 0, 0)"
                : "--look-from and --look-at must be different points");
        }

        return CameraFraming.LookAt(position, target, up, camera.FieldOfView, scene.Scene.Handedness) with
        {
            Aperture = camera.Aperture,
            FocusDepth = camera.FocusDepth,
        };
    }

    private static Option<string?> VectorOption(string name, string description) =>
        SharedOptions.TextOption(name, "\"(x, y, z)\"", description);
}
