using OpenTK.Windowing.GraphicsLibraryFramework;

namespace FractalEngine.Render.Windowing;

/// <summary>From GLFW's keys to ours.</summary>
internal static class GlfwKeys
{
    /// <summary>
    /// By what the key's cap says where that is a character of ours, so that other layouts than the American one work; else by
    /// the key's place, after which GLFW names keys.
    /// </summary>
    public static Key KeyOf(Keys key, int scanCode) =>
        key is > Keys.Unknown and < Keys.Escape && GLFW.GetKeyName(key, scanCode) is [var character]
            ? KeyOf(character) is var named and not Key.Unknown ? named : KeyOfScanCode(key)
            : KeyOfScanCode(key);

    /// <summary>GLFW's modifiers as ours.</summary>
    public static KeyModifiers ModifiersOf(OpenTK.Windowing.GraphicsLibraryFramework.KeyModifiers modifiers) =>
        (modifiers.HasFlag(OpenTK.Windowing.GraphicsLibraryFramework.KeyModifiers.Shift) ? KeyModifiers.Shift : 0)
        | (modifiers.HasFlag(OpenTK.Windowing.GraphicsLibraryFramework.KeyModifiers.Control) ? KeyModifiers.Control : 0)
        | (modifiers.HasFlag(OpenTK.Windowing.GraphicsLibraryFramework.KeyModifiers.Alt) ? KeyModifiers.Alt : 0);

    /// <summary>What a modifier key modifies; nothing for any other key.</summary>
    public static KeyModifiers ModifierOf(Key key) => key switch
    {
        Key.LeftShift or Key.RightShift => KeyModifiers.Shift,
        Key.LeftControl or Key.RightControl => KeyModifiers.Control,
        Key.LeftAlt or Key.RightAlt => KeyModifiers.Alt,
        _ => KeyModifiers.None,
    };

    private static Key KeyOf(char character) => char.ToLowerInvariant(character) switch
    {
        >= 'a' and <= 'z' and var letter => Key.A + (letter - 'a'),
        >= '0' and <= '9' and var digit => Key.Digit0 + (digit - '0'),
        '+' or '=' => Key.Plus,
        '-' => Key.Minus,
        ',' => Key.Comma,
        '.' => Key.Period,
        '/' => Key.Slash,
        '[' => Key.LeftBracket,
        ']' => Key.RightBracket,
        _ => Key.Unknown,
    };

    private static Key KeyOfScanCode(Keys key) => key switch
    {
        >= Keys.A and <= Keys.Z => Key.A + (key - Keys.A),
        >= Keys.D0 and <= Keys.D9 => Key.Digit0 + (key - Keys.D0),
        >= Keys.F1 and <= Keys.F12 => Key.F1 + (key - Keys.F1),
        >= Keys.KeyPad0 and <= Keys.KeyPad9 => Key.Keypad0 + (key - Keys.KeyPad0),
        Keys.KeyPadAdd => Key.KeypadPlus,
        Keys.KeyPadSubtract => Key.KeypadMinus,
        Keys.KeyPadEnter => Key.KeypadEnter,
        Keys.Left => Key.Left,
        Keys.Right => Key.Right,
        Keys.Up => Key.Up,
        Keys.Down => Key.Down,
        Keys.Home => Key.Home,
        Keys.End => Key.End,
        Keys.PageUp => Key.PageUp,
        Keys.PageDown => Key.PageDown,
        Keys.Insert => Key.Insert,
        Keys.Delete => Key.Delete,
        Keys.Backspace => Key.Backspace,
        Keys.Space => Key.Space,
        Keys.Enter => Key.Enter,
        Keys.Escape => Key.Escape,
        Keys.Tab => Key.Tab,
        Keys.LeftShift => Key.LeftShift,
        Keys.RightShift => Key.RightShift,
        Keys.LeftControl => Key.LeftControl,
        Keys.RightControl => Key.RightControl,
        Keys.LeftAlt => Key.LeftAlt,
        Keys.RightAlt => Key.RightAlt,
        Keys.Equal => Key.Plus,
        Keys.Minus => Key.Minus,
        Keys.Comma => Key.Comma,
        Keys.Period => Key.Period,
        Keys.Slash => Key.Slash,
        Keys.LeftBracket => Key.LeftBracket,
        Keys.RightBracket => Key.RightBracket,
        _ => Key.Unknown,
    };
}
