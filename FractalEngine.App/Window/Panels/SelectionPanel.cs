using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.State;
using FractalEngine.App.Window.Tools;
using FractalEngine.App.Window.Widgets;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Panels;

/// <summary>The panel of what was clicked and measured.</summary>
internal sealed class SelectionPanel(WindowActions actions)
{
    private readonly PlacementFields _placement = new(actions);

    public void Build(UserInterface ui, Document document)
    {
        if (document.Tool.Selected is { } selected)
        {
            foreach (var (name, value) in selected.Facts)
            {
                ui.Row(9, 1);
                ui.Label(name, isDim: true);
                ui.Paragraph(value);
            }

            ui.Actions(actions, 2, "select-up", "copy-selection");
            if (selected is { Depth: > 0, Object.Model.SourcePath: { } path } && path.EndsWith(".fdo", StringComparison.OrdinalIgnoreCase))
            {
                ui.Row(1);
                if (ui.Button("Its numbers"))
                {
                    actions.Panels.Open("fractal");
                }

                ui.Tooltip("shows the panel of the fractal, where the vectors that place this part are marked");
            }

            BuildPlacement(ui, document, selected.ObjectIndex);
        }
        else
        {
            ui.Paragraph("Click a surface to select it.");
        }

        BuildMeasuring(ui, document.Tool.Measure);
    }

    /// <summary>Adds the handles of the object and its numbers, where it belongs to a scene.</summary>
    private void BuildPlacement(UserInterface ui, Document document, int index)
    {
        var objects = document.File.Scene.Scene.Objects;
        if (document.File.Kind != FileKind.Scene || index >= objects.Length)
        {
            return;
        }

        ui.Heading("Handles");
        ui.Actions(actions, 3, "handles-move", "handles-turn", "handles-scale");
        if (document.Tool.Handles != HandleKind.None)
        {
            ui.Scope($"object {index}", () => _placement.Build(ui, objects[index], index));
        }
    }

    private void BuildMeasuring(UserInterface ui, MeasureTool measure)
    {
        ui.Heading("Distances");
        ui.Actions(actions, 1, "measure");
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
