using FractalEngine.Core.Geometry;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui;

/// <content>The widgets of panels, menus and dialogs.</content>
public sealed partial class UserInterface
{
    /// <summary>Adds a text. What does not fit is shown while the pointer is over it.</summary>
    public void Label(string text, bool isDim = false)
    {
        ArgumentNullException.ThrowIfNull(text);
        PrintLabel(text, isDim ? Theme.DimText : Theme.Text, UiAlign.Left);
    }

    /// <summary>Adds a text at the right edge of its place, as numbers stand.</summary>
    public void Value(string text)
    {
        ArgumentNullException.ThrowIfNull(text);
        PrintLabel(text, Theme.Text, UiAlign.Right);
    }

    /// <summary>Adds the heading of what follows, in as many lines as it needs.</summary>
    public void Heading(string text)
    {
        ArgumentNullException.ThrowIfNull(text);
        Row(1);
        AddParagraph(text, Theme.Accent);
    }

    /// <summary>Adds a text in as many lines as its place needs.</summary>
    /// <param name="text">Words that are wrapped at blanks.</param>
    /// <param name="isWarning">True for a text that the user should notice.</param>
    /// <param name="isDim">True for a text of less importance.</param>
    public void Paragraph(string text, bool isWarning = false, bool isDim = false)
    {
        ArgumentNullException.ThrowIfNull(text);
        AddParagraph(text, isWarning ? Theme.Warning : isDim ? Theme.DimText : Theme.Text);
    }

    /// <summary>Adds a button that can be pressed.</summary>
    /// <param name="label">Text and identity of the button.</param>
    /// <param name="isEnabled">False for a button that can't be pressed now.</param>
    /// <returns>True when the button was pressed.</returns>
    public bool Button(string label, bool isEnabled = true)
    {
        ArgumentNullException.ThrowIfNull(label);
        var rect = Next();
        if (!isEnabled)
        {
            Frame(rect, Theme.Control);
            Print(label, rect.Inset(Gap), Theme.DimText, UiAlign.Middle);
            return false;
        }

        var touch = Touch(IdOf(label), rect, takesFocus: true);
        Fill(rect, touch.IsHeld ? Theme.Fill : touch.IsHot ? Theme.HotControl : Theme.Control, 3);
        if (!Print(label, rect.Inset(Gap), Theme.Text, UiAlign.Middle))
        {
            Tooltip(label);
        }

        DrawFocus(touch, rect);
        return touch.IsActivated;
    }

    /// <summary>Adds a check box with its label.</summary>
    /// <returns>True when the box was switched.</returns>
    public bool CheckBox(string label, ref bool isChecked)
    {
        ArgumentNullException.ThrowIfNull(label);
        var rect = Next();
        var touch = Touch(IdOf(label), rect, takesFocus: true);
        if (touch.IsActivated)
        {
            isChecked = !isChecked;
            _buildsAgain = true;
        }

        var box = new UiRect(rect.X, rect.Y + Gap, rect.Height - (2 * Gap), rect.Height - (2 * Gap));
        Fill(box, touch.IsHot ? Theme.HotControl : Theme.Field, 3);
        Frame(box, Theme.Border);
        if (isChecked)
        {
            Print("✓", box, Theme.Text, UiAlign.Middle);
        }

        var text = rect with { X = box.Right + Padding, Width = Math.Max(0, rect.Right - box.Right - Padding) };
        if (!Print(label, text, Theme.Text))
        {
            Tooltip(label);
        }

        DrawFocus(touch, rect);
        return touch.IsActivated;
    }

    /// <summary>Adds a row of a list.</summary>
    /// <param name="label">Text and identity of the row.</param>
    /// <param name="isSelected">Whether the row is the selected one.</param>
    /// <param name="depth">Depth in a tree, from 0.</param>
    /// <returns>True when the row was clicked.</returns>
    public bool Selectable(string label, bool isSelected, int depth = 0)
    {
        ArgumentNullException.ThrowIfNull(label);
        var rect = Next();
        var touch = Touch(IdOf(label), rect, takesFocus: true);
        if (isSelected || touch.IsHot)
        {
            Fill(rect, isSelected ? Theme.Selection : Theme.Control, 2);
        }

        var indent = Gap + (2 * depth * CellWidth);
        if (!Print(label, rect with { X = rect.X + indent, Width = Math.Max(0, rect.Width - indent - Gap) }, Theme.Text))
        {
            Tooltip(label);
        }

        DrawFocus(touch, rect);
        MoveFocusByArrows(touch);
        return touch.IsActivated;
    }

    /// <summary>Adds a branch of a tree, which opens and closes.</summary>
    /// <returns>True while the branch is open, and what is below it should be added.</returns>
    public bool Branch(string label, ref bool isOpen)
    {
        ArgumentNullException.ThrowIfNull(label);
        Row(1);
        var rect = Next();
        var touch = Touch(IdOf(label), rect, takesFocus: true);
        var isTurned = _focus == touch.Id && _input.TakeKey(isOpen ? Key.Left : Key.Right);
        _isKeyTaken |= isTurned;
        if (touch.IsActivated || isTurned)
        {
            isOpen = !isOpen;
            _buildsAgain = true;
        }

        if (touch.IsHot)
        {
            Fill(rect, Theme.Control, 2);
        }

        Print(isOpen ? "▼" : "▶", rect with { Width = 2 * CellWidth }, Theme.DimText);
        Print(label, rect with { X = rect.X + (2 * CellWidth), Width = Math.Max(0, rect.Width - (2 * CellWidth)) }, Theme.Accent);
        DrawFocus(touch, rect);
        MoveFocusByArrows(touch);
        return isOpen;
    }

    /// <summary>Adds a bar that shows how far something is.</summary>
    /// <param name="fraction">Completed fraction, from 0 to 1.</param>
    /// <param name="label">Text over the bar.</param>
    public void Progress(double fraction, string label)
    {
        ArgumentNullException.ThrowIfNull(label);
        var rect = Next();
        Fill(rect, Theme.Field, 3);
        Fill(rect with { Width = (int)(rect.Width * Math.Clamp(fraction, 0, 1)) }, Theme.Fill, 3);
        Print(label, rect.Inset(Gap), Theme.Text, UiAlign.Middle);
    }

    /// <summary>Adds a graph of columns, the last value at the right edge.</summary>
    /// <param name="values">Values from the oldest to the latest.</param>
    /// <param name="maximum">Value of a column as high as the graph.</param>
    /// <param name="rows">Height of the graph in rows.</param>
    public void Graph(IReadOnlyCollection<double> values, double maximum, int rows = 3)
    {
        ArgumentNullException.ThrowIfNull(values);
        var rect = Next(rows);
        Fill(rect, Theme.Field, 2);
        var width = Math.Max(1, CellWidth / 4);
        var count = Math.Min(values.Count, rect.Width / width);
        var x = rect.Right - (count * width);
        foreach (var value in values.Skip(values.Count - count))
        {
            var height = (int)Math.Ceiling(rect.Height * Math.Clamp(value / maximum, 0, 1));
            Fill(new(x, rect.Bottom - height, width, height), value > maximum ? Theme.Warning : Theme.Focus);
            x += width;
        }
    }

    /// <summary>Adds a field of one colour.</summary>
    public void Swatch(Colour colour)
    {
        var rect = Next();
        Fill(rect, colour, 3);
        Frame(rect, Theme.Border);
    }

    private void AddParagraph(string text, Colour colour)
    {
        var columns = Math.Max(8, NextWidth / CellWidth);
        var lines = text.Split('\n').SelectMany(line => Wrap(line, columns)).ToArray();
        var rows = ((lines.Length * LineHeight) + (2 * Gap) + RowPitch - 1) / RowPitch;
        var rect = Next(rows);
        _isLastHot = IsHot(rect);
        for (var i = 0; i < lines.Length; i++)
        {
            Print(lines[i], new(rect.X, rect.Y + Gap + (i * LineHeight), rect.Width, LineHeight), colour);
        }
    }

    private void PrintLabel(string text, Colour colour, UiAlign align)
    {
        var rect = Next();
        _isLastHot = IsHot(rect);
        if (!Print(text, rect, colour, align))
        {
            Tooltip(text);
        }
    }
}
