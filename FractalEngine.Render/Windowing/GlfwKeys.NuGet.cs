using FractalEngine.Render.Windowing.Keyboard;
using OpenTK.Windowing.GraphicsLibraryFramework;
using GlfwModifiers = OpenTK.Windowing.GraphicsLibraryFramework.KeyModifiers;
using KeyModifiers = FractalEngine.Render.Windowing.Keyboard.KeyModifiers;

namespace FractalEngine.Render.Windowing;

/// <summary>Translates GLFW's keys and modifiers.</summary>
internal static class GlfwKeys
{
    /// <summary>
    /// Translates a key by the character on its cap where that has a name in <see cref="Key"/>, otherwise by its position, after which GLFW
    /// names keys.
    /// </summary>
    public static Key KeyOf(Keys key, int scanCode)
    {
        var isCharacterKey = key is > Keys.Unknown and < Keys.Escape;
        var named = isCharacterKey && GLFW.GetKeyName(key, scanCode) is [var character]
            ? KeyCharacters.KeyOf(char.ToLowerInvariant(character))
            : Key.Unknown;
        return named != Key.Unknown ? named : KeyAtPosition(key);
    }

    /// <summary>Translates a set of modifier keys.</summary>
    public static KeyModifiers ModifiersOf(GlfwModifiers modifiers) =>
        (modifiers.HasFlag(GlfwModifiers.Shift) ? KeyModifiers.Shift : 0)
        | (modifiers.HasFlag(GlfwModifiers.Control) ? KeyModifiers.Control : 0)
        | (modifiers.HasFlag(GlfwModifiers.Alt) ? KeyModifiers.Alt : 0);

    /// <summary>Returns the modifier that a key is itself; none for any other key.</summary>
    public static KeyModifiers ModifierOf(Key key) => key switch
    {
        Key.LeftShift or Key.RightShift => KeyModifiers.Shift,
        Key.LeftControl or Key.RightControl => KeyModifiers.Control,
        Key.LeftAlt or Key.RightAlt => KeyModifiers.Alt,
        _ => KeyModifiers.None,
    };

    private static Key KeyAtPosition(Keys key) => key switch
    {
        >= Keys.D0 and <= Keys.D9 => Key.Digit0 + (key - Keys.D0),
        >= Keys.KeyPad0 and <= Keys.KeyPad9 => Key.Keypad0 + (key - Keys.KeyPad0),
        Keys.KeyPadAdd => Key.KeypadPlus,
        Keys.KeyPadSubtract => Key.KeypadMinus,
        Keys.KeyPadEnter => Key.KeypadEnter,
        Keys.Equal => Key.Plus,
        // All others have the same names.
        _ => Enum.TryParse(Enum.GetName(key), out Key same) ? same : Key.Unknown,
    };
}
