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
        if (ui.Slider("speed", document.Physics.Speed, 0, 4, 0.05) is { } speed)
        {
            document.Physics.Speed = speed;
        }

        ui.Tooltip("seconds of the simulation, and of the film, in a second");
        if (document.Film is { } film && ui.Slider("film", film.Time, 0, film.Duration, 0.05) is { } time)
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
