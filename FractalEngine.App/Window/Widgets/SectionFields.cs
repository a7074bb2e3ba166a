using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.State;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Widgets;

/// <summary>The section plane as numbers, in the panel of the view.</summary>
internal sealed class SectionFields(WindowActions actions)
{
    // The plane at the beginning of a drag, around which the sliders reach.
    private int _startInteraction = -1;
    private SectionPlane _start;

    public void Build(UserInterface ui, Document document)
    {
        ui.Heading("Section");
        ui.Actions(actions, 2, "section", "section-cap");
        if (document.Section.Shown is not { } plane)
        {
            return;
        }

        if (ui.Interaction != _startInteraction)
        {
            _startInteraction = ui.Interaction;
            _start = plane;
        }

        ui.Row(1, 1, 1, 1);
        var changed = plane;
        foreach (var (label, axis) in ((string, Vector)[])[("x", Vector.I), ("y", Vector.J), ("z", Vector.K)])
        {
            if (ui.Button(label))
            {
                var middle = Tools.SectionTool.MiddleOf(plane, document.File.Scene.Bounds);
                changed = plane with { Normal = axis, Distance = Vector.Dot(axis, middle) };
            }

            ui.Tooltip($"across the axis {label}");
        }

        ui.Action(actions, "flip-section");
        changed = BuildSliders(ui, document, changed);
        if (changed != plane)
        {
            document.Section.Set(changed);
            actions.RequestDraw();
        }
    }

    private SectionPlane BuildSliders(UserInterface ui, Document document, SectionPlane plane)
    {
        var reach = 0.5 * document.File.Scene.Bounds.FiniteDiagonalOr(1);
        ui.Row(1);
        if (ui.Slider("distance", plane.Distance, _start.Distance - reach, _start.Distance + reach, isBounded: false) is { } distance)
        {
            plane = plane with { Distance = distance };
        }

        ui.Tooltip("signed distance of the plane from the origin; what is farther along the normal is cut away");
        var normal = ui.Vector("normal", plane.Normal, Vector.Zero, 1, 0.01);
        var length = normal.Length();
        if (normal != plane.Normal && length > 0)
        {
            // The plane turns about its point in the middle of the scene.
            var middle = Tools.SectionTool.MiddleOf(plane, document.File.Scene.Bounds);
            plane = plane with { Normal = normal / length, Distance = Vector.Dot(normal, middle) / length };
        }

        return plane;
    }
}
