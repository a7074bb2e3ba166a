using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Input;

/// <summary>
/// Keeps track of the keys that are held down, and reads them as movement along three axes. Arrow and page keys equal the letters.
/// </summary>
internal sealed class HeldKeys
{
    private readonly HashSet<Key> _keys = [];

    /// <summary>Movement to the right: 1 or 0, and −1 for the left.</summary>
    public double Right => Axis(Key.D, Key.Right) - Axis(Key.A, Key.Left);

    /// <summary>Movement upwards: 1 or 0, and −1 for downwards.</summary>
    public double Up => Axis(Key.E, Key.PageUp) - Axis(Key.Q, Key.PageDown);

    /// <summary>Movement forward: 1 or 0, and −1 for backward.</summary>
    public double Forward => Axis(Key.W, Key.Up) - Axis(Key.S, Key.Down);

    /// <summary>Updates the keys from an event. Without the focus, no key counts as held.</summary>
    public void Handle(WindowEvent windowEvent)
    {
        switch (windowEvent)
        {
            case KeyPressed pressed:
                _keys.Add(pressed.Key);
                break;
            case KeyReleased released:
                _keys.Remove(released.Key);
                break;
            case FocusLost:
                Clear();
                break;
        }
    }

    public void Clear() => _keys.Clear();

    private double Axis(Key letter, Key alternative) => _keys.Contains(letter) || _keys.Contains(alternative) ? 1 : 0;
}
