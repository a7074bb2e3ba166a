using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Character;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>Turns keys and mouse into where a player walks and looks.</summary>
internal sealed class WalkControls
{
    // Radians a pixel, as for the free camera.
    private const double RadiansPerPixel = 0.003;

    // Of the height, below the top.
    private const double EyeDepthFraction = 0.08;

    private readonly HashSet<Key> _heldKeys = [];
    private bool _isLooking;

    /// <summary>Where the player looks; its position is not used.</summary>
    public Camera Direction { get; set; } = Camera.Default;

    /// <summary>Lets go of all keys.</summary>
    public void ReleaseKeys()
    {
        _heldKeys.Clear();
        _isLooking = false;
    }

    /// <summary>Takes in an event.</summary>
    /// <returns>True when the player looks elsewhere.</returns>
    public bool Handle(WindowEvent windowEvent, CharacterController controller)
    {
        var before = Direction;
        switch (windowEvent)
        {
            case KeyPressed { Key: Key.Space, IsRepeat: false }:
                controller.Jump();
                break;
            case KeyPressed pressed:
                _heldKeys.Add(pressed.Key);
                break;
            case KeyReleased released:
                _heldKeys.Remove(released.Key);
                break;
            case MousePressed:
                _isLooking = true;
                break;
            case MouseReleased:
                _isLooking = false;
                break;
            case MouseMoved moved when _isLooking:
                Direction = CameraNavigation.Turn(Direction, RadiansPerPixel * moved.DeltaX, -RadiansPerPixel * moved.DeltaY);
                break;
            case FocusLost:
                _heldKeys.Clear();
                _isLooking = false;
                break;
        }

        controller.MoveInput = ComputeMoveInput(controller.Up);
        return Direction != before;
    }

    /// <summary>The view from the player's eyes.</summary>
    /// <param name="controller">The player.</param>
    /// <param name="alpha">How far between two steps, see <see cref="Body.InterpolatedMap"/>.</param>
    public Camera EyeCamera(CharacterController controller, double alpha)
    {
        var centre = controller.PreviousPosition + (alpha * (controller.Position - controller.PreviousPosition));
        return Direction with { Position = centre + ((0.5 - EyeDepthFraction) * controller.Description.Height * controller.Up) };
    }

    private Vector ComputeMoveInput(Vector up)
    {
        var (right, _, forward) = Direction.LocalAxes;
        // Looking down does not slow down.
        var groundForward = ProjectToGround(forward, up) is var groundDirection && groundDirection != Vector.Zero
            ? groundDirection
            : ProjectToGround(Direction.LocalAxes.V2, up);
        var input = ((Axis(Key.W, Key.Up) - Axis(Key.S, Key.Down)) * groundForward)
            + ((Axis(Key.D, Key.Right) - Axis(Key.A, Key.Left)) * ProjectToGround(right, up));
        return UnitOrZero(input);
    }

    private static Vector ProjectToGround(Vector vector, Vector up) => UnitOrZero(vector - (Vector.Dot(vector, up) * up));

    private static Vector UnitOrZero(Vector vector) => vector == Vector.Zero ? vector : vector.UnitVector();

    private double Axis(Key letter, Key arrow) => _heldKeys.Contains(letter) || _heldKeys.Contains(arrow) ? 1 : 0;
}
