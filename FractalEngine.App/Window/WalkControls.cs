using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>Turns keys and mouse into where a player walks and looks.</summary>
internal sealed class WalkControls
{
    // Radians a pixel, as for the free camera.
    private const double TurnPerPixel = 0.003;

    // Of the height, below the top.
    private const double EyesBelowTop = 0.08;

    private readonly HashSet<Key> _held = [];
    private bool _looks;

    /// <summary>Where the player looks; its position is not used.</summary>
    public Camera Direction { get; set; } = Camera.Default;

    /// <summary>Lets go of all keys.</summary>
    public void Release()
    {
        _held.Clear();
        _looks = false;
    }

    /// <summary>Takes in an event.</summary>
    /// <returns>True when the player looks elsewhere.</returns>
    public bool Handle(WindowEvent windowEvent, Walker walker)
    {
        var before = Direction;
        switch (windowEvent)
        {
            case KeyPressed { Key: Key.Space, IsRepeat: false }:
                walker.Jump();
                break;
            case KeyPressed pressed:
                _held.Add(pressed.Key);
                break;
            case KeyReleased released:
                _held.Remove(released.Key);
                break;
            case MousePressed:
                _looks = true;
                break;
            case MouseReleased:
                _looks = false;
                break;
            case MouseMoved moved when _looks:
                Direction = CameraNavigation.Turn(Direction, TurnPerPixel * moved.DeltaX, -TurnPerPixel * moved.DeltaY);
                break;
            case FocusLost:
                _held.Clear();
                _looks = false;
                break;
        }

        walker.Wish = Wish(walker.Up);
        return Direction != before;
    }

    /// <summary>The view from the player's eyes.</summary>
    /// <param name="walker">The player.</param>
    /// <param name="part">How far between two steps, see <see cref="Body.MapAt"/>.</param>
    public Camera Eyes(Walker walker, double part)
    {
        var middle = walker.PreviousPosition + (part * (walker.Position - walker.PreviousPosition));
        return Direction with { Position = middle + ((0.5 - EyesBelowTop) * walker.Description.Height * walker.Up) };
    }

    private Vector Wish(Vector up)
    {
        var (right, _, forward) = Direction.LocalAxes;
        // Looking down does not slow down.
        var ahead = Level(forward, up) is var level && level != Vector.Zero ? level : Level(Direction.LocalAxes.V2, up);
        var wish = ((Axis(Key.W, Key.Up) - Axis(Key.S, Key.Down)) * ahead) + ((Axis(Key.D, Key.Right) - Axis(Key.A, Key.Left)) * Level(right, up));
        return Unit(wish);
    }

    private static Vector Level(Vector vector, Vector up) => Unit(vector - (Vector.Dot(vector, up) * up));

    private static Vector Unit(Vector vector) => vector == Vector.Zero ? vector : vector.UnitVector();

    private double Axis(Key letter, Key arrow) => _held.Contains(letter) || _held.Contains(arrow) ? 1 : 0;
}
