using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.State;
using FractalEngine.App.Window.Widgets;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Panels;

/// <summary>The panel of bodies and their collider.</summary>
internal sealed class PhysicsPanel(WindowActions actions)
{
    public void Build(UserInterface ui, Document document)
    {
        ui.Actions(actions, 2, "pause", "step", "drop-ball", "throw-ball", "reset-bodies", "walk");
        ui.Actions(actions, 1, "shrinking", "closest-points", "next-collider");
        var speed = document.Physics.Speed;
        if (ui.Slider("speed", ref speed, 0, 4, 0.05))
        {
            document.Physics.Speed = speed;
        }

        ui.Tooltip("seconds of the simulation, and of the film, in a second");
        var time = document.Film?.Time ?? 0;
        if (document.Film is { Duration: var duration } && ui.Slider("film", ref time, 0, duration, 0.05))
        {
            document.SeekFilm(time, ui.Interaction);
            actions.RequestDraw();
        }

        ui.Row(1);
        foreach (var line in document.Physics.StatusText.Split('\n').SelectMany(static line => line.Split(" · ")))
        {
            ui.Paragraph(line);
        }
    }
}
