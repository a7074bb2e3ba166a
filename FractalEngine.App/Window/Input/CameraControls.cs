using FractalEngine.Core.Maths;
using FractalEngine.Render.Cameras;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Input;

/// <summary>
/// Translates keys and mouse into movements of a camera: flying, orbiting, panning, zooming and fixed views. Takes events and time as
/// arguments, so it needs neither a window nor a clock.
/// </summary>
/// <param name="camera">The camera to move at first.</param>
internal sealed class CameraControls(FlyingCamera camera)
{
    /// <summary>Angle in radians by which the mouse turns a camera per pixel: about 220° across 1280 pixels.</summary>
    public const double RadiansPerPixel = 0.003;

    private const double ZoomPerNotch = 0.88;
    private const double SpeedModifierFactor = 4;

    // A tapped key may be released before the next advance. It moves as far as a key that is held for this time.
    private static readonly TimeSpan TapDuration = TimeSpan.FromSeconds(0.05);

    private readonly HeldKeys _heldKeys = new();
    private MouseButton? _draggedButton;
    private (double X, double Y)? _pointer;
    private KeyModifiers _modifiers;

    /// <summary>The camera to move. Keys and buttons that are held go on with another one.</summary>
    public FlyingCamera Camera { get; set; } = camera;

    /// <summary>
    /// The part of the frame that shows the scene, in pixels; null until it is known. The wheel zooms to the pointer in it.
    /// </summary>
    public (int X, int Y, int Width, int Height)? Viewport { get; set; }

    /// <summary>True while held keys move the camera, so that <see cref="Advance"/> must be called.</summary>
    public bool IsMoving => !_modifiers.HasFlag(KeyModifiers.Control) && Direction != Vector.Zero;

    private Vector Direction => new(_heldKeys.Right, _heldKeys.Up, _heldKeys.Forward);

    /// <summary>Processes an event; events without a meaning for the camera are ignored.</summary>
    /// <param name="windowEvent">Any event of the window.</param>
    /// <param name="aspect">Width divided by height of the frame.</param>
    /// <param name="move">Moves the camera where the event is a key of such an action; null for other events.</param>
    /// <returns>True when the view has changed.</returns>
    public bool Handle(WindowEvent windowEvent, double aspect, Action<FlyingCamera, double>? move = null)
    {
        var poseBefore = Camera.Pose;
        // A letter of a command such as Ctrl+S does not move the camera, even if Ctrl is released before it.
        if (windowEvent is not KeyPressed { Modifiers: var modifiers } || !modifiers.HasFlag(KeyModifiers.Control))
        {
            _heldKeys.Handle(windowEvent);
        }

        if (windowEvent is MouseMoved { X: var x, Y: var y })
        {
            _pointer = (x, y);
        }

        switch (windowEvent)
        {
            case KeyPressed pressed:
                _modifiers = pressed.Modifiers;
                move?.Invoke(Camera, aspect);
                if (!pressed.IsRepeat)
                {
                    Advance(TapDuration);
                }

                break;
            case KeyReleased released:
                _modifiers = released.Modifiers;
                break;
            case MousePressed pressed:
                _draggedButton = pressed.Button;
                _modifiers = pressed.Modifiers;
                break;
            case MouseReleased or FocusLost:
                _draggedButton = null;
                break;
            case MouseMoved moved when _draggedButton is { } button:
                Drag(button, moved.DeltaX, moved.DeltaY, aspect);
                break;
            case WheelTurned wheel:
                ZoomToPointer(Math.Pow(ZoomPerNotch, wheel.Notches));
                break;
        }

        return Camera.Pose != poseBefore;
    }

    public void ReleaseKeys() => _heldKeys.Clear();

    /// <summary>Moves the camera for a time in the direction of the held keys.</summary>
    /// <returns>True when the view has changed.</returns>
    public bool Advance(TimeSpan time)
    {
        if (!IsMoving)
        {
            return false;
        }

        var distancePerSecond = Camera.Speed
            * (_modifiers.HasFlag(KeyModifiers.Shift) ? SpeedModifierFactor : 1)
            / (_modifiers.HasFlag(KeyModifiers.Alt) ? SpeedModifierFactor : 1);
        Camera.Move(time.TotalSeconds * distancePerSecond * Direction.UnitVector());
        return true;
    }

    /// <summary>Zooms to what is under the pointer, or to the middle of the frame where the pointer is unknown.</summary>
    private void ZoomToPointer(double factor)
    {
        if (_pointer is not var (x, y) || Viewport is not { Height: > 0 } viewport)
        {
            Camera.Zoom(factor);
            return;
        }

        var right = (x - viewport.X - (0.5 * viewport.Width)) / (0.5 * viewport.Height);
        var down = (y - viewport.Y - (0.5 * viewport.Height)) / (0.5 * viewport.Height);
        Camera.Zoom(factor, right, -down);
    }

    private void Drag(MouseButton button, double deltaX, double deltaY, double aspect)
    {
        var yaw = RadiansPerPixel * deltaX;
        var pitch = -RadiansPerPixel * deltaY;
        if (button == MouseButton.Middle || (button == MouseButton.Left && _modifiers.HasFlag(KeyModifiers.Shift)))
        {
            // The point in focus follows the pointer: this is the width of a pixel at its distance.
            var distancePerPixel = RadiansPerPixel * Camera.FocusDistance * Math.Min(1, aspect);
            Camera.Move(new(-distancePerPixel * deltaX, distancePerPixel * deltaY, 0));
        }
        else if (button == MouseButton.Left)
        {
            Camera.Orbit(yaw, pitch);
        }
        else
        {
            Camera.Turn(yaw, pitch);
        }
    }
}
