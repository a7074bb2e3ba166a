using System.Globalization;
using FractalEngine.App.Window.Actions;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Panels;

/// <summary>Widgets that several panels have.</summary>
internal static class PanelWidgets
{
    /// <summary>Adds a check box or a button for an action, with its help.</summary>
    /// <param name="ui">The interface that is being built.</param>
    /// <param name="actions">The window with the document.</param>
    /// <param name="id">Id of the action in the table.</param>
    /// <param name="choose">Runs the action.</param>
    public static void Action(this UserInterface ui, WindowActions actions, string id, Action<WindowAction> choose)
    {
        var action = ActionTable.Get(id);
        var isAvailable = action.IsAvailable(actions);
        if (action.IsOn is { } isOn && isAvailable)
        {
            var isChecked = isOn(actions);
            if (ui.CheckBox(action.Name, ref isChecked))
            {
                choose(action);
            }
        }
        else if (ui.Button(action.Name, isAvailable))
        {
            choose(action);
        }

        ui.Tooltip($"{action.Help} ({action.KeyText})");
    }

    /// <summary>Adds a name and its value in one row.</summary>
    public static void Fact(this UserInterface ui, string name, string value)
    {
        ui.Row(0.42, 0.58);
        ui.Label(name, isDim: true);
        if (value.Length > 20)
        {
            ui.Paragraph(value);
        }
        else
        {
            ui.Value(value);
        }
    }

    /// <summary>Formats a number for people, with at most six digits.</summary>
    public static string Number(double value) => value.ToString("G6", CultureInfo.InvariantCulture);
}
