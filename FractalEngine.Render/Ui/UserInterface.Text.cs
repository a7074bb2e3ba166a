using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui;

/// <content>Text fields: caret, selection and clipboard.</content>
public sealed partial class UserInterface
{
    private int _editing;
    private int _committed;
    private int _firstColumn;

    /// <summary>Adds a line of text that the user edits.</summary>
    /// <param name="label">Identity of the field; shown dim while the field is empty.</param>
    /// <param name="text">The text, which is changed with each character.</param>
    /// <param name="takesKeyboard">True to give the field the keyboard.</param>
    /// <returns>True when the text was changed.</returns>
    public bool TextField(string label, ref string text, bool takesKeyboard = false) =>
        TextField(label, ref text, out _, takesKeyboard);

    /// <summary>Adds a line of text that the user edits.</summary>
    /// <param name="label">Identity of the field; shown dim while the field is empty.</param>
    /// <param name="text">The text, which is changed with each character.</param>
    /// <param name="isCommitted">True when Enter was pressed, or the keyboard has left the field.</param>
    /// <param name="takesKeyboard">True to give the field the keyboard.</param>
    /// <returns>True when the text was changed.</returns>
    public bool TextField(string label, ref string text, out bool isCommitted, bool takesKeyboard = false)
    {
        ArgumentNullException.ThrowIfNull(label);
        ArgumentNullException.ThrowIfNull(text);
        var id = IdOf(label);
        var rect = Next();
        var before = text;
        if (takesKeyboard && _focus != id)
        {
            TakeFocus(id);
        }

        if (_focus == id && _editing != id && _committed != id)
        {
            BeginEdit(id, text);
        }

        isCommitted = false;
        if (_editing == id || _committed == id)
        {
            isCommitted = EditField(id, rect) is not null;
            text = _edit.Text;
            return text != before;
        }

        var touch = Touch(id, rect, takesFocus: true);
        Fill(rect, Theme.Field, 2);
        Frame(rect, touch.IsHot ? Theme.DimText : Theme.Border);
        Print(text.Length > 0 ? text : label, rect.Inset(Gap + 1), text.Length > 0 ? Theme.Text : Theme.DimText);
        return false;
    }

    private void BeginEdit(int id, string text)
    {
        CommitEdit();
        TakeFocus(id);
        _editing = id;
        _firstColumn = 0;
        _edit.Begin(text);
        _buildsAgain = true;
    }

    /// <summary>Ends editing, so that the field takes its text over when it is built next.</summary>
    private void CommitEdit()
    {
        if (_editing != 0)
        {
            _committed = _editing;
            _editing = 0;
            _buildsAgain = true;
        }
    }

    /// <summary>Edits the text of a field.</summary>
    /// <returns>The text once it is complete; null while it is edited.</returns>
    private string? EditField(int id, UiRect rect)
    {
        if (_committed == id)
        {
            _committed = 0;
            _buildsAgain = true;
            _focusable.Add(id);
            DrawEdit(rect, hasCaret: false);
            return _edit.Text;
        }

        _focusable.Add(id);
        HandleEditMouse(rect);
        string? result = null;
        if (_input.Text.Length > 0)
        {
            _edit.Insert(_input.Text);
            _input.Text = "";
        }

        if (_input.Key is Key.Enter or Key.KeypadEnter)
        {
            _input.Key = Key.Unknown;
            _isKeyTaken = true;
            _editing = 0;
            _focus = 0;
            _buildsAgain = true;
            result = _edit.Text;
        }
        else if (_input.Key != Key.Unknown && _edit.Handle(_input, _readClipboard, _writeClipboard))
        {
            _input.Key = Key.Unknown;
            _isKeyTaken = true;
        }

        DrawEdit(rect, hasCaret: true);
        return result;
    }

    private void HandleEditMouse(UiRect rect)
    {
        var isHot = _hoverRoot == _root && rect.Intersect(_clip).Contains(_input.X, _input.Y);
        _isLastHot = isHot;
        var column = _firstColumn + (int)Math.Round((_input.X - rect.X - Gap - 1) / CellWidth);
        if (isHot && _input.IsPressed)
        {
            _active = _editing;
            _edit.MoveTo(column, _input.IsShiftHeld);
        }
        else if (_active == _editing && _input.IsDown && Math.Abs(_input.X - _pressX) > CellWidth / 2)
        {
            _edit.MoveTo(column, selects: true);
        }
    }

    private void DrawEdit(UiRect rect, bool hasCaret)
    {
        var inner = rect.Inset(Gap + 1);
        var columns = Math.Max(1, (inner.Width / CellWidth) - 1);
        _firstColumn = Math.Clamp(_firstColumn, Math.Max(0, _edit.Caret - columns), _edit.Caret);
        Fill(rect, Theme.Field, 2);
        int X(int index) => inner.X + (Math.Clamp(index - _firstColumn, 0, columns + 1) * CellWidth);
        if (hasCaret)
        {
            Fill(new(X(_edit.SelectionStart), inner.Y, X(_edit.SelectionEnd) - X(_edit.SelectionStart), inner.Height), Theme.Selection);
        }

        var end = Math.Min(_edit.Text.Length, _firstColumn + columns + 1);
        Print(_edit.Text[_firstColumn..end], inner with { Width = (columns + 1) * CellWidth }, Theme.Text);
        if (hasCaret)
        {
            Fill(new(X(_edit.Caret), inner.Y, Math.Max(1, LineHeight / 10), inner.Height), Theme.Focus);
            Frame(rect, Theme.Focus);
        }
    }
}
