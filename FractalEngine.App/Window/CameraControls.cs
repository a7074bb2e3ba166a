using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>
/// Turns keys and mouse into a moving camera: flying, orbiting, panning, zooming, fixed views. Knows nothing of windows or time but
/// what it is told, so that it can be tested without either.
/// </summary>
internal sealed class CameraControls
{
    // Radians a pixel: a drag across a window of 1280 pixels turns by about 220°.
    private const double RadiansPerPixel = 0.003;
    private const double ZoomPerNotch = 0.88;
    private const double SpeedModifierFactor = 4;

    // Of the scene's size a second: a scene is crossed in about three seconds.
    private const double SceneSizesPerSecond = 0.35;

    // Near a fractal the distance to it is halved about every second.
    private const double SurfaceDistancesPerSecond = 0.8;
    private const double MaxFocusDistanceRatio = 2;

    // Of the distance to what is nearest.
    private const double NearPlaneFraction = 0.02;

    // Sub-fractals around the one that the camera is in, of which those too large to be told are left out; of maps that hardly shrink there
    // are many.
    private const int MaxAncestors = 1000;

    // A key that is only tapped, and may be up again before time is told, moves as far as one that is held so long.
    private static readonly TimeSpan TapDuration = TimeSpan.FromSeconds(0.05);

    private readonly HashSet<Key> _heldKeys = [];
    private readonly double _sceneSize;
    private readonly BoundingBox _sceneBounds;
    private readonly Pose _initialPose;
    private MouseButton? _draggedButton;
    private KeyModifiers _modifiers;
    private readonly FractalLocation? _fractal;
    private FractalAddress? _address;
    private Pose _pose;
    private double _focusDistance;

    /// <summary>Controls for one scene.</summary>
    /// <param name="bounds">Of the scene, world space: sets speed and focus.</param>
    /// <param name="camera">Where to begin, and where Enter leads back to.</param>
    /// <param name="projection">Likewise.</param>
    /// <param name="orthographicHeight">Likewise; null where it follows the camera.</param>
    /// <param name="fractal">A fractal that the camera can go into as deep as it likes; null for none.</param>
    public CameraControls(BoundingBox bounds, Camera camera, Projection projection, double? orthographicHeight,
        FractalLocation? fractal = null)
    {
        _fractal = fractal;
        _sceneBounds = bounds.IsEmpty ? new(-Vector.One, Vector.One) : bounds;
        _sceneSize = Math.Max(_sceneBounds.Diagonal, 1e-9 * (1 + _sceneBounds.Centre.MaxAbsComponent()));
        _pose = _initialPose = new(camera, projection, orthographicHeight, 0);
        _focusDistance = DistanceToCentre(camera);
        ResetFractalAddress();
    }

    /// <summary>Where the scene is seen from now.</summary>
    public Camera Camera =>
        _address is null ? _pose.Camera : _pose.Camera with { Position = _address.WorldPosition(_fractal!.ObjectToWorld) };

    /// <summary>How deep the camera is in the fractal: the levels that it has gone down.</summary>
    public int Depth => _address?.Depth ?? 0;

    /// <summary>By how much what is around the camera is enlarged: the decimal logarithm.</summary>
    public double Log10Magnification => _address is null ? 0 : -_address.LogUnit / Math.Log(10);

    /// <summary>A view as the camera sees it from deep in the fractal; the view itself from outside.</summary>
    public View WithDeepZoom(View view)
    {
        if (_address is not { Depth: > 0 } || Projection != Projection.Perspective)
        {
            return view;
        }

        var roots = _address.CollectRoots(MaxAncestors);
        return view with
        {
            DeepZoom = new(_fractal!.ObjectIndex, roots, _address.LogUnit),
            FixedClipPlanes = (NearPlaneFraction * _address.ClosestSurfaceDistance(), 1.01 * _address.MaxDrawDistance(roots)),
        };
    }

    /// <summary>How.</summary>
    public Projection Projection => _pose.Projection;

    /// <summary>The visible height that the scene states, zoomed; null where it follows the camera.</summary>
    public double? OrthographicHeight => _pose.OrthographicHeight;

    /// <summary>True while keys are held that move the camera: time must be told by <see cref="Advance"/>.</summary>
    public bool IsMoving => !_modifiers.HasFlag(KeyModifiers.Control) && Direction() != Vector.Zero;

    /// <summary>The point that the camera turns about and zooms to: straight ahead, as far as the scene's centre was.</summary>
    private Vector Focus => _pose.Camera.Position + (_focusDistance * _pose.Camera.LocalAxes.V3);

    /// <summary>Takes in an event.</summary>
    /// <param name="windowEvent">Any; those that mean nothing here are passed over.</param>
    /// <param name="aspect">Width divided by height of the picture, for framing.</param>
    /// <returns>True when the view changed.</returns>
    public bool Handle(WindowEvent windowEvent, double aspect)
    {
        var before = _pose;
        switch (windowEvent)
        {
            case KeyPressed pressed:
                _modifiers = pressed.Modifiers;
                _heldKeys.Add(pressed.Key);
                HandleKey(pressed, aspect);
                if (!pressed.IsRepeat)
                {
                    Advance(TapDuration);
                }

                break;
            case KeyReleased released:
                _modifiers = released.Modifiers;
                _heldKeys.Remove(released.Key);
                break;
            case MousePressed pressed:
                (_draggedButton, _modifiers) = (pressed.Button, pressed.Modifiers);
                break;
            case MouseReleased:
                _draggedButton = null;
                break;
            case MouseMoved moved when _draggedButton is { } button:
                Drag(button, moved.DeltaX, moved.DeltaY, aspect);
                break;
            case WheelTurned wheel:
                Zoom(Math.Pow(ZoomPerNotch, wheel.Notches));
                break;
            case FocusLost:
                _heldKeys.Clear();
                (_draggedButton, _modifiers) = (null, KeyModifiers.None);
                break;
        }

        return _pose != before;
    }

    /// <summary>Goes on from another place. Keys that are held are forgotten.</summary>
    public void MoveTo(Camera camera)
    {
        _heldKeys.Clear();
        _pose = _pose with { Camera = camera };
        _focusDistance = DistanceToCentre(camera);
        ResetFractalAddress();
    }

    /// <summary>Moves on for a while, as the held keys say.</summary>
    /// <returns>True when the view changed.</returns>
    public bool Advance(TimeSpan time)
    {
        if (!IsMoving)
        {
            return false;
        }

        var distancePerSecond = MoveSpeed()
            * (_modifiers.HasFlag(KeyModifiers.Shift) ? SpeedModifierFactor : 1)
            / (_modifiers.HasFlag(KeyModifiers.Alt) ? SpeedModifierFactor : 1);
        Move(CameraNavigation.Move(_pose.Camera, time.TotalSeconds * distancePerSecond * Direction().UnitVector()));
        return true;
    }

    /// <summary>Units a second: by the size of the scene, and near a fractal by the distance to it.</summary>
    private double MoveSpeed()
    {
        var sceneSpeed = SceneSizesPerSecond * _sceneSize;
        if (_address is null)
        {
            return sceneSpeed;
        }

        var fractalSpeed = SurfaceDistancesPerSecond * _address.ClosestSurfaceDistance();
        return _address.Depth == 0 ? Math.Min(sceneSpeed, fractalSpeed) : fractalSpeed;
    }

    private Vector Direction() => new(
        Axis(Key.D, Key.Right) - Axis(Key.A, Key.Left),
        Axis(Key.E, Key.PageUp) - Axis(Key.Q, Key.PageDown),
        Axis(Key.W, Key.Up) - Axis(Key.S, Key.Down));

    private double Axis(Key letter, Key arrow) => _heldKeys.Contains(letter) || _heldKeys.Contains(arrow) ? 1 : 0;

    private void HandleKey(KeyPressed pressed, double aspect)
    {
        if (pressed.Modifiers.HasFlag(KeyModifiers.Control))
        {
            return;
        }

        switch (pressed.Key)
        {
            case Key.F:
                FrameScene(Camera, aspect);
                break;
            case Key.Digit1 or Key.Keypad1:
                LookAlong(Vector.K, aspect);
                break;
            case Key.Digit3 or Key.Keypad3:
                LookAlong(-Vector.I, aspect);
                break;
            case Key.Digit7 or Key.Keypad7:
                LookAlong(-Vector.J, aspect);
                break;
            case Key.Digit5 or Key.Keypad5:
                _pose = _pose with
                {
                    Projection = Projection == Projection.Perspective ? Projection.Orthographic : Projection.Perspective,
                };
                break;
            case Key.Enter or Key.KeypadEnter:
                _pose = _initialPose;
                _focusDistance = DistanceToCentre(_pose.Camera);
                ResetFractalAddress();
                break;
        }
    }

    private void LookAlong(Vector direction, double aspect) =>
        FrameScene(Camera with { Rotation = CameraFraming.LookRotation(direction) }, aspect);

    private void FrameScene(Camera camera, double aspect)
    {
        _pose = _pose with { Camera = CameraFraming.Frame(camera, _sceneBounds, aspect), OrthographicHeight = null };
        _focusDistance = DistanceToCentre(_pose.Camera);
        ResetFractalAddress();
    }

    private void Drag(MouseButton button, double deltaX, double deltaY, double aspect)
    {
        var (yaw, pitch) = (RadiansPerPixel * deltaX, -RadiansPerPixel * deltaY);
        if (button == MouseButton.Middle || (button == MouseButton.Left && _modifiers.HasFlag(KeyModifiers.Shift)))
        {
            // The point in focus follows the pointer: a pixel is as wide there as the picture shows it.
            var distancePerPixel = RadiansPerPixel * _focusDistance * Math.Min(1, aspect);
            Move(CameraNavigation.Move(_pose.Camera, new(-distancePerPixel * deltaX, distancePerPixel * deltaY, 0)));
        }
        else if (button == MouseButton.Left)
        {
            Move(CameraNavigation.Orbit(_pose.Camera, Focus, yaw, pitch));
        }
        else
        {
            Move(CameraNavigation.Turn(_pose.Camera, yaw, pitch));
        }
    }

    private void Zoom(double factor)
    {
        if (_address is not null)
        {
            // Towards what is near, however small it is; and away from it by as much.
            var maxFocusDistance = Math.Max(1, factor) * MaxFocusDistanceRatio * _address.ClosestSurfaceDistance();
            _focusDistance = factor > 1 && _address.Depth > 0 ? maxFocusDistance : Math.Min(_focusDistance, maxFocusDistance);
        }

        Move(CameraNavigation.Zoom(_pose.Camera, Focus, factor));
        _focusDistance *= factor;
        _pose = _pose with { OrthographicHeight = factor * _pose.OrthographicHeight };
    }

    /// <summary>Moves the camera; deep in a fractal, positions are steps, in a unit that changes with the depth.</summary>
    private void Move(Camera camera)
    {
        if (_address is null)
        {
            _pose = _pose with { Camera = camera };
            return;
        }

        var logUnit = _address.LogUnit;
        _address.Move(camera.Position);
        _focusDistance *= Math.Exp(logUnit - _address.LogUnit);
        _pose = _pose with { Camera = camera with { Position = Vector.Zero }, MoveCount = _pose.MoveCount
            + (camera.Position == Vector.Zero ? 0 : 1) };
    }

    /// <summary>Tells where the camera is relative to the fractal, where there is one.</summary>
    private void ResetFractalAddress()
    {
        if (_fractal is not null)
        {
            _address = new(_fractal.Hierarchy, _fractal.ObjectToWorld, _pose.Camera.Position);
            _address.Move(Vector.Zero);
            _focusDistance *= Math.Exp(-_address.LogUnit);
            _pose = _pose with { Camera = _pose.Camera with { Position = Vector.Zero }, MoveCount = _pose.MoveCount + 1 };
        }
    }

    private double DistanceToCentre(Camera camera) => camera.ToCameraSpace(_sceneBounds.Centre).Z switch
    {
        var depth when depth > 1e-3 * _sceneSize => depth,
        _ => _sceneSize,
    };

    private sealed record Pose(Camera Camera, Projection Projection, double? OrthographicHeight, long MoveCount);
}
