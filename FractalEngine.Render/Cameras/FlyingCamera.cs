using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Cameras;

/// <summary>
/// A camera that moves freely through a scene, and into a fractal to any depth. Within a fractal its position is a
/// <see cref="FractalAddress"/>, and distances are in a unit that changes with the depth.
/// </summary>
public sealed class FlyingCamera
{
    // Sizes of the scene per second: the scene is crossed in about three seconds.
    private const double SceneSizesPerSecond = 0.35;

    // Near a fractal the distance to its surface halves about every second.
    private const double SurfaceDistancesPerSecond = 0.8;

    // Distance of the focus divided by that of the closest surface.
    private const double MaxFocusDistanceRatio = 2;

    // Depth of the near plane divided by the distance of the closest surface.
    private const double NearPlaneFraction = 0.02;

    // Depth of the far plane divided by the distance of the farthest drawn point.
    private const double FarPlaneFactor = 1.01;

    // A larger step of a zoom is divided: at the edges of a wide frame, too, one comes closer to a surface by less than its distance.
    private const double MinZoomStep = 0.85;
    private const int MaxZoomSteps = 200;

    // Limits the roots that are drawn around the camera. Maps that hardly shrink lead to many ancestors of a similar size.
    private const int MaxAncestors = 1000;

    // The addresses of states would fill the memory in deeper zooms. Such a state returns as exactly as a world position can.
    private const int MaxStateDepth = 10_000;

    private readonly SceneFraming _framing;
    private readonly CameraPose _initialPose;
    private readonly FractalLocation? _fractal;

    /// <summary>Creates a camera for one scene.</summary>
    /// <param name="bounds">Bounds of the scene in world space, which determine speed and focus.</param>
    /// <param name="camera">The initial camera, to which <see cref="Reset"/> returns.</param>
    /// <param name="projection">The initial projection.</param>
    /// <param name="orthographicHeight">The initial visible height in scene units; null where it follows the camera.</param>
    /// <param name="fractal">The fractal that the camera can enter to any depth; null for none.</param>
    /// <param name="scene">The scene to frame; null to frame its bounds.</param>
    /// <param name="framedAspect">Width divided by height of the frame for which the camera frames the scene; null for none.</param>
    public FlyingCamera(
        BoundingBox bounds, Camera camera, Projection projection, double? orthographicHeight, FractalLocation? fractal = null,
        LoadedScene? scene = null, double? framedAspect = null)
    {
        _fractal = fractal;
        _framing = new(bounds, scene);
        _initialPose = new(camera, projection, orthographicHeight, 0) { FramedAspect = framedAspect };
        Pose = _initialPose;
        Place(camera);
    }

    /// <summary>The state of the camera, which changes with every movement.</summary>
    public CameraPose Pose { get; private set; }

    /// <summary>The camera in world space, as far as double precision can express its position.</summary>
    public Camera Camera =>
        Address is null ? Pose.Camera : Pose.Camera with { Position = Address.WorldPosition(_fractal!.ObjectToWorld) };

    /// <summary>The present projection of the view.</summary>
    public Projection Projection => Pose.Projection;

    /// <summary>The visible height that the scene states, zoomed, in scene units; null where it follows the camera.</summary>
    public double? OrthographicHeight => Pose.OrthographicHeight;

    /// <summary>Number of levels between the whole fractal and the sub-fractal around the camera.</summary>
    public int Depth => Address?.Depth ?? 0;

    /// <summary>Decimal logarithm of the magnification of the camera's surroundings.</summary>
    public double Log10Magnification => Address is null ? 0 : -Address.LogUnit / Math.Log(10);

    /// <summary>Distance of the point that the camera orbits and zooms to, straight ahead. In the present unit.</summary>
    public double FocusDistance { get; private set; }

    /// <summary>Speed in present units per second: by the size of the scene, and near a fractal by the distance to it.</summary>
    public double Speed
    {
        get
        {
            var sceneSpeed = SceneSizesPerSecond * _framing.Extent;
            if (Address is null)
            {
                return sceneSpeed;
            }

            var fractalSpeed = SurfaceDistancesPerSecond * Address.ClosestSurfaceDistance();
            return Address.Depth == 0 ? Math.Min(sceneSpeed, fractalSpeed) : fractalSpeed;
        }
    }

    private Vector Focus => Pose.Camera.Position + (FocusDistance * Pose.Camera.LocalAxes.V3);

    /// <summary>Adapts a view to a camera within the fractal. Returns the view itself while the camera is outside.</summary>
    public View WithDeepZoom(View view)
    {
        if (Address is not { Depth: > 0 } || Projection != Projection.Perspective)
        {
            return view;
        }

        var roots = Address.CollectRoots(MaxAncestors);
        return view with
        {
            DeepZoom = new(_fractal!.ObjectIndex, roots, Address.LogUnit),
            FixedClipPlanes = (NearPlaneFraction * Address.ClosestSurfaceDistance(), FarPlaneFactor * Address.MaxDrawDistance(roots)),
        };
    }

    /// <summary>Moves along the camera's own axes.</summary>
    /// <param name="distances">Distances to the right, up and forward, in the present unit.</param>
    public void Move(Vector distances) => Apply(CameraNavigation.Move(Pose.Camera, distances));

    /// <summary>Turns in place about the world's up and the camera's own right.</summary>
    /// <param name="right">Angle to the right in radians.</param>
    /// <param name="up">Angle upwards in radians.</param>
    public void Turn(double right, double up) => Apply(CameraNavigation.Turn(Pose.Camera, right, up));

    /// <summary>Turns around the point in focus, which keeps its place in the frame.</summary>
    /// <inheritdoc cref="Turn"/>
    public void Orbit(double right, double up) => Apply(CameraNavigation.Orbit(Pose.Camera, Focus, right, up));

    /// <summary>Zooms to a point at the depth of the point in focus, or away from it. The point keeps its place in the frame.</summary>
    /// <param name="factor">The new distance of the point divided by the old one, positive.</param>
    /// <param name="right">Place of the point in the frame: 0 in the middle, 1 as far to the right as half the frame is high.</param>
    /// <param name="up">Likewise upwards.</param>
    public void Zoom(double factor, double right = 0, double up = 0)
    {
        // Many notches at once would lead through a surface, to which a single one comes closer by less than its distance.
        var steps = Math.Clamp((int)Math.Ceiling(Math.Log(factor) / Math.Log(MinZoomStep)), 1, MaxZoomSteps);
        for (var step = 0; step < steps; step++)
        {
            ZoomOnce(Math.Pow(factor, 1.0 / steps), right, up);
        }
    }

    private void ZoomOnce(double factor, double right, double up)
    {
        if (Address is not null)
        {
            // Zooming in leads to the closest surface, however close it is. Zooming out leads away from it by as much.
            var surfaceDistance = Address.ClosestSurfaceDistance();
            var maxFocusDistance = Math.Max(1, factor) * MaxFocusDistanceRatio * surfaceDistance;
            FocusDistance = factor > 1 && Address.Depth > 0 ? maxFocusDistance
                : factor > 1 ? Math.Min(FocusDistance, maxFocusDistance)
                : Math.Clamp(FocusDistance, surfaceDistance, maxFocusDistance);
        }

        var halfHeight = Projection == Projection.Orthographic && OrthographicHeight is { } height
            ? 0.5 * height
            : FocusDistance * Pose.Camera.HalfHeightAtUnitDepth;
        var pivot = Focus + (Pose.Camera.LocalAxes * new Vector(halfHeight * right, halfHeight * up, 0));
        Apply(CameraNavigation.Zoom(Pose.Camera, pivot, factor));
        FocusDistance *= factor;
        Pose = Pose with { OrthographicHeight = factor * Pose.OrthographicHeight };
    }

    /// <summary>Looks at a point, which becomes the centre of the orbit.</summary>
    /// <param name="point">Relative to the camera, in the present unit; not 0.</param>
    public void FocusOn(Vector point)
    {
        var distance = point.Length();
        if (distance > 0)
        {
            var rotation = CameraFraming.LookRotation(Pose.Camera.Handedness.Mirror(point));
            Pose = Pose with { Camera = Pose.Camera with { Rotation = rotation }, FramedAspect = null };
            FocusDistance = distance;
        }
    }

    /// <summary>Address of the camera in the fractal, which nobody else may move; null outside of fractals.</summary>
    public FractalAddress? Address { get; private set; }

    /// <summary>Maps a point to world axes about the camera, in the present unit.</summary>
    /// <param name="point">World space, or relative to another camera.</param>
    /// <param name="viewpoint">Address of that other camera; null for world space.</param>
    /// <returns>Null where a double can't tell both places.</returns>
    public Vector? ToCameraFrame(Vector point, FractalAddress? viewpoint) =>
        viewpoint is null ? Math.Exp(-(Address?.LogUnit ?? 0)) * (point - Camera.Position)
        : Address?.MapFrom(viewpoint) is { } map ? map * point
        : null;

    /// <summary>
    /// Returns the map to the frame that is drawn: in a deep zoom about the camera in the present unit, else world space.
    /// </summary>
    /// <param name="viewpoint">Address of the camera that the mapped points are about; null for points in world space.</param>
    /// <param name="isDeep">Whether a deep zoom is drawn.</param>
    /// <returns>Null where a double can't tell both places.</returns>
    public Func<Vector, Vector>? MapToDrawnFrame(FractalAddress? viewpoint, bool isDeep)
    {
        if (viewpoint is null)
        {
            return isDeep ? point => Math.Exp(-Address!.LogUnit) * (point - Camera.Position) : static point => point;
        }

        // An address that nobody has moved is relative to the whole fractal and to the origin of the world.
        var target = isDeep || _fractal is null ? Address : new(_fractal.Hierarchy, _fractal.ObjectToWorld, Vector.Zero);
        return target?.MapFrom(viewpoint) is { } map ? point => map * point : null;
    }

    /// <summary>Changes the angle of view, without moving the camera.</summary>
    /// <param name="degrees">The full vertical angle, more than 0 and less than 180 degrees.</param>
    public void SetFieldOfView(double degrees) =>
        Pose = Pose with { Camera = Pose.Camera with { FieldOfView = degrees }, FramedAspect = null };

    /// <summary>Changes the lens, see <see cref="Camera.Aperture"/> and <see cref="Camera.FocusDepth"/>.</summary>
    /// <param name="aperture">Diameter, scene units.</param>
    /// <param name="focusDepth">Depth of what is sharp, scene units.</param>
    /// <exception cref="ArgumentException">The diameter is negative, the depth not positive, or one of them not finite.</exception>
    public void SetLens(double aperture, double focusDepth) =>
        Pose = Pose with { Camera = Pose.Camera with { Aperture = aperture, FocusDepth = focusDepth } };

    /// <summary>Takes a projection as it is, without moving the camera.</summary>
    /// <param name="projection">The projection of the view.</param>
    /// <param name="orthographicHeight">The visible height in scene units; null where it follows the camera.</param>
    public void SetProjection(Projection projection, double? orthographicHeight) =>
        Pose = Pose with { Projection = projection, OrthographicHeight = orthographicHeight };

    /// <summary>Switches between perspective and orthographic projection. What is in focus keeps its size.</summary>
    public void ToggleProjection()
    {
        var heightAtUnitDepth = 2 * Pose.Camera.HalfHeightAtUnitDepth;
        if (Projection == Projection.Perspective)
        {
            // Deep in a fractal, an orthographic view shows the whole from afar.
            Pose = Pose with
            {
                Projection = Projection.Orthographic,
                OrthographicHeight = Depth > 0 ? null : heightAtUnitDepth * FocusDistance,
            };
            return;
        }

        if (Depth == 0 && OrthographicHeight is { } height)
        {
            var distance = height / heightAtUnitDepth;
            // A difference of a rounding would be a move.
            if (Math.Abs(distance - FocusDistance) > 1e-9 * distance)
            {
                Move(new(0, 0, FocusDistance - distance));
                FocusDistance = distance;
            }
        }

        Pose = Pose with { Projection = Projection.Perspective, OrthographicHeight = null };
    }

    /// <summary>Takes a moved camera. Within a fractal its position is a displacement in the present unit.</summary>
    private void Apply(Camera camera)
    {
        if (Address is null)
        {
            Pose = Pose with { Camera = camera, FramedAspect = camera == Pose.Camera ? Pose.FramedAspect : null };
            return;
        }

        var displacement = camera.Position;
        var logUnit = Address.LogUnit;
        Address.Move(displacement);
        FocusDistance *= Math.Exp(logUnit - Address.LogUnit);
        Pose = Pose with
        {
            Camera = camera with { Position = Vector.Zero },
            MoveCount = Pose.MoveCount + (displacement == Vector.Zero ? 0 : 1),
            FramedAspect = displacement == Vector.Zero && camera.Rotation == Pose.Camera.Rotation ? Pose.FramedAspect : null,
        };
    }

    /// <summary>Moves the camera so that the whole scene is visible in the present direction.</summary>
    /// <param name="aspect">Width divided by height of the frame.</param>
    public void FrameScene(double aspect) => FrameScene(Camera, aspect);

    /// <summary>Moves the camera so that the whole scene is visible in another direction.</summary>
    /// <param name="direction">The direction in which the camera looks, in the axes of a camera without rotation.</param>
    /// <param name="aspect">Width divided by height of the frame.</param>
    public void LookAlong(Vector direction, double aspect) =>
        FrameScene(Camera with { Rotation = CameraFraming.LookRotation(direction) }, aspect);

    /// <summary>
    /// Frames the scene again after its shape has changed, if that is where the camera stands, and if it would stand elsewhere by a fifth
    /// of its distance: what grows out of the frame or becomes small is followed, and all else leaves the view as it is.
    /// </summary>
    /// <param name="aspect">Width divided by height of the frame.</param>
    public void FollowShape(double aspect)
    {
        if (Pose.FramedAspect is not { } framedAspect || Depth > 0)
        {
            return;
        }

        // For the frame as it was then: its own shape may have changed, too, which alone moves no camera.
        if (_framing.HasDrifted(Camera, Projection, OrthographicHeight, framedAspect))
        {
            FrameScene(Camera, aspect);
        }
    }

    private void FrameScene(Camera camera, double aspect)
    {
        var (framed, height) = _framing.Frame(camera, Projection, aspect);
        Place(framed);
        Pose = Pose with { OrthographicHeight = height, FramedAspect = aspect };
    }

    /// <summary>The present state, for <see cref="Restore"/>.</summary>
    public CameraState State =>
        new(Pose, Camera, FocusDistance, Address is { Depth: > 0 and <= MaxStateDepth } ? Address.Clone() : null)
        {
            Fractal = _fractal,
        };

    /// <summary>Returns to the initial camera and projection.</summary>
    public void Reset()
    {
        Pose = _initialPose;
        Place(Pose.Camera);
    }

    /// <summary>Returns to a state of this camera, or of one for another scene, as exactly as a world position can.</summary>
    public void Restore(CameraState state)
    {
        Pose = state.Pose;
        if (!ReferenceEquals(state.Fractal?.Hierarchy, _fractal?.Hierarchy) || state.Fractal?.ObjectToWorld != _fractal?.ObjectToWorld)
        {
            // The fractal has been changed since.
            Place(state.WorldCamera);
        }
        else if (_fractal is null || state.Address is not null)
        {
            Address = state.Address?.Clone();
            FocusDistance = state.FocusDistance;
        }
        else
        {
            Place(state.WorldCamera);
            Pose = state.Pose;
        }
    }

    /// <summary>Continues from another camera in world space.</summary>
    public void MoveTo(Camera camera)
    {
        Place(camera);
        Pose = Pose with { FramedAspect = null };
    }

    /// <summary>Takes a camera in world space, with its address in the fractal if the scene has one.</summary>
    private void Place(Camera camera)
    {
        Pose = Pose with { Camera = camera };
        FocusDistance = _framing.DistanceToCentre(camera);
        if (_fractal is not null)
        {
            Address = new(_fractal.Hierarchy, _fractal.ObjectToWorld, Pose.Camera.Position);
            Address.Move(Vector.Zero);
            FocusDistance *= Math.Exp(-Address.LogUnit);
            Pose = Pose with { Camera = Pose.Camera with { Position = Vector.Zero }, MoveCount = Pose.MoveCount + 1 };
        }
    }
}
