using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.Widgets;
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

        ui.Actions(actions, choose, 2, "pause", "step", "drop-ball", "throw-ball", "reset-bodies", "walk");
        ui.Actions(actions, choose, 1, "shrinking", "closest-points", "next-collider");
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
