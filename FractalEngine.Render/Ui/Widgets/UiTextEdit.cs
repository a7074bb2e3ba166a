using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui.Widgets;

/// <summary>A line of text with caret and selection, as the keyboard edits it.</summary>
/// <param name="text">The text to begin with, its caret behind it.</param>
/// <param name="readClipboard">Returns the text of the clipboard, which Ctrl+V enters; null for none.</param>
/// <param name="writeClipboard">Takes what Ctrl+C and Ctrl+X copy; null for none.</param>
public sealed class UiTextEdit(string text = "", Func<string>? readClipboard = null, Action<string>? writeClipboard = null)
{
    /// <summary>The text as it is edited so far.</summary>
    public string Text { get; private set; } = text ?? throw new ArgumentNullException(nameof(text));

    /// <summary>Index of the character behind the caret.</summary>
    public int Caret { get; private set; } = text.Length;

    /// <summary>The other end of the selection; the caret itself where nothing is selected.</summary>
    public int Anchor { get; private set; } = text.Length;

    /// <summary>Index of the first selected character; the caret where nothing is selected.</summary>
    public int SelectionStart => Math.Min(Caret, Anchor);

    /// <summary>Index behind the last selected character; the caret where nothing is selected.</summary>
    public int SelectionEnd => Math.Max(Caret, Anchor);

    /// <summary>Begins with a text, all of it selected.</summary>
    public void Begin(string text)
    {
        ArgumentNullException.ThrowIfNull(text);
        Text = text;
        Anchor = 0;
        Caret = text.Length;
    }

    /// <summary>Moves the caret, and the selection with it or not.</summary>
    public void MoveTo(int index, bool selects)
    {
        Caret = Math.Clamp(index, 0, Text.Length);
        Anchor = selects ? Anchor : Caret;
    }

    /// <summary>Replaces the selection. Control characters are left out: copied paths often end with a line break.</summary>
    public void Insert(string text)
    {
        var start = SelectionStart;
        text = string.Concat(text.Where(static character => !char.IsControl(character)));
        Text = string.Concat(Text.AsSpan(0, start), text, Text.AsSpan(SelectionEnd));
        MoveTo(start + text.Length, selects: false);
    }

    /// <summary>Processes a key that was pressed.</summary>
    /// <param name="key">The key.</param>
    /// <param name="selects">Whether a move of the caret selects what it passes, as Shift does.</param>
    /// <param name="isControlHeld">Whether Ctrl is held.</param>
    /// <returns>False for keys that a text field does not know.</returns>
    public bool Handle(Key key, bool selects, bool isControlHeld)
    {
        var leavesSelection = Caret != Anchor && !selects;
        int? target = key switch
        {
            Key.Left when isControlHeld => SkipWord(-1),
            Key.Right when isControlHeld => SkipWord(1),
            _ when isControlHeld => null,
            Key.Left => leavesSelection ? SelectionStart : Previous(Caret),
            Key.Right => leavesSelection ? SelectionEnd : Next(Caret),
            Key.Home => 0,
            Key.End => Text.Length,
            _ => null,
        };
        if (target is { } index)
        {
            MoveTo(index, selects);
            return true;
        }

        if (isControlHeld)
        {
            return HandleControl(key);
        }

        if (key is Key.Backspace or Key.Delete)
        {
            Delete(key == Key.Backspace ? Previous(Caret) : Next(Caret));
            return true;
        }

        // Letters arrive as text, which follows.
        return key is not (Key.Escape or Key.Tab or Key.Enter or Key.KeypadEnter or Key.Up or Key.Down or Key.PageUp
            or Key.PageDown or (>= Key.F1 and <= Key.F12));
    }

    private bool HandleControl(Key key)
    {
        switch (key)
        {
            case Key.A:
                Begin(Text);
                return true;
            case Key.C or Key.X:
                if (Caret != Anchor)
                {
                    writeClipboard?.Invoke(Text[SelectionStart..SelectionEnd]);
                }

                if (key == Key.X)
                {
                    Insert("");
                }

                return true;
            case Key.V:
                Insert(readClipboard?.Invoke() ?? "");
                return true;
            case Key.U:
                Begin("");
                return true;
            default:
                return false;
        }
    }

    private void Delete(int other)
    {
        if (Caret == Anchor)
        {
            MoveTo(other, selects: true);
        }

        Insert("");
    }

    // A character beyond 16 bits is two of them, which are never separated.
    private int Previous(int index) => index - (index > 1 && char.IsSurrogatePair(Text[index - 2], Text[index - 1]) ? 2 : 1);

    private int Next(int index) => index + (index + 1 < Text.Length && char.IsSurrogatePair(Text[index], Text[index + 1]) ? 2 : 1);

    private int SkipWord(int step)
    {
        var index = Caret;
        for (var isInWord = false; step > 0 ? index < Text.Length : index > 0; index += step)
        {
            var isLetter = char.IsLetterOrDigit(Text[step > 0 ? index : index - 1]);
            if (isInWord && !isLetter)
            {
                break;
            }

            isInWord |= isLetter;
        }

        return index;
    }
}
