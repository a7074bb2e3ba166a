using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.State;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Widgets;

/// <summary>Shows where the axes of the world point, in a corner of the frame. A click on an end views along its axis.</summary>
internal sealed class AxisGizmo(WindowActions actions)
{
    // Distance of the knobs from the middle, pixels at scale 1.
    private const double Radius = 34;

    private static readonly (string Label, Vector Axis, Colour Colour)[] Ends =
    [
        ("x", Vector.I, new(0.62, 0.16, 0.16)), ("y", Vector.J, new(0.16, 0.42, 0.12)), ("z", Vector.K, new(0.16, 0.30, 0.66)),
        ("-x", -Vector.I, new(0.32, 0.13, 0.13)), ("-y", -Vector.J, new(0.13, 0.26, 0.11)), ("-z", -Vector.K, new(0.13, 0.18, 0.36)),
    ];

    /// <summary>Adds the knobs, the nearest in front of the others. Panels that are added later lie before them.</summary>
    public void Build(UserInterface ui)
    {
        if (actions.Document is not { Physics.IsWalking: false } document || ui.SceneArea is not { Width: > 200, Height: > 160 } area)
        {
            return;
        }

        var camera = document.Camera;
        var middle = (X: area.Right - (1.5 * Radius * ui.Scale), Y: area.Y + (1.5 * Radius * ui.Scale));
        foreach (var (label, axis, colour) in Ends.OrderByDescending(end => (camera.LocalAxesInverse * end.Axis).Z))
        {
            var (right, up, _) = camera.LocalAxesInverse * axis;
            if (ui.Knob(label, middle.X + (Radius * ui.Scale * right), middle.Y - (Radius * ui.Scale * up), colour))
            {
                document.MoveCamera((flying, aspect) => flying.LookAlong(camera.Handedness.Mirror(-axis), aspect), Aspect(document));
                actions.RequestDraw();
            }

            ui.Tooltip($"view from {label}");
        }
    }

    private static double Aspect(Document document) => document.LatestView?.Aspect ?? document.Area.Aspect;
}
