using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.Selecting;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Panels;

/// <summary>The panel of what was clicked and measured.</summary>
/// <param name="actions">The window with the document.</param>
/// <param name="choose">Runs an action.</param>
internal sealed class SelectionPanel(WindowActions actions, Action<WindowAction> choose)
{
    /// <summary>Adds the widgets of the panel.</summary>
    public void Build(UserInterface ui)
    {
        if (actions.Document is not { } document)
        {
            ui.Label("no scene", isDim: true);
            return;
        }

        if (document.Tool.Selected is { } selected)
        {
            foreach (var (name, value) in selected.Facts)
            {
                ui.Row(9, 1);
                ui.Label(name, isDim: true);
                ui.Paragraph(value);
            }

            ui.Row(1, 1);
            ui.Action(actions, "select-up", choose);
            ui.Action(actions, "copy-selection", choose);
        }
        else
        {
            ui.Paragraph("Click a surface to select it.");
        }

        BuildMeasuring(ui, document.Tool.Measure);
    }

    private void BuildMeasuring(UserInterface ui, MeasureTool measure)
    {
        ui.Heading("Distances");
        ui.Row(1);
        ui.Action(actions, "measure", choose);
        foreach (var (kind, name) in ((MeasureKind, string)[])
            [(MeasureKind.Points, "two points"), (MeasureKind.PointToObject, "point to object"), (MeasureKind.Objects, "two objects")])
        {
            if (ui.Selectable(name, measure.Kind == kind))
            {
                measure.Kind = kind;
            }
        }

        if (measure.IsActive)
        {
            ui.Label(measure.Hint);
        }

        for (var i = 0; i < measure.Dimensions.Length; i++)
        {
            var dimension = measure.Dimensions[i];
            ui.Scope(i, () =>
            {
                ui.Row(1, 10, 3);
                ui.Label(dimension.What, isDim: true);
                ui.Value(dimension.LengthText);
                if (ui.Button("×"))
                {
                    measure.Remove(dimension);
                    actions.RequestDraw();
                }
            });
        }
    }
}
