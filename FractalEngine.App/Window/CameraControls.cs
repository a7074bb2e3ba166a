using FractalEngine.Core.Detail;
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
    private const double TurnPerPixel = 0.003;
    private const double ZoomPerNotch = 0.88;
    private const double SpeedFactor = 4;

    // Of the scene's size a second: a scene is crossed in about three seconds.
    private const double SizesPerSecond = 0.35;

    // Near a fractal the distance to it is halved about every second.
    private const double DistancesPerSecond = 0.8;
    private const double ZoomDistances = 2;

    // Of the distance to what is nearest.
    private const double NearestPart = 0.02;

    // Sub-fractals around the one that the camera is in, of which those too large to be told are left out; of maps that hardly shrink there are many.
    private const int Ancestors = 1000;

    // A key that is only tapped, and may be up again before time is told, moves as far as one that is held so long.
    private static readonly TimeSpan Tap = TimeSpan.FromSeconds(0.05);

    private readonly HashSet<Key> _held = [];
    private readonly double _size;
    private readonly BoundingBox _bounds;
    private readonly Pose _initial;
    private MouseButton? _dragged;
    private KeyModifiers _modifiers;
    private readonly FractalPlace? _fractal;
    private FractalAddress? _address;
    private Pose _pose;
    private double _focusDistance;

    /// <summary>Controls for one scene.</summary>
    /// <param name="bounds">Of the scene, world space: sets speed and focus.</param>
    /// <param name="camera">Where to begin, and where Enter leads back to.</param>
    /// <param name="projection">Likewise.</param>
    /// <param name="orthographicHeight">Likewise; null where it follows the camera.</param>
    /// <param name="fractal">A fractal that the camera can go into as deep as it likes; null for none.</param>
    public CameraControls(BoundingBox bounds, Camera camera, Projection projection, double? orthographicHeight, FractalPlace? fractal = null)
    {
        _fractal = fractal;
        _bounds = bounds.IsEmpty ? new(-Vector.One, Vector.One) : bounds;
        _size = Math.Max(_bounds.Diagonal, 1e-9 * (1 + _bounds.Centre.MaximumComponent()));
        _pose = _initial = new(camera, projection, orthographicHeight, 0);
        _focusDistance = DistanceToCentre(camera);
        PlaceInFractal();
    }

    /// <summary>Where the scene is seen from now.</summary>
    public Camera Camera => _address is null ? _pose.Camera : _pose.Camera with { Position = _address.WorldPosition(_fractal!.Placement) };

    /// <summary>How deep the camera is in the fractal: the levels that it has gone down.</summary>
    public int Depth => _address?.Depth ?? 0;

    /// <summary>By how much what is around the camera is enlarged: the decimal logarithm.</summary>
    public double Enlargement => _address is null ? 0 : -_address.LogUnit / Math.Log(10);

    /// <summary>A view as the camera sees it from deep in the fractal; the view itself from outside.</summary>
    public View Deepened(View view)
    {
        if (_address is not { Depth: > 0 } || Projection != Projection.Perspective)
        {
            return view;
        }

        var roots = _address.Roots(Ancestors);
        return view with
        {
            Zoom = new(_fractal!.Index, roots, _address.LogUnit),
            Clip = (NearestPart * _address.NearestDistance(), 1.01 * _address.FarthestDistance(roots)),
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
                _held.Add(pressed.Key);
                Press(pressed, aspect);
                if (!pressed.IsRepeat)
                {
                    Advance(Tap);
                }

                break;
            case KeyReleased released:
                _modifiers = released.Modifiers;
                _held.Remove(released.Key);
                break;
            case MousePressed pressed:
                (_dragged, _modifiers) = (pressed.Button, pressed.Modifiers);
                break;
            case MouseReleased:
                _dragged = null;
                break;
            case MouseMoved moved when _dragged is { } button:
                Drag(button, moved.DeltaX, moved.DeltaY, aspect);
                break;
            case WheelTurned wheel:
                Zoom(Math.Pow(ZoomPerNotch, wheel.Notches));
                break;
            case FocusLost:
                _held.Clear();
                (_dragged, _modifiers) = (null, KeyModifiers.None);
                break;
        }

        return _pose != before;
    }

    /// <summary>Goes on from another place. Keys that are held are forgotten.</summary>
    public void MoveTo(Camera camera)
    {
        _held.Clear();
        _pose = _pose with { Camera = camera };
        _focusDistance = DistanceToCentre(camera);
        PlaceInFractal();
    }

    /// <summary>Moves on for a while, as the held keys say.</summary>
    /// <returns>True when the view changed.</returns>
    public bool Advance(TimeSpan time)
    {
        if (!IsMoving)
        {
            return false;
        }

        var speed = Speed()
            * (_modifiers.HasFlag(KeyModifiers.Shift) ? SpeedFactor : 1)
            / (_modifiers.HasFlag(KeyModifiers.Alt) ? SpeedFactor : 1);
        Move(CameraNavigation.Move(_pose.Camera, time.TotalSeconds * speed * Direction().UnitVector()));
        return true;
    }

    /// <summary>Units a second: by the size of the scene, and near a fractal by the distance to it.</summary>
    private double Speed()
    {
        var speed = SizesPerSecond * _size;
        if (_address is null)
        {
            return speed;
        }

        var near = DistancesPerSecond * _address.NearestDistance();
        return _address.Depth == 0 ? Math.Min(speed, near) : near;
    }

    private Vector Direction() => new(
        Axis(Key.D, Key.Right) - Axis(Key.A, Key.Left),
        Axis(Key.E, Key.PageUp) - Axis(Key.Q, Key.PageDown),
        Axis(Key.W, Key.Up) - Axis(Key.S, Key.Down));

    private double Axis(Key letter, Key arrow) => _held.Contains(letter) || _held.Contains(arrow) ? 1 : 0;

    private void Press(KeyPressed pressed, double aspect)
    {
        if (pressed.Modifiers.HasFlag(KeyModifiers.Control))
        {
            return;
        }

        switch (pressed.Key)
        {
            case Key.F:
                Frame(Camera, aspect);
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
                _pose = _initial;
                _focusDistance = DistanceToCentre(_pose.Camera);
                PlaceInFractal();
                break;
        }
    }

    private void LookAlong(Vector direction, double aspect) =>
        Frame(Camera with { Rotation = CameraFraming.LookRotation(direction) }, aspect);

    private void Frame(Camera camera, double aspect)
    {
        _pose = _pose with { Camera = CameraFraming.Frame(camera, _bounds, aspect), OrthographicHeight = null };
        _focusDistance = DistanceToCentre(_pose.Camera);
        PlaceInFractal();
    }

    private void Drag(MouseButton button, double right, double down, double aspect)
    {
        var (turn, climb) = (TurnPerPixel * right, -TurnPerPixel * down);
        if (button == MouseButton.Middle || (button == MouseButton.Left && _modifiers.HasFlag(KeyModifiers.Shift)))
        {
            // The point in focus follows the pointer: a pixel is as wide there as the picture shows it.
            var perPixel = TurnPerPixel * _focusDistance * Math.Min(1, aspect);
            Move(CameraNavigation.Move(_pose.Camera, new(-perPixel * right, perPixel * down, 0)));
        }
        else if (button == MouseButton.Left)
        {
            Move(CameraNavigation.Orbit(_pose.Camera, Focus, turn, climb));
        }
        else
        {
            Move(CameraNavigation.Turn(_pose.Camera, turn, climb));
        }
    }

    private void Zoom(double factor)
    {
        if (_address is not null)
        {
            // Towards what is near, however small it is; and away from it by as much.
            var limit = Math.Max(1, factor) * ZoomDistances * _address.NearestDistance();
            _focusDistance = factor > 1 && _address.Depth > 0 ? limit : Math.Min(_focusDistance, limit);
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

        var unit = _address.LogUnit;
        _address.Move(camera.Position);
        _focusDistance *= Math.Exp(unit - _address.LogUnit);
        _pose = _pose with { Camera = camera with { Position = Vector.Zero }, Steps = _pose.Steps + (camera.Position == Vector.Zero ? 0 : 1) };
    }

    /// <summary>Tells where the camera is relative to the fractal, where there is one.</summary>
    private void PlaceInFractal()
    {
        if (_fractal is not null)
        {
            _address = new(_fractal.Table, _fractal.Placement, _pose.Camera.Position);
            _address.Move(Vector.Zero);
            _focusDistance *= Math.Exp(-_address.LogUnit);
            _pose = _pose with { Camera = _pose.Camera with { Position = Vector.Zero }, Steps = _pose.Steps + 1 };
        }
    }

    private double DistanceToCentre(Camera camera) => camera.Map(_bounds.Centre).Z switch
    {
        var depth when depth > 1e-3 * _size => depth,
        _ => _size,
    };

    private sealed record Pose(Camera Camera, Projection Projection, double? OrthographicHeight, long Steps);
}
