using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Input;

/// <summary>Translates keys and mouse into the walking direction and the gaze of a player.</summary>
internal sealed class WalkControls
{
    // Depth of the eyes below the top of the player, divided by its height.
    private const double EyeDepthFraction = 0.08;

    private readonly HeldKeys _heldKeys = new();
    private bool _isLooking;

    // How far the ground had turned the player when its gaze was last asked for, radians.
    private double _carriedAngle;

    /// <summary>The camera that looks in the player's direction; its position is not used.</summary>
    public Camera Direction { get; set; } = Camera.Default;

    /// <summary>Begins a walk that looks where a camera does, however far the ground has turned the player.</summary>
    /// <param name="direction">The camera; its position is not used.</param>
    /// <param name="controller">The player.</param>
    /// <param name="alpha">The fraction of a step since the last one, as <see cref="EyeCamera"/> has it.</param>
    public void Begin(Camera direction, CharacterController controller, double alpha)
    {
        ReleaseKeys();
        Direction = direction;
        _carriedAngle = CarriedAngle(controller, alpha);
    }

    /// <summary>Releases all keys and mouse buttons.</summary>
    public void ReleaseKeys()
    {
        _heldKeys.Clear();
        _isLooking = false;
    }

    /// <summary>Processes an event, and updates the move input of the player.</summary>
    /// <returns>True when the direction of the gaze has changed.</returns>
    public bool Handle(WindowEvent windowEvent, CharacterController controller)
    {
        var directionBefore = Direction;
        _heldKeys.Handle(windowEvent);
        switch (windowEvent)
        {
            case KeyPressed { Key: Key.Space, IsRepeat: false }:
                controller.Jump();
                break;
            case MousePressed:
                _isLooking = true;
                break;
            case MouseReleased or FocusLost:
                _isLooking = false;
                break;
            case MouseMoved moved when _isLooking:
                Direction = CameraNavigation.Turn(
                    Direction, CameraControls.RadiansPerPixel * moved.DeltaX, -CameraControls.RadiansPerPixel * moved.DeltaY);
                break;
        }

        controller.MoveInput = ComputeMoveInput(controller.Up);
        return Direction != directionBefore;
    }

    /// <summary>Returns the camera at the player's eyes. Ground that turns has turned its gaze.</summary>
    /// <param name="controller">The player.</param>
    /// <param name="alpha">The fraction of a step since the last one, from 0 to 1; see <see cref="Body.InterpolatedMap"/>.</param>
    public Camera EyeCamera(CharacterController controller, double alpha)
    {
        var angle = CarriedAngle(controller, alpha);
        if (angle != _carriedAngle)
        {
            var turn = Direction.Handedness == Handedness.Right ? _carriedAngle - angle : angle - _carriedAngle;
            Direction = CameraNavigation.Turn(Direction, turn, 0);
            _carriedAngle = angle;
            controller.MoveInput = ComputeMoveInput(controller.Up);
        }

        var centre = controller.PreviousPosition + (alpha * (controller.Position - controller.PreviousPosition));
        return Direction with { Position = centre + ((0.5 - EyeDepthFraction) * controller.Description.Height * controller.Up) };
    }

    private static double CarriedAngle(CharacterController controller, double alpha) =>
        controller.PreviousCarriedAngle + (alpha * (controller.CarriedAngle - controller.PreviousCarriedAngle));

    private Vector ComputeMoveInput(Vector up)
    {
        var (right, cameraUp, forward) = Direction.LocalAxes;
        var groundForward = ProjectToGround(forward, up);
        if (groundForward == Vector.Zero)
        {
            // The gaze is vertical, so the top of the view counts as ahead.
            groundForward = ProjectToGround(cameraUp, up);
        }

        return UnitOrZero((_heldKeys.Forward * groundForward) + (_heldKeys.Right * ProjectToGround(right, up)));
    }

    /// <summary>Projects a direction to the ground. The result is a unit vector, so that looking down does not slow the player.</summary>
    private static Vector ProjectToGround(Vector vector, Vector up) => UnitOrZero(vector - (Vector.Dot(vector, up) * up));

    private static Vector UnitOrZero(Vector vector) => vector == Vector.Zero ? vector : vector.UnitVector();
}
