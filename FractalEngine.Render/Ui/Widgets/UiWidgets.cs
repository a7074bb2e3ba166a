using FractalEngine.Core.Geometry;
using FractalEngine.Render.Ui.Input;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui.Widgets;

/// <summary>The widgets that keep nothing from one build to the next. <see cref="UserInterface"/> tells what they are.</summary>
internal sealed class UiWidgets(UiInput input, UiPainter painter, UiLayout layout, UiTargets targets, UiTooltip tooltip)
{
    private UiTheme Theme => painter.Theme;

    private int Gap => painter.Gap;

    public void Label(string text, Colour colour, double align = 0)
    {
        var rect = layout.Next();
        targets.Hover(rect);
        tooltip.Print(text, rect, colour, align);
    }

    public void Heading(string text)
    {
        layout.Row(1);
        Paragraph(text, Theme.Accent);
    }

    public void Paragraph(string text, Colour colour)
    {
        var columns = Math.Max(8, layout.NextWidth / painter.CellWidth);
        var lines = text.Split('\n').SelectMany(line => TextLines.Wrap(line, columns)).ToArray();
        var rect = layout.Next(((lines.Length * painter.LineHeight) + (2 * Gap) + painter.RowPitch - 1) / painter.RowPitch);
        targets.Hover(rect);
        painter.PrintLines(lines, rect, colour);
    }

    public bool Button(string label, bool isEnabled)
    {
        var rect = layout.Next();
        if (!isEnabled)
        {
            painter.Frame(rect, Theme.Control);
            painter.Print(label, rect.Inset(Gap), Theme.DimText, align: 0.5);
            return false;
        }

        var touch = targets.Touch(label, rect);
        painter.Fill(rect, touch.IsHeld ? Theme.Fill : touch.IsHot ? Theme.HotControl : Theme.Control, 3);
        tooltip.Print(label, rect.Inset(Gap), Theme.Text, align: 0.5);
        painter.FrameFocus(rect, touch.HasFocus);
        return touch.IsActivated;
    }

    /// <summary>Adds the × at the right end of a title.</summary>
    public bool CloseButton(UiRect title)
    {
        var place = title with { X = title.Right - title.Height, Width = title.Height };
        var touch = targets.Touch("close", place, takesFocus: false);
        painter.Print("×", place, touch.IsHot ? Theme.Accent : Theme.DimText, align: 0.5);
        return touch.IsActivated;
    }

    public bool CheckBox(string label, bool isChecked)
    {
        var rect = layout.Next();
        var touch = targets.Touch(label, rect);
        isChecked ^= touch.IsActivated;
        var box = new UiRect(rect.X, rect.Y + Gap, rect.Height - (2 * Gap), rect.Height - (2 * Gap));
        painter.Fill(box, touch.IsHot ? Theme.HotControl : Theme.Field, 3);
        painter.Frame(box, Theme.Border);
        painter.Print(isChecked ? "✓" : "", box, Theme.Text, align: 0.5);
        var left = box.Right + painter.Padding;
        tooltip.Print(label, rect with { X = left, Width = Math.Max(0, rect.Right - left) }, Theme.Text);
        painter.FrameFocus(rect, touch.HasFocus);
        return touch.IsActivated;
    }

    public bool Selectable(string label, bool isSelected, int depth)
    {
        var rect = layout.Next();
        var touch = targets.Touch(label, rect, isRow: true);
        if (isSelected || touch.IsHot)
        {
            painter.Fill(rect, isSelected ? Theme.Selection : Theme.Control, 2);
        }

        var indent = Gap + (2 * depth * painter.CellWidth);
        tooltip.Print(label, rect with { X = rect.X + indent, Width = Math.Max(0, rect.Width - indent - Gap) }, Theme.Text);
        painter.FrameFocus(rect, touch.HasFocus);
        return touch.IsActivated;
    }

    public bool Branch(string label, ref bool isOpen)
    {
        layout.Row(1);
        var rect = layout.Next();
        var touch = targets.Touch(label, rect, isRow: true);
        if (touch.IsActivated || (touch.HasFocus && input.TakeKey(isOpen ? Key.Left : Key.Right)))
        {
            isOpen = !isOpen;
            input.BuildsAgain = true;
        }

        if (touch.IsHot)
        {
            painter.Fill(rect, Theme.Control, 2);
        }

        var indent = 2 * painter.CellWidth;
        painter.Print(isOpen ? "▼" : "▶", rect with { Width = indent }, Theme.DimText);
        painter.Print(label, rect with { X = rect.X + indent, Width = Math.Max(0, rect.Width - indent) }, Theme.Accent);
        painter.FrameFocus(rect, touch.HasFocus);
        return isOpen;
    }

    public void Progress(double fraction, string label)
    {
        var rect = layout.Next();
        painter.Fill(rect, Theme.Field, 3);
        painter.Fill(rect with { Width = (int)(rect.Width * Math.Clamp(fraction, 0, 1)) }, Theme.Fill, 3);
        painter.Print(label, rect.Inset(Gap), Theme.Text, align: 0.5);
    }

    public void Graph(IReadOnlyCollection<double> values, double maximum, int rows)
    {
        var rect = layout.Next(rows);
        painter.Fill(rect, Theme.Field, 2);
        var width = Math.Max(1, painter.CellWidth / 4);
        var count = Math.Min(values.Count, rect.Width / width);
        var x = rect.Right - (count * width);
        foreach (var value in values.Skip(values.Count - count))
        {
            var height = (int)Math.Ceiling(rect.Height * Math.Clamp(value / maximum, 0, 1));
            painter.Fill(new(x, rect.Bottom - height, width, height), value > maximum ? Theme.Warning : Theme.Focus);
            x += width;
        }
    }

    public void Swatch(Colour colour)
    {
        var rect = layout.Next();
        painter.Fill(rect, colour, 3);
        painter.Frame(rect, Theme.Border);
    }
}
