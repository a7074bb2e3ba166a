using System.Globalization;
using FractalEngine.App.Window.Actions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Widgets;

/// <summary>Widgets that several panels have.</summary>
internal static class PanelWidgets
{
    /// <summary>Adds a check box or a button for an action, with its help.</summary>
    public static void Action(this UserInterface ui, WindowActions actions, string id)
    {
        var action = ActionTable.Get(id);
        var isAvailable = action.IsAvailable(actions);
        if (action.IsOn is { } isOn && isAvailable)
        {
            if (ui.CheckBox(action.Name, isOn(actions)))
            {
                actions.Choose(action);
            }
        }
        else if (ui.Button(action.Name, isAvailable))
        {
            actions.Choose(action);
        }

        ui.Tooltip(action.KeyText.Length > 0 ? $"{action.PlainHelp} ({action.KeyText})" : action.PlainHelp);
    }

    /// <summary>Adds rows of check boxes and buttons for actions, in columns of equal width.</summary>
    public static void Actions(this UserInterface ui, WindowActions actions, int columns, params ReadOnlySpan<string> ids)
    {
        ui.Row([.. Enumerable.Repeat(1.0, columns)]);
        foreach (var id in ids)
        {
            ui.Action(actions, id);
        }
    }

    /// <summary>Adds a name and its value in one row.</summary>
    /// <param name="ui">The interface that is being built.</param>
    /// <param name="name">What the value is.</param>
    /// <param name="value">The value, which is wrapped where it is long.</param>
    /// <param name="explanation">What is shown while the pointer is over the name; null for nothing.</param>
    public static void Fact(this UserInterface ui, string name, string value, string? explanation = null)
    {
        ui.Row(name.Length + 1, 1);
        ui.Label(name, isDim: true);
        if (explanation is not null)
        {
            ui.Tooltip(explanation);
        }

        if (name.Length + value.Length > 31)
        {
            ui.Paragraph(value);
        }
        else
        {
            ui.Value(value);
        }
    }

    /// <summary>Adds a slider for a number that is kept elsewhere.</summary>
    /// <returns>The changed number; null where it stays.</returns>
    public static double? Slider(
        this UserInterface ui, string label, double value, double minimum, double maximum, double step = 0, bool isBounded = true) =>
        ui.Slider(label, ref value, minimum, maximum, step, isBounded) ? value : null;

    /// <summary>Adds three sliders for the components of a vector.</summary>
    /// <param name="ui">The interface that is being built.</param>
    /// <param name="name">What the vector means.</param>
    /// <param name="value">The present vector.</param>
    /// <param name="start">The vector at the beginning of a drag, around which the sliders reach.</param>
    /// <param name="reach">How far a slider reaches to both sides; null for positive factors.</param>
    /// <param name="step">Dragging gives multiples of this; 0 for a thousandth of the range.</param>
    public static Vector Vector(this UserInterface ui, string name, Vector value, Vector start, double? reach, double step)
    {
        // Zero shows without a sign.
        var (x, y, z) = value + Core.Maths.Vector.Zero;
        ui.Row(1);
        ui.Label(name, isDim: true);
        ui.Row(1, 1, 1);
        ui.Scope(name, () =>
        {
            Slide("x", ref x, start.X);
            Slide("y", ref y, start.Y);
            Slide("z", ref z, start.Z);
        });
        return new Vector(x, y, z) + Core.Maths.Vector.Zero;

        void Slide(string axis, ref double component, double from)
        {
            var isFactor = reach is null && from > 0;
            var distance = reach ?? Math.Max(1, Math.Abs(from));
            ui.Slider(axis, ref component, isFactor ? 0.01 : from - distance, isFactor ? Math.Max(2, 2 * from) : from + distance, step,
                isBounded: false);
        }
    }

    /// <summary>Adds a colour with a slider for each component.</summary>
    /// <returns>The changed colour; null where it stays.</returns>
    public static Colour? Colour(this UserInterface ui, Colour colour)
    {
        var (red, green, blue) = (colour.Red, colour.Green, colour.Blue);
        ui.Row(1, 1, 1, 4);
        var isChanged = ui.Slider("r", ref red, 0, 1, 0.01) | ui.Slider("g", ref green, 0, 1, 0.01) | ui.Slider("b", ref blue, 0, 1, 0.01);
        ui.Swatch(colour);
        return isChanged ? new(red, green, blue) : null;
    }

    /// <summary>Makes a change in a vector of which other components may have changed, and are not loaded yet.</summary>
    public static Vector Merge(Vector present, Vector before, Vector after) => new(
        after.X.Equals(before.X) ? present.X : after.X,
        after.Y.Equals(before.Y) ? present.Y : after.Y,
        after.Z.Equals(before.Z) ? present.Z : after.Z);

    /// <summary>Makes a change in a colour of which other components may have changed, and are not loaded yet.</summary>
    /// <inheritdoc cref="Merge(Vector, Vector, Vector)"/>
    public static Colour Merge(Colour present, Colour before, Colour after) => new(
        after.Red.Equals(before.Red) ? present.Red : after.Red,
        after.Green.Equals(before.Green) ? present.Green : after.Green,
        after.Blue.Equals(before.Blue) ? present.Blue : after.Blue);

    /// <summary>Formats a number for people, with at most six digits.</summary>
    public static string Number(double value) => value.ToString("G6", CultureInfo.InvariantCulture);
}
