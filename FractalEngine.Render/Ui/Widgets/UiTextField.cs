using FractalEngine.Render.Ui.Input;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui.Widgets;

/// <summary>Fields for a line of text, of which one at a time is edited by keys, mouse and clipboard.</summary>
internal sealed class UiTextField(
    UiInput input, UiPainter painter, UiLayout layout, UiTargets targets, UiFocus focus,
    Func<string>? readClipboard, Action<string>? writeClipboard)
{
    private readonly UiTextEdit _edit = new("", readClipboard, writeClipboard);
    private int _firstColumn;

    public bool Add(string label, ref string text, out bool isCommitted, bool takesKeyboard)
    {
        var id = targets.IdOf(label);
        var rect = layout.Next();
        var before = text;
        if (takesKeyboard)
        {
            focus.Take(id);
        }

        if (focus.Widget == id && !focus.IsEditing(id))
        {
            Begin(id, text);
        }

        isCommitted = false;
        if (focus.IsEditing(id))
        {
            isCommitted = Edit(id, rect) is not null;
            text = _edit.Text;
            return text != before;
        }

        var theme = painter.Theme;
        var touch = targets.Touch(label, rect);
        painter.Fill(rect, theme.Field, 2);
        painter.Frame(rect, touch.IsHot ? theme.DimText : theme.Border);
        var isEmpty = text.Length == 0;
        painter.Print(isEmpty ? label : text, rect.Inset(painter.Gap + 1), isEmpty ? theme.DimText : theme.Text);
        return false;
    }

    /// <summary>Begins to edit a field, with all of its text selected.</summary>
    public void Begin(int id, string text)
    {
        focus.Edit(id);
        _firstColumn = 0;
        _edit.Begin(text);
    }

    /// <summary>Adds the field whose text is edited, or was edited until now.</summary>
    /// <returns>The text once it is complete; null while it is edited.</returns>
    public string? Edit(int id, UiRect rect)
    {
        focus.Add(id);
        if (focus.Committed == id)
        {
            focus.Committed = 0;
            input.BuildsAgain = true;
            Paint(rect, hasCaret: false);
            return _edit.Text;
        }

        MoveCaret(rect);
        if (input.Text.Length > 0)
        {
            _edit.Insert(input.Text);
            input.Text = "";
        }

        string? result = null;
        if (input.TakeKey(Key.Enter, Key.KeypadEnter))
        {
            focus.Clear();
            result = _edit.Text;
        }
        else if (input.Key != Key.Unknown && _edit.Handle(input.Key, input.IsShiftHeld, input.IsControlHeld))
        {
            input.TakeKey(input.Key);
        }

        Paint(rect, hasCaret: true);
        return result;
    }

    /// <summary>Moves the caret by the mouse.</summary>
    private void MoveCaret(UiRect rect)
    {
        var column = _firstColumn + (int)Math.Round((input.X - rect.X - painter.Gap - 1) / painter.CellWidth);
        if (targets.Hover(rect) && input.IsPressed)
        {
            targets.Holder = focus.Edited;
            _edit.MoveTo(column, input.IsShiftHeld);
        }
        else if (targets.Holder == focus.Edited && input.IsDown && Math.Abs(input.X - input.PressX) > painter.CellWidth / 2)
        {
            _edit.MoveTo(column, selects: true);
        }
    }

    private void Paint(UiRect rect, bool hasCaret)
    {
        var theme = painter.Theme;
        var inner = rect.Inset(painter.Gap + 1);
        var columns = Math.Max(1, (inner.Width / painter.CellWidth) - 1);
        _firstColumn = Math.Clamp(_firstColumn, Math.Max(0, _edit.Caret - columns), _edit.Caret);
        painter.Fill(rect, theme.Field, 2);
        int X(int index) => inner.X + (Math.Clamp(index - _firstColumn, 0, columns + 1) * painter.CellWidth);
        if (hasCaret)
        {
            var left = X(_edit.SelectionStart);
            painter.Fill(new(left, inner.Y, X(_edit.SelectionEnd) - left, inner.Height), theme.Selection);
        }

        var end = Math.Min(_edit.Text.Length, _firstColumn + columns + 1);
        painter.Print(_edit.Text[_firstColumn..end], inner with { Width = (columns + 1) * painter.CellWidth }, theme.Text);
        if (hasCaret)
        {
            painter.Fill(new(X(_edit.Caret), inner.Y, Math.Max(1, painter.LineHeight / 10), inner.Height), theme.Focus);
            painter.Frame(rect, theme.Focus);
        }
    }
}
