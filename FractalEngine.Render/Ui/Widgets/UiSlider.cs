using System.Globalization;
using FractalEngine.Render.Ui.Input;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;

namespace FractalEngine.Render.Ui.Widgets;

/// <summary>Sliders, on which numbers are typed, too.</summary>
internal sealed class UiSlider(
    UiInput input, UiPainter painter, UiLayout layout, UiTargets targets, UiFocus focus, UiTooltip tooltip, UiTextField field,
    Func<string, double?> readNumber)
{
    // Ends of sliders that may be left are remembered for so many at most.
    private const int MaxRanges = 1000;

    private readonly Dictionary<int, (double Minimum, double Maximum)> _ranges = [];
    private bool _isSliding;
    private double _start;

    public bool Add(string label, ref double value, double minimum, double maximum, double step, bool isBounded)
    {
        var bar = AddLabel(label);
        var id = targets.IdOf(label);
        (minimum, maximum) = isBounded ? (minimum, maximum) : KeepRange(id, value, minimum, maximum);
        var before = value;
        if (focus.IsEditing(id))
        {
            if (field.Edit(id, bar) is { } typed && readNumber(typed) is { } number)
            {
                value = isBounded ? Math.Clamp(number, minimum, maximum) : number;
            }

            return value != before;
        }

        var touch = targets.Touch(label, bar);
        if (touch.IsPressed)
        {
            _isSliding = false;
            _start = value;
        }

        var grid = step > 0 ? step : NiceStep((maximum - minimum) / 1000);
        double Limit(double moved) => Math.Clamp(Snap(moved, grid), Math.Min(minimum, before), Math.Max(maximum, before));
        if (touch.IsHeld && (_isSliding || Math.Abs(input.X - input.PressX) > 3))
        {
            _isSliding = true;
            // Relative to where the drag began, so that a press alone changes nothing.
            value = Limit(_start + ((maximum - minimum) * (input.X - input.PressX) / Math.Max(1, bar.Width)));
        }
        else if (touch.IsActivated && !_isSliding)
        {
            field.Begin(id, value.ToString("R", CultureInfo.InvariantCulture));
        }

        if (touch.HasFocus && focus.Edited == 0 && input.TakeDirection() is not 0 and var direction)
        {
            value = Limit(value + (direction * (input.IsShiftHeld ? 10 : 1) * grid));
        }

        _isSliding &= input.IsDown || input.IsReleased;
        Paint(touch, bar, value, minimum, maximum);
        return value != before;
    }

    /// <summary>Adds the text before a slider.</summary>
    /// <returns>Place of the slider itself.</returns>
    private UiRect AddLabel(string label)
    {
        var rect = layout.Next();
        if (label.Length == 0)
        {
            return rect;
        }

        var cell = painter.CellWidth;
        var width = Math.Min(rect.Width * 2 / 5, Math.Max(2 * cell, (label.Length + 1) * cell));
        // A letter stands in the middle of its place, apart from the number of the slider before.
        var indent = label.Length == 1 ? cell / 2 : 0;
        targets.Hover(rect);
        tooltip.Print(label, rect with { X = rect.X + indent, Width = width - indent - (cell / 4) }, painter.Theme.Text);
        return rect with { X = rect.X + width, Width = rect.Width - width };
    }

    /// <summary>Returns the ends that a slider began with, or other ones where the number has come to them.</summary>
    private (double Minimum, double Maximum) KeepRange(int id, double value, double minimum, double maximum)
    {
        if (_ranges.TryGetValue(id, out var range))
        {
            var ratio = (range.Maximum - range.Minimum) / (maximum - minimum);
            if (targets.Holder == id || (value > range.Minimum && value < range.Maximum && ratio is > 0.2 and < 5))
            {
                return range;
            }
        }
        else if (_ranges.Count >= MaxRanges)
        {
            _ranges.Clear();
        }

        return _ranges[id] = (minimum, maximum);
    }

    private void Paint(UiTouch touch, UiRect bar, double value, double minimum, double maximum)
    {
        var theme = painter.Theme;
        painter.Fill(bar, touch.IsHot ? theme.HotControl : theme.Control, 3);
        var fraction = maximum > minimum ? Math.Clamp((value - minimum) / (maximum - minimum), 0, 1) : 0;
        painter.Fill(bar with { Width = (int)(bar.Width * fraction) }, theme.Fill, 3);
        painter.Print(ShortNumber(value), bar.Inset(painter.Gap), theme.Text, align: 1);
        painter.FrameFocus(bar, touch.HasFocus);
    }

    private static double Snap(double value, double grid) => grid > 0 ? Math.Round(Math.Round(value / grid) * grid, 12) : value;

    /// <summary>Returns the power of ten at or below a number, so that dragged numbers have few digits.</summary>
    private static double NiceStep(double value) => value > 0 ? Math.Pow(10, Math.Floor(Math.Log10(value))) : 0;

    private static string ShortNumber(double value) => value.ToString("0.######", CultureInfo.InvariantCulture) is { Length: <= 12 } text
        ? text
        : value.ToString("G6", CultureInfo.InvariantCulture);
}
