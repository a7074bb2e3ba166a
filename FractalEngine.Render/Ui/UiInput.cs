using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui;

/// <summary>The input of one build of a user interface. What has just happened is cleared before the next build.</summary>
internal sealed class UiInput
{
    public double X { get; set; } = -1;

    public double Y { get; set; } = -1;

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

    /// <summary>Takes the key if it is the given one, so that no other widget sees it.</summary>
    public bool TakeKey(Key key)
    {
        var isTaken = Key == key;
        if (isTaken)
        {
            Key = Key.Unknown;
        }

        return isTaken;
    }

    public void ClearEvents()
    {
        IsPressed = false;
        IsReleased = false;
        Wheel = 0;
        Text = "";
        Key = Key.Unknown;
    }
}
