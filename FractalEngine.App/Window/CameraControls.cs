using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
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

    // A key that is only tapped, and may be up again before time is told, moves as far as one that is held so long.
    private static readonly TimeSpan Tap = TimeSpan.FromSeconds(0.05);

    private readonly HashSet<Key> _held = [];
    private readonly double _size;
    private readonly BoundingBox _bounds;
    private readonly Pose _initial;
    private MouseButton? _dragged;
    private KeyModifiers _modifiers;
    private Pose _pose;
    private double _focusDistance;

    /// <summary>Controls for one scene.</summary>
    /// <param name="bounds">Of the scene, world space: sets speed and focus.</param>
    /// <param name="camera">Where to begin, and where Enter leads back to.</param>
    /// <param name="projection">Likewise.</param>
    /// <param name="orthographicHeight">Likewise; null where it follows the camera.</param>
    public CameraControls(BoundingBox bounds, Camera camera, Projection projection, double? orthographicHeight)
    {
        _bounds = bounds.IsEmpty ? new(-Vector.One, Vector.One) : bounds;
        _size = Math.Max(_bounds.Diagonal, 1e-9 * (1 + _bounds.Centre.MaximumComponent()));
        _pose = _initial = new(camera, projection, orthographicHeight);
        _focusDistance = DistanceToCentre(camera);
    }

    /// <summary>Where the scene is seen from now.</summary>
    public Camera Camera => _pose.Camera;

    /// <summary>How.</summary>
    public Projection Projection => _pose.Projection;

    /// <summary>The visible height that the scene states, zoomed; null where it follows the camera.</summary>
    public double? OrthographicHeight => _pose.OrthographicHeight;

    /// <summary>True while keys are held that move the camera: time must be told by <see cref="Advance"/>.</summary>
    public bool IsMoving => !_modifiers.HasFlag(KeyModifiers.Control) && Direction() != Vector.Zero;

    /// <summary>The point that the camera turns about and zooms to: straight ahead, as far as the scene's centre was.</summary>
    private Vector Focus => Camera.Position + (_focusDistance * Camera.LocalAxes.V3);

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

    /// <summary>Moves on for a while, as the held keys say.</summary>
    /// <returns>True when the view changed.</returns>
    public bool Advance(TimeSpan time)
    {
        if (!IsMoving)
        {
            return false;
        }

        var speed = SizesPerSecond * _size
            * (_modifiers.HasFlag(KeyModifiers.Shift) ? SpeedFactor : 1)
            / (_modifiers.HasFlag(KeyModifiers.Alt) ? SpeedFactor : 1);
        Move(CameraNavigation.Move(Camera, time.TotalSeconds * speed * Direction().UnitVector()));
        return true;
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
                _focusDistance = DistanceToCentre(Camera);
                break;
        }
    }

    private void LookAlong(Vector direction, double aspect) =>
        Frame(Camera with { Rotation = CameraFraming.LookRotation(direction) }, aspect);

    private void Frame(Camera camera, double aspect)
    {
        Move(CameraFraming.Frame(camera, _bounds, aspect));
        _pose = _pose with { OrthographicHeight = null };
        _focusDistance = DistanceToCentre(Camera);
    }

    private void Drag(MouseButton button, double right, double down, double aspect)
    {
        var (turn, climb) = (TurnPerPixel * right, -TurnPerPixel * down);
        if (button == MouseButton.Middle || (button == MouseButton.Left && _modifiers.HasFlag(KeyModifiers.Shift)))
        {
            // The point in focus follows the pointer: a pixel is as wide there as the picture shows it.
            var perPixel = TurnPerPixel * _focusDistance * Math.Min(1, aspect);
            Move(CameraNavigation.Move(Camera, new(-perPixel * right, perPixel * down, 0)));
        }
        else if (button == MouseButton.Left)
        {
            Move(CameraNavigation.Orbit(Camera, Focus, turn, climb));
        }
        else
        {
            Move(CameraNavigation.Turn(Camera, turn, climb));
        }
    }

    private void Zoom(double factor)
    {
        Move(CameraNavigation.Zoom(Camera, Focus, factor));
        _focusDistance *= factor;
        _pose = _pose with { OrthographicHeight = factor * _pose.OrthographicHeight };
    }

    private void Move(Camera camera) => _pose = _pose with { Camera = camera };

    private double DistanceToCentre(Camera camera) => camera.Map(_bounds.Centre).Z switch
    {
        var depth when depth > 1e-3 * _size => depth,
        _ => _size,
    };

    private sealed record Pose(Camera Camera, Projection Projection, double? OrthographicHeight);
}
