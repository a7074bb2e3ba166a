namespace FractalEngine.Render.Windowing.Keyboard;

/// <summary>Keys that the engine distinguishes; every other key is <see cref="Unknown"/>.</summary>
public enum Key
{
    /// <summary>A key without a name of its own here.</summary>
    Unknown,

#pragma warning disable CS1591 // The names are self-explanatory.
    A, B, C, D, E, F, G, H, I, J, K, L, M, N, O, P, Q, R, S, T, U, V, W, X, Y, Z,
    Digit0, Digit1, Digit2, Digit3, Digit4, Digit5, Digit6, Digit7, Digit8, Digit9,
    F1, F2, F3, F4, F5, F6, F7, F8, F9, F10, F11, F12,
    Keypad0, Keypad1, Keypad2, Keypad3, Keypad4, Keypad5, Keypad6, Keypad7, Keypad8, Keypad9,
    KeypadPlus, KeypadMinus, KeypadEnter,
    Left, Right, Up, Down, Home, End, PageUp, PageDown, Insert, Delete, Backspace,
    Space, Enter, Escape, Tab,
    LeftShift, RightShift, LeftControl, RightControl, LeftAlt, RightAlt,
    Minus, Comma, Period, Slash, LeftBracket, RightBracket,
#pragma warning restore CS1591

    /// <summary>The key with the plus sign, which it shares with the equals sign on some keyboards.</summary>
    Plus,
}
