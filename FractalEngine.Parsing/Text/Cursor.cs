namespace FractalEngine.Parsing.Text;

/// <summary>Immutable position in a text. Parsing yields a new cursor; a failed attempt leaves the old one unchanged.</summary>
/// <param name="Text">Whole text, never copied or cut.</param>
/// <param name="Offset">Number of characters before the position, from 0 to the length of the text.</param>
public readonly record struct Cursor(string Text, int Offset)
{
    /// <summary>Character reported at the end of the text and behind it.</summary>
    public const char EndOfText = '\0';

    /// <summary>True when no character is left to read.</summary>
    public bool IsAtEnd => Offset >= Text.Length;

    /// <summary>Next character of the text, or <see cref="EndOfText"/> at its end.</summary>
    public char Current => (uint)Offset < (uint)Text.Length ? Text[Offset] : EndOfText;

    /// <summary>Text from this position to its end.</summary>
    public ReadOnlySpan<char> Rest => Text.AsSpan(Offset);

    /// <summary>Text from this position to the end of its line.</summary>
    public ReadOnlySpan<char> RestOfLine => Rest.IndexOfAny('\n', '\r') is >= 0 and var length ? Rest[..length] : Rest;

    /// <summary>Returns the character <paramref name="distance"/> positions ahead, or <see cref="EndOfText"/>.</summary>
    public char Peek(int distance) => (uint)(Offset + distance) < (uint)Text.Length ? Text[Offset + distance] : EndOfText;

    /// <summary>Returns the position <paramref name="distance"/> characters ahead.</summary>
    public Cursor Advance(int distance) => new(Text, Offset + distance);
}
