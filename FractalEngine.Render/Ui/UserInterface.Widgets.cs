using System.Globalization;
using FractalEngine.Core.Geometry;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Render.Ui;

/// <content>The widgets of panels, menus and dialogs.</content>
public sealed partial class UserInterface
{
    private double _pressY;
    private bool _isSliding;
    private double _slideStart;
    private UiRect? _scrolledRect;
    private bool _isLastHot;

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

    /// <summary>Adds the heading of what follows.</summary>
    public void Heading(string text)
    {
        ArgumentNullException.ThrowIfNull(text);
        Row(1);
        PrintLabel(text, Theme.Accent, UiAlign.Left);
    }

    /// <summary>Adds a text in as many lines as its place needs.</summary>
    /// <param name="text">Words that are wrapped at blanks.</param>
    /// <param name="isWarning">True for a text that the user should notice.</param>
    public void Paragraph(string text, bool isWarning = false)
    {
        ArgumentNullException.ThrowIfNull(text);
        var columns = Math.Max(8, NextWidth / CellWidth);
        var lines = text.Split('\n').SelectMany(line => Wrap(line, columns)).ToArray();
        var rows = ((lines.Length * LineHeight) + (2 * Gap) + RowPitch - 1) / RowPitch;
        var rect = Next(rows);
        for (var i = 0; i < lines.Length; i++)
        {
            var place = new UiRect(rect.X, rect.Y + Gap + (i * LineHeight), rect.Width, LineHeight);
            Print(lines[i], place, isWarning ? Theme.Warning : Theme.Text);
        }
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

    /// <summary>
    /// Adds a number that is set by dragging, by the keys Left and Right, or typed: a click or Enter begins to type.
    /// </summary>
    /// <param name="label">Text before the slider, and its identity.</param>
    /// <param name="value">The number, which is changed.</param>
    /// <param name="minimum">The number at the left end.</param>
    /// <param name="maximum">The number at the right end.</param>
    /// <param name="step">Dragging gives multiples of this; 0 for a thousandth of the range.</param>
    /// <param name="isBounded">Whether typed numbers must lie between the ends, too.</param>
    /// <returns>True when the number was changed.</returns>
    public bool Slider(string label, ref double value, double minimum, double maximum, double step = 0, bool isBounded = true)
    {
        ArgumentNullException.ThrowIfNull(label);
        var rect = Next();
        var labelWidth = Math.Min(rect.Width * 2 / 5, Math.Max(2 * CellWidth, (label.Length + 1) * CellWidth));
        if (label.Length > 0 && !Print(label, rect with { Width = labelWidth - (CellWidth / 2) }, Theme.Text) && IsHot(rect))
        {
            Tooltip(label, isHot: true);
        }

        var bar = label.Length == 0 ? rect : rect with { X = rect.X + labelWidth, Width = rect.Width - labelWidth };
        var id = IdOf(label);
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

    /// <summary>Writes a text at a point of the frame, behind all panels. It takes no input.</summary>
    /// <param name="text">A few words or a number.</param>
    /// <param name="x">Pixels from the left edge of the frame to the middle of the text.</param>
    /// <param name="y">Pixels from the upper edge of the frame to the middle of the text.</param>
    public void Mark(string text, double x, double y)
    {
        ArgumentNullException.ThrowIfNull(text);
        _layer = 0;
        _clip = new(0, 0, _width, _height);
        var width = (text.Length * CellWidth) + (2 * Gap);
        var rect = new UiRect((int)x - (width / 2), (int)y - (RowHeight / 2), width, RowHeight);
        Fill(rect, Theme.Panel, 3);
        Print(text, rect, Theme.Text, UiAlign.Middle);
    }

    /// <summary>Adds a round button anywhere in the frame, before what was added earlier.</summary>
    /// <param name="label">One or two characters, and the identity of the button.</param>
    /// <param name="x">Pixels from the left edge of the frame to the middle.</param>
    /// <param name="y">Pixels from the upper edge of the frame to the middle.</param>
    /// <param name="colour">Ground of the button; dark, since the text is light.</param>
    /// <returns>True when the button was pressed.</returns>
    public bool Knob(string label, double x, double y, Colour colour)
    {
        ArgumentNullException.ThrowIfNull(label);
        return AddKnob(label, x, y, colour).IsActivated;
    }

    /// <summary>Adds a round handle anywhere in the frame, which is dragged.</summary>
    /// <param name="label">One or two characters.</param>
    /// <param name="name">Identity of the handle.</param>
    /// <param name="x">Pixels from the left edge of the frame to the middle.</param>
    /// <param name="y">Pixels from the upper edge of the frame to the middle.</param>
    /// <param name="colour">Ground of the handle; dark, since the text is light.</param>
    /// <remarks>The handle keeps the pointer until the button is released, wherever it is added meanwhile.</remarks>
    public UiHandle Handle(string label, string name, double x, double y, Colour colour)
    {
        ArgumentNullException.ThrowIfNull(label);
        ArgumentNullException.ThrowIfNull(name);
        var touch = AddKnob(label, x, y, colour, name);
        return new(touch.IsHot, touch.IsPressed, touch.IsHeld, _input.X, _input.Y, _input.IsControlHeld);
    }

    /// <summary>Explains the last widget while the pointer is over it.</summary>
    public void Tooltip(string text) => Tooltip(text, _isLastHot);

    private void Tooltip(string text, bool isHot)
    {
        if (isHot && !_input.IsDown)
        {
            _tooltip = text;
            _tooltipOwner = _nextRoots.Find(owner => owner.Root == _root).Bounds;
        }
    }

    private UiTouch AddKnob(string label, double x, double y, Colour colour, string? name = null)
    {
        var size = RowHeight;
        var rect = new UiRect((int)x - (size / 2), (int)y - (size / 2), size, size);
        var id = IdOf(name ?? label);
        BeginRoot(id, rect, layer: 0);
        var touch = Touch(id, rect, takesFocus: false);
        Fill(rect, colour, size / 2f);
        Print(label, rect, touch.IsHot ? UiTheme.Dark.Accent : UiTheme.Dark.Text, UiAlign.Middle);
        return touch;
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

    private static IEnumerable<string> Wrap(string line, int columns)
    {
        while (line.Length > columns)
        {
            var blank = line.LastIndexOf(' ', columns);
            var length = blank > 0 ? blank : columns;
            yield return line[..length];
            line = line[length..].TrimStart();
        }

        yield return line;
    }

    private void DrawSlider(UiTouch touch, UiRect bar, double value, double minimum, double maximum)
    {
        Fill(bar, touch.IsHot ? Theme.HotControl : Theme.Control, 3);
        var fraction = maximum > minimum ? Math.Clamp((value - minimum) / (maximum - minimum), 0, 1) : 0;
        Fill(bar with { Width = (int)(bar.Width * fraction) }, Theme.Fill, 3);
        Print(ShortNumber(value), bar.Inset(Gap), Theme.Text, UiAlign.Right);
        DrawFocus(touch, bar);
    }

    private bool IsHot(UiRect rect) =>
        _hoverRoot == _root && (!_input.IsDown || _active == 0) && _dragged is null
        && rect.Intersect(_clip).Contains(_input.X, _input.Y);

    /// <summary>Tells what mouse and keyboard do to a widget.</summary>
    private UiTouch Touch(int id, UiRect rect, bool takesFocus)
    {
        if (takesFocus)
        {
            _focusable.Add(id);
            if (_scrollTo == id)
            {
                _scrolledRect = rect;
            }
        }

        var isHot = IsHot(rect);
        _isLastHot = isHot;
        var isPressed = isHot && _input.IsPressed && _active == 0;
        if (isPressed)
        {
            _active = id;
            _pressY = _input.Y;
            CommitEdit();
            if (takesFocus)
            {
                TakeFocus(id);
            }
        }

        var isActivated = _active == id && _input.IsReleased && rect.Intersect(_clip).Contains(_input.X, _input.Y);
        if (_focus == id && takesFocus && (_input.Key is Key.Enter or Key.KeypadEnter or Key.Space))
        {
            _input.Key = Key.Unknown;
            _isKeyTaken = true;
            isActivated = true;
        }

        _buildsAgain |= isActivated;
        return new(id, isHot || _active == id, isPressed, _active == id && _input.IsDown, isActivated);
    }

    private void DrawFocus(UiTouch touch, UiRect rect)
    {
        if (_focus == touch.Id)
        {
            Frame(rect, Theme.Focus);
        }
    }

    /// <summary>Lets the keys Up and Down move the keyboard to the row before or after.</summary>
    private void MoveFocusByArrows(UiTouch touch)
    {
        if (_focus != touch.Id)
        {
            return;
        }

        if (_input.TakeKey(Key.Up))
        {
            _isKeyTaken = true;
            TakeFocus(_focusable[Math.Max(0, _focusable.IndexOf(touch.Id) - 1)]);
        }
        else if (_input.TakeKey(Key.Down))
        {
            _isKeyTaken = true;
            _focusNext = touch.Id;
        }
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
