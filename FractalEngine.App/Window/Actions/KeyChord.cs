using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Actions;

/// <summary>A key with the modifiers that are held for it.</summary>
/// <param name="Key">The key.</param>
/// <param name="Modifiers">The modifiers; without Control, Shift and Alt are ignored, since they change the speed of flying.</param>
internal readonly record struct KeyChord(Key Key, KeyModifiers Modifiers = KeyModifiers.None)
{
    private static readonly (string Text, KeyModifiers Modifier)[] Prefixes =
    [
        ("Ctrl+", KeyModifiers.Control), ("Shift+", KeyModifiers.Shift), ("Alt+", KeyModifiers.Alt),
    ];

    private static readonly (Key Key, string Name)[] SpecialNames =
    [
        (Key.PageUp, "Page Up"), (Key.PageDown, "Page Down"), (Key.Escape, "Esc"), (Key.Plus, "+"), (Key.Minus, "-"),
        (Key.Comma, ","), (Key.Period, "."), (Key.Slash, "/"), (Key.LeftBracket, "["), (Key.RightBracket, "]"),
    ];

    public static KeyChord Of(KeyPressed pressed) => new(
        KeypadTwin(pressed.Key),
        // Many keyboards have + above =, with Shift.
        !pressed.Modifiers.HasFlag(KeyModifiers.Control) ? KeyModifiers.None
            : pressed.Modifiers & ~(pressed.Key == Key.Plus ? KeyModifiers.Alt | KeyModifiers.Shift : KeyModifiers.Alt));

    /// <summary>Makes the chord of a key that is held together with Ctrl.</summary>
    public static KeyChord Control(Key key) => new(key, KeyModifiers.Control);

    /// <summary>Makes the chord of a key that is held together with Ctrl and Shift.</summary>
    public static KeyChord ControlShift(Key key) => new(key, KeyModifiers.Control | KeyModifiers.Shift);

    /// <summary>Reads a chord as <see cref="ToString"/> writes it; upper and lower case are alike.</summary>
    public static bool TryParse(string text, out KeyChord chord)
    {
        var modifiers = KeyModifiers.None;
        var rest = text.Trim();
        foreach (var (prefix, modifier) in Prefixes)
        {
            if (rest.StartsWith(prefix, StringComparison.OrdinalIgnoreCase) && rest.Length > prefix.Length)
            {
                modifiers |= modifier;
                rest = rest[prefix.Length..];
            }
        }

        foreach (var key in Enum.GetValues<Key>())
        {
            if (key != Key.Unknown && string.Equals(NameOf(key), rest, StringComparison.OrdinalIgnoreCase))
            {
                chord = new(key, modifiers);
                return true;
            }
        }

        chord = default;
        return false;
    }

    public override string ToString()
    {
        var modifiers = Modifiers;
        return string.Concat(Prefixes.Where(prefix => modifiers.HasFlag(prefix.Modifier)).Select(prefix => prefix.Text)) + NameOf(Key);
    }

    private static string NameOf(Key key)
    {
        var special = SpecialNames.FirstOrDefault(special => special.Key == key).Name;
        return special ?? (key is >= Key.Digit0 and <= Key.Digit9 ? key.ToString()["Digit".Length..] : key.ToString());
    }

    /// <summary>Returns the key that a key of the keypad equals.</summary>
    private static Key KeypadTwin(Key key) => key switch
    {
        >= Key.Keypad0 and <= Key.Keypad9 => Key.Digit0 + (key - Key.Keypad0),
        Key.KeypadEnter => Key.Enter,
        Key.KeypadPlus => Key.Plus,
        Key.KeypadMinus => Key.Minus,
        _ => key,
    };
}
