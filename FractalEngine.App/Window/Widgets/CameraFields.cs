using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.State;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Widgets;

/// <summary>The camera of a scene as numbers, in the scene's panel. Ctrl+S writes it into the scene's line <c>c</c>.</summary>
internal sealed class CameraFields(WindowActions actions)
{
    private const double DegreesPerRadian = 180 / Math.PI;

    private bool _isOpen;
    private int _startInteraction = -1;
    private Camera? _start;

    public void Build(UserInterface ui, Document document)
    {
        if (!ui.Branch("Camera", ref _isOpen))
        {
            return;
        }

        if (document.VisibleDepth > 0 || document.Physics.IsWalking)
        {
            ui.Paragraph(document.Physics.IsWalking ? "The player has the camera." : "The camera is deep in a fractal: zoom out.");
            return;
        }

        var camera = document.Camera;
        if (ui.Interaction != _startInteraction || _start is null)
        {
            _startInteraction = ui.Interaction;
            _start = camera;
        }

        ui.Scope("camera", () =>
        {
            var reach = document.File.Scene.Bounds.FiniteDiagonalOr(1);
            var position = ui.Vector("position", camera.Position, _start.Position, reach, 0);
            var degrees = Degrees(camera);
            var rotation = ui.Vector("rotation in degrees", degrees, Degrees(_start), 180, 0.5);
            if (position != camera.Position || rotation != degrees)
            {
                var radians = rotation == degrees ? camera.Rotation : rotation / DegreesPerRadian;
                var moved = camera with { Position = position, Rotation = radians };
                document.MoveCamera((flying, _) => flying.MoveTo(moved), 1, ui.Interaction);
                actions.RequestDraw();
            }
        });
    }

    /// <summary>Returns the angles of a camera in degrees, with as many digits as a slider needs.</summary>
    private static Vector Degrees(Camera camera)
    {
        var (pitch, yaw, roll) = DegreesPerRadian * camera.Rotation;
        return new(Math.Round(pitch, 9), Math.Round(yaw, 9), Math.Round(roll, 9));
    }
}
