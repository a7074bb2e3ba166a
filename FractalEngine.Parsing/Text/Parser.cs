using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Text;

/// <summary>
/// The base of all parsers (paper §4.1.5): white space, characters, numbers, names, vectors. Every function takes a cursor and
/// returns whether what it looks for stands there; if so it yields the value and the cursor behind it, if not the cursor
/// stays good for another attempt. The farthest failure, and what was expected there, is kept for the error message.
/// </summary>
public abstract class Parser
{
    private readonly List<string> _expected = [];
    private int _furthestFailure = -1;

    /// <summary>A parser of one text.</summary>
    protected Parser(SourceText source) => Source = source;

    /// <summary>What is parsed.</summary>
    protected SourceText Source { get; }

    /// <summary>An exception for what was parsed but makes no sense.</summary>
    /// <param name="cursor">Where it stands.</param>
    /// <param name="message">What is wrong with it.</param>
    /// <param name="isLimitExceeded">True when it makes sense but goes beyond a stated limit.</param>
    protected SourceException Error(Cursor cursor, string message, bool isLimitExceeded = false) =>
        Source.Error(cursor.Offset, message, isLimitExceeded);

    /// <summary>The exception for the farthest failure: what stands there, and what was expected instead.</summary>
    protected SourceException SyntaxError()
    {
        var failure = new Cursor(Source.Text, Math.Max(_furthestFailure, 0));
        var expected = _expected.Count switch
        {
            0 => "",
            1 => $", expected {_expected[0]}",
            _ => $", expected {string.Join(", ", _expected.SkipLast(1))} or {_expected[^1]}",
        };
        return Source.Error(failure.Offset, $"unexpected {Describe(failure)}{expected}");
    }

    /// <summary>Notes that something else was expected, and fails.</summary>
    protected bool Fail(Cursor cursor, string expected)
    {
        if (cursor.Offset > _furthestFailure)
        {
            _furthestFailure = cursor.Offset;
            _expected.Clear();
        }

        if (cursor.Offset == _furthestFailure && !_expected.Contains(expected))
        {
            _expected.Add(expected);
        }

        return false;
    }

    /// <summary>Passes over blanks and tabs; always succeeds.</summary>
    protected virtual bool ParseBlanks(Cursor cursor, out Cursor rest)
    {
        var offset = cursor.Offset;
        var text = cursor.Text;
        while (offset < text.Length && text[offset] is ' ' or '\t')
        {
            offset++;
        }

        rest = new(text, offset);
        return true;
    }

    /// <summary>One given character.</summary>
    protected bool ParseChar(Cursor cursor, char character, out Cursor rest)
    {
        rest = cursor;
        if (cursor.IsAtEnd || cursor.Current != character)
        {
            return Fail(cursor, $"'{character}'");
        }

        rest = cursor.Advance(1);
        return true;
    }

    /// <summary>A given word, not followed by a further letter, digit or underscore.</summary>
    protected bool ParseWord(Cursor cursor, string word, out Cursor rest)
    {
        rest = cursor;
        if (!cursor.Rest.StartsWith(word, StringComparison.Ordinal) || IsNameCharacter(cursor.Peek(word.Length)))
        {
            return Fail(cursor, $"'{word}'");
        }

        rest = cursor.Advance(word.Length);
        return true;
    }

    /// <summary>A name: a letter or underscore, then letters, digits and underscores.</summary>
    protected bool ParseName(Cursor cursor, string expected, out string name, out Cursor rest)
    {
        (name, rest) = ("", cursor);
        if (!char.IsLetter(cursor.Current) && cursor.Current != '_')
        {
            return Fail(cursor, expected);
        }

        var length = 1;
        while (IsNameCharacter(cursor.Peek(length)))
        {
            length++;
        }

        (name, rest) = (cursor.Rest[..length].ToString(), cursor.Advance(length));
        return true;
    }

    /// <summary>A finite decimal number, the same in every culture.</summary>
    /// <exception cref="SourceException">The number is beyond the range of a double.</exception>
    protected bool ParseNumber(Cursor cursor, out double number, out Cursor rest)
    {
        rest = cursor;
        if (!NumberReader.TryRead(cursor.Rest, out number, out var length))
        {
            return Fail(cursor, "a number");
        }

        rest = cursor.Advance(length);
        return double.IsFinite(number) ? true
            : throw Error(cursor, $"the number {Truncate(cursor.Rest[..length])} is beyond the range of a double");
    }

    /// <summary>A whole number without sign; saturates at <see cref="int.MaxValue"/>.</summary>
    protected bool ParseInteger(Cursor cursor, string expected, out int number, out Cursor rest)
    {
        (number, rest) = (0, cursor);
        if (!char.IsAsciiDigit(cursor.Current))
        {
            return Fail(cursor, expected);
        }

        var (length, value) = (0, 0L);
        for (; char.IsAsciiDigit(cursor.Peek(length)); length++)
        {
            value = Math.Min((value * 10) + (cursor.Peek(length) - '0'), int.MaxValue);
        }

        (number, rest) = ((int)value, cursor.Advance(length));
        return true;
    }

    /// <summary>What stands between two places, for a message.</summary>
    protected static string TextBetween(Cursor start, Cursor end) => Truncate(start.Rest[..(end.Offset - start.Offset)]);

    /// <summary>Text between double quotes, on one line.</summary>
    protected bool ParseString(Cursor cursor, string expected, out string value, out Cursor rest)
    {
        (value, rest) = ("", cursor);
        if (cursor.Current != '"')
        {
            return Fail(cursor, expected);
        }

        var length = cursor.Rest[1..].IndexOfAny('"', '\n', '\r');
        if (length < 0 || cursor.Peek(1 + length) != '"')
        {
            return Fail(cursor.Advance(1 + (length < 0 ? cursor.Rest.Length - 1 : length)), "'\"'");
        }

        (value, rest) = (cursor.Rest.Slice(1, length).ToString(), cursor.Advance(length + 2));
        return true;
    }

    /// <summary>What stands between the parts of a list: blanks, a comma, or both.</summary>
    protected bool ParseSeparator(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out rest);
        if (rest.Current == ',')
        {
            return ParseBlanks(rest.Advance(1), out rest);
        }

        return rest.Offset > cursor.Offset || Fail(cursor, "','");
    }

    /// <summary>Three numbers with separators between them.</summary>
    protected bool ParseComponents(Cursor cursor, out Vector vector, out Cursor rest)
    {
        vector = default;
        if (ParseNumber(cursor, out var x, out rest) && ParseSeparator(rest, out rest)
            && ParseNumber(rest, out var y, out rest) && ParseSeparator(rest, out rest)
            && ParseNumber(rest, out var z, out rest))
        {
            vector = new(x, y, z);
            return true;
        }

        return false;
    }

    /// <summary><c>(x, y, z)</c>.</summary>
    protected bool ParseVector(Cursor cursor, out Vector vector, out Cursor rest)
    {
        vector = default;
        return ParseChar(cursor, '(', out rest) && ParseBlanks(rest, out rest)
            && ParseComponents(rest, out vector, out rest)
            && ParseBlanks(rest, out rest) && ParseChar(rest, ')', out rest);
    }

    /// <summary>Blanks and the end of a line or of the text; the cursor then stands on the next line.</summary>
    protected bool ParseEndOfLine(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out rest);
        if (!IsAtEndOfLine(rest))
        {
            return Fail(rest, "the end of the line");
        }

        rest = SkipLineBreak(rest);
        return true;
    }

    /// <summary>Passes over a line break of any system, if one stands here.</summary>
    private static Cursor SkipLineBreak(Cursor cursor) => cursor.Advance(cursor.Current switch
    {
        '\r' when cursor.Peek(1) == '\n' => 2,
        '\r' or '\n' => 1,
        _ => 0,
    });

    /// <summary>True before a line break and behind the last character.</summary>
    protected static bool IsAtEndOfLine(Cursor cursor) => cursor.IsAtEnd || cursor.Current is '\n' or '\r';

    /// <summary>The start of the next line.</summary>
    protected static Cursor SkipLine(Cursor cursor)
    {
        var length = cursor.Rest.IndexOfAny('\n', '\r');
        return length < 0 ? cursor.Advance(cursor.Rest.Length) : SkipLineBreak(cursor.Advance(length));
    }

    /// <summary>What stands at a place, for a message: a word, a character, or the end.</summary>
    protected static string Describe(Cursor cursor)
    {
        if (cursor.IsAtEnd)
        {
            return "end of file";
        }

        if (IsAtEndOfLine(cursor))
        {
            return "end of line";
        }

        var length = 0;
        while (IsNameCharacter(cursor.Peek(length)))
        {
            length++;
        }

        return char.IsControl(cursor.Current) ? $"character U+{(int)cursor.Current:X4}"
            : char.IsHighSurrogate(cursor.Current) ? $"'{cursor.Text.AsSpan(cursor.Offset, Math.Min(2, cursor.Rest.Length))}'"
            : $"'{Truncate(cursor.Rest[..Math.Max(length, 1)])}'";
    }

    private static string Truncate(ReadOnlySpan<char> text) => text.Length <= 40 ? text.ToString() : $"{text[..37]}...";

    private static bool IsNameCharacter(char character) => char.IsLetterOrDigit(character) || character == '_';
}
