namespace FractalEngine.Render.Windowing.Keyboard;

/// <summary>Names keys by the characters on their caps, so that other keyboard layouts than the American one work.</summary>
internal static class KeyCharacters
{
    /// <summary>Returns the key with a character on its cap, in lower case; <see cref="Key.Unknown"/> where that has no name.</summary>
    public static Key KeyOf(int character) => character switch
    {
        >= 'a' and <= 'z' => Key.A + (character - 'a'),
        >= '0' and <= '9' => Key.Digit0 + (character - '0'),
        '+' or '=' => Key.Plus,
        '-' => Key.Minus,
        ',' => Key.Comma,
        '.' => Key.Period,
        '/' => Key.Slash,
        '[' => Key.LeftBracket,
        ']' => Key.RightBracket,
        _ => Key.Unknown,
    };
}
