using FractalEngine.App.Window.Actions;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Panels;

/// <summary>The panel of bodies and their collider.</summary>
/// <param name="actions">The window with the document.</param>
/// <param name="choose">Runs an action.</param>
internal sealed class PhysicsPanel(WindowActions actions, Action<WindowAction> choose)
{
    /// <summary>Adds the widgets of the panel.</summary>
    public void Build(UserInterface ui)
    {
        if (actions.Document is not { } document)
        {
            ui.Label("no scene", isDim: true);
            return;
        }

        ui.Row(1, 1);
        ui.Action(actions, "pause", choose);
        ui.Action(actions, "step", choose);
        ui.Action(actions, "drop-ball", choose);
        ui.Action(actions, "throw-ball", choose);
        ui.Action(actions, "reset-bodies", choose);
        ui.Action(actions, "walk", choose);
        ui.Row(1);
        ui.Action(actions, "shrinking", choose);
        ui.Action(actions, "closest-points", choose);
        ui.Action(actions, "next-collider", choose);
        var speed = document.Physics.Speed;
        if (ui.Slider("speed", ref speed, 0, 4, 0.05))
        {
            document.Physics.Speed = speed;
        }

        ui.Tooltip("seconds of the simulation in a second");
        ui.Row(1);
        foreach (var line in document.Physics.StatusText.Split('\n').SelectMany(static line => line.Split(" · ")))
        {
            ui.Paragraph(line);
        }
    }
}
