using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui.Input;

/// <summary>The input of one build of a user interface, and what widgets make of it. Events are cleared before the next build.</summary>
internal sealed class UiInput
{
    public double X { get; set; } = -1;

    public double Y { get; set; } = -1;

    /// <summary>Where the left button went down last.</summary>
    public double PressX { get; set; }

    public double PressY { get; set; }

    /// <summary>Whether the left button is held, and was pressed over the interface.</summary>
    public bool IsDown { get; set; }

    /// <summary>Whether the left button has just been pressed.</summary>
    public bool IsPressed { get; set; }

    /// <summary>Whether the left button has just been released.</summary>
    public bool IsReleased { get; set; }

    /// <summary>Notches of the wheel, positive away from the user.</summary>
    public double Wheel { get; set; }

    /// <summary>Text that was typed.</summary>
    public string Text { get; set; } = "";

    /// <summary>The key that was pressed; <see cref="Key.Unknown"/> for none.</summary>
    public Key Key { get; set; }

    public KeyModifiers Modifiers { get; set; }

    public bool IsShiftHeld => Modifiers.HasFlag(KeyModifiers.Shift);

    public bool IsControlHeld => Modifiers.HasFlag(KeyModifiers.Control);

    /// <summary>Whether a widget has taken the key, which the scene does not see then.</summary>
    public bool IsKeyTaken { get; set; }

    /// <summary>Whether the widgets are built again, since one of them acts on what stands before it.</summary>
    public bool BuildsAgain { get; set; }

    /// <summary>Takes the key if it is one of these, so that no other widget sees it.</summary>
    public bool TakeKey(params ReadOnlySpan<Key> keys)
    {
        var isTaken = Key != Key.Unknown && keys.Contains(Key);
        if (isTaken)
        {
            Key = Key.Unknown;
            IsKeyTaken = true;
        }

        return isTaken;
    }

    /// <summary>Takes the keys Left and Right, as −1 and 1; 0 for another key.</summary>
    public int TakeDirection() => (TakeKey(Key.Right) ? 1 : 0) - (TakeKey(Key.Left) ? 1 : 0);

    public void ClearEvents()
    {
        IsPressed = false;
        IsReleased = false;
        Wheel = 0;
        Text = "";
        Key = Key.Unknown;
    }
}
