namespace FractalEngine.Parsing.Text;

/// <summary>A place in a text. Immutable: parsing yields a new cursor, and a failed attempt leaves the old one as it was.</summary>
/// <param name="Text">The whole text; never copied or cut.</param>
/// <param name="Offset">Characters before the place, from 0 to the text's length.</param>
public readonly record struct Cursor(string Text, int Offset)
{
    /// <summary>What stands for the character behind the end.</summary>
    public const char EndOfText = '\0';

    /// <summary>True behind the last character.</summary>
    public bool IsAtEnd => Offset >= Text.Length;

    /// <summary>The next character, or <see cref="EndOfText"/>.</summary>
    public char Current => (uint)Offset < (uint)Text.Length ? Text[Offset] : EndOfText;

    /// <summary>The text from here to its end.</summary>
    public ReadOnlySpan<char> Rest => Text.AsSpan(Offset);

    /// <summary>The character <paramref name="distance"/> places on, or <see cref="EndOfText"/>.</summary>
    public char Peek(int distance) => (uint)(Offset + distance) < (uint)Text.Length ? Text[Offset + distance] : EndOfText;

    /// <summary>The place <paramref name="distance"/> characters on.</summary>
    public Cursor Advance(int distance) => new(Text, Offset + distance);
}
