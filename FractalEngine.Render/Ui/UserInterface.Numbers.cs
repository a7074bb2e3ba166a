using System.Globalization;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui;

/// <content>Sliders, on which numbers are typed, too.</content>
public sealed partial class UserInterface
{
    // Ends of sliders that may be left are remembered for so many at most.
    private const int MaxRanges = 1000;

    private readonly Dictionary<int, (double Minimum, double Maximum)> _ranges = [];
    private bool _isSliding;
    private double _slideStart;

    /// <summary>
    /// Adds a number that is set by dragging, by the keys Left and Right, or typed: a click or Enter begins to type.
    /// </summary>
    /// <param name="label">Text before the slider, and its identity.</param>
    /// <param name="value">The number, which is changed.</param>
    /// <param name="minimum">The number at the left end.</param>
    /// <param name="maximum">The number at the right end.</param>
    /// <param name="step">Dragging gives multiples of this; 0 for a thousandth of the range.</param>
    /// <param name="isBounded">
    /// Whether typed numbers must lie between the ends, too. Other sliders keep the ends that they began with while the number lies
    /// within, so that their filled part does not jump where the ends follow the number.
    /// </param>
    /// <returns>True when the number was changed.</returns>
    public bool Slider(string label, ref double value, double minimum, double maximum, double step = 0, bool isBounded = true)
    {
        ArgumentNullException.ThrowIfNull(label);
        var rect = Next();
        var labelWidth = Math.Min(rect.Width * 2 / 5, Math.Max(2 * CellWidth, (label.Length + 1) * CellWidth));
        // A letter stands in the middle of its place, apart from the number of the slider before.
        var indent = label.Length == 1 ? CellWidth / 2 : 0;
        var place = rect with { X = rect.X + indent, Width = labelWidth - indent - (CellWidth / 4) };
        if (label.Length > 0 && !Print(label, place, Theme.Text) && IsHot(rect))
        {
            Tooltip(label, isHot: true);
        }

        var bar = label.Length == 0 ? rect : rect with { X = rect.X + labelWidth, Width = rect.Width - labelWidth };
        var id = IdOf(label);
        (minimum, maximum) = isBounded ? (minimum, maximum) : KeepRange(id, value, minimum, maximum);
        var before = value;
        if (_editing == id || _committed == id)
        {
            if (EditField(id, bar) is { } typed && ParseNumber(typed) is { } number)
            {
                value = isBounded ? Math.Clamp(number, minimum, maximum) : number;
            }

            return value != before;
        }

        var touch = Touch(id, bar, takesFocus: true);
        if (touch.IsPressed)
        {
            _isSliding = false;
            _slideStart = value;
        }

        var grid = step > 0 ? step : NiceStep((maximum - minimum) / 1000);
        if (touch.IsHeld && (_isSliding || Math.Abs(_input.X - _pressX) > 3))
        {
            _isSliding = true;
            // Relative to where the drag began, so that a press alone changes nothing.
            var moved = _slideStart + ((maximum - minimum) * (_input.X - _pressX) / Math.Max(1, bar.Width));
            value = Math.Clamp(Snap(moved, grid), Math.Min(minimum, before), Math.Max(maximum, before));
        }
        else if (touch.IsActivated && !_isSliding)
        {
            BeginEdit(id, FormatNumber(value));
        }

        if (_focus == id && _editing == 0)
        {
            var direction = (_input.TakeKey(Key.Right) ? 1 : 0) - (_input.TakeKey(Key.Left) ? 1 : 0);
            _isKeyTaken |= direction != 0;
            value = direction == 0 ? value : Math.Clamp(Snap(value + (direction * (_input.IsShiftHeld ? 10 : 1) * grid), grid),
                Math.Min(minimum, before), Math.Max(maximum, before));
        }

        _isSliding &= _input.IsDown || _input.IsReleased;
        DrawSlider(touch, bar, value, minimum, maximum);
        return value != before;
    }

    /// <summary>Returns the ends that a slider began with, or other ones where the number has come to them.</summary>
    private (double Minimum, double Maximum) KeepRange(int id, double value, double minimum, double maximum)
    {
        if (_ranges.TryGetValue(id, out var range))
        {
            var ratio = (range.Maximum - range.Minimum) / (maximum - minimum);
            if (_active == id || (value > range.Minimum && value < range.Maximum && ratio is > 0.2 and < 5))
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

    private void DrawSlider(UiTouch touch, UiRect bar, double value, double minimum, double maximum)
    {
        Fill(bar, touch.IsHot ? Theme.HotControl : Theme.Control, 3);
        var fraction = maximum > minimum ? Math.Clamp((value - minimum) / (maximum - minimum), 0, 1) : 0;
        Fill(bar with { Width = (int)(bar.Width * fraction) }, Theme.Fill, 3);
        Print(ShortNumber(value), bar.Inset(Gap), Theme.Text, UiAlign.Right);
        DrawFocus(touch, bar);
    }

    private static double Snap(double value, double grid) => grid > 0 ? Math.Round(Math.Round(value / grid) * grid, 12) : value;

    /// <summary>Returns the power of ten at or below a number, so that dragged numbers have few digits.</summary>
    private static double NiceStep(double value) => value > 0 ? Math.Pow(10, Math.Floor(Math.Log10(value))) : 0;

    private static string FormatNumber(double value) => value.ToString("R", CultureInfo.InvariantCulture);

    private static string ShortNumber(double value) => value.ToString("0.######", CultureInfo.InvariantCulture) is { Length: <= 12 } text
        ? text
        : value.ToString("G6", CultureInfo.InvariantCulture);

    private static double? ParseNumber(string text) =>
        double.TryParse(text.Trim(), NumberStyles.Float, CultureInfo.InvariantCulture, out var value) && double.IsFinite(value)
            ? value
            : null;
}
