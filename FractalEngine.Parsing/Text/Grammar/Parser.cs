using System.Collections.Immutable;
using System.Diagnostics.CodeAnalysis;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Text.Grammar;

/// <summary>
/// Base class of all parsers (paper §4.1.5): white space, characters, numbers, names and vectors. The furthest failure and what was
/// expected there are kept for the error message.
/// </summary>
/// <remarks>
/// Every <c>Parse…</c> method takes a cursor and returns whether the text there matches. On success it yields the value and the
/// cursor behind it; on failure the caller's cursor remains valid for another attempt.
/// </remarks>
/// <param name="source">Text that is parsed.</param>
public abstract class Parser(SourceText source)
{
    private static readonly ImmutableArray<string> QuotedAscii = [.. Enumerable.Range(0, 128).Select(static code => $"'{(char)code}'")];

    private readonly FailureLog _failures = new();

    // Several declarations begin with a name, which is read for each of them.
    private (int Offset, string Text) _name = (-1, "");
    private Diagnostic? _hint;

    /// <summary>Parses one item of a list.</summary>
    private protected delegate bool ItemParser<T>(Cursor cursor, out T item, out Cursor rest);

    /// <summary>Text that is being parsed.</summary>
    protected SourceText Source { get; } = source;

    /// <summary>
    /// The first hint about text that is valid but hardly meant so, if there is any. It is enough: a mistake of units is in all lines of
    /// a file.
    /// </summary>
    private protected ImmutableArray<Diagnostic> Hints => _hint is null ? [] : [_hint];

    /// <inheritdoc cref="CommonMistakes.Explain"/>
    private protected virtual string? Explain(SyntaxFailure failure) => CommonMistakes.Explain(failure);

    /// <summary>Creates an exception for text that is well-formed but has no valid meaning.</summary>
    /// <param name="cursor">Position of the faulty text.</param>
    /// <param name="message">One line of text without a full stop.</param>
    /// <param name="isLimitExceeded">True when the text is valid but exceeds a stated limit.</param>
    protected SourceException Error(Cursor cursor, string message, bool isLimitExceeded = false) =>
        Source.Error(cursor.Offset, message, isLimitExceeded);

    /// <summary>Throws for text that is well-formed but has no valid meaning.</summary>
    /// <param name="isFaulty">Whether it has none.</param>
    /// <param name="cursor">Position of the faulty text.</param>
    /// <param name="message">One line of text without a full stop.</param>
    private protected void ThrowIf([DoesNotReturnIf(true)] bool isFaulty, Cursor cursor, string message)
    {
        if (isFaulty)
        {
            throw Error(cursor, message);
        }
    }

    /// <summary>
    /// Creates the exception for the furthest failure: what was found there, and the mistake behind it, or else what was expected instead.
    /// </summary>
    protected SourceException SyntaxError()
    {
        var failure = _failures.Furthest(Source.Text);
        var reason = Explain(failure) is { } explanation ? $": {explanation}" : failure.Expectation;
        return Error(failure.Position, $"unexpected {Describe(failure.Position)}{reason}");
    }

    /// <summary>Records a hint about valid text, which becomes a warning.</summary>
    private protected void Hint(Cursor cursor, string? message) =>
        _hint ??= message is null ? null : Source.Diagnose(cursor.Offset, message, DiagnosticSeverity.Warning);

    /// <summary>Records what was expected at a position, for the error message. Always returns false.</summary>
    protected bool Fail(Cursor cursor, string expected) => _failures.Add(cursor, expected);

    /// <summary>Describes the text at a position for a message: a word, a character or the end.</summary>
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
        if (cursor.Current != '.')
        {
            NumberReader.TryRead(cursor.Rest, out _, out length);
        }

        while (IsNameCharacter(cursor.Peek(length)))
        {
            length++;
        }

        if (char.IsControl(cursor.Current))
        {
            return $"character U+{(int)cursor.Current:X4}";
        }

        return char.IsHighSurrogate(cursor.Current)
            ? $"'{cursor.Text.AsSpan(cursor.Offset, Math.Min(2, cursor.Rest.Length))}'"
            : $"'{Truncate(cursor.Rest[..Math.Max(length, 1)])}'";
    }

    /// <summary>Skips blanks and tabs, of which there may be none. Always returns true.</summary>
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

    /// <summary>Parses one given character.</summary>
    protected bool ParseChar(Cursor cursor, char character, out Cursor rest)
    {
        rest = cursor;
        if (cursor.IsAtEnd || cursor.Current != character)
        {
            return Fail(cursor, character < QuotedAscii.Length ? QuotedAscii[character] : $"'{character}'");
        }

        rest = cursor.Advance(1);
        return true;
    }

    /// <summary>Parses a given word that no further letter, digit or underscore follows.</summary>
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

    /// <summary>Parses a given word and at least one blank behind it.</summary>
    private protected bool ParseWordAndBlank(Cursor cursor, string word, out Cursor rest)
    {
        rest = cursor;
        return ParseWord(cursor, word, out var end) && ParseBlanks(end, out rest) && rest.Offset > end.Offset;
    }

    /// <summary>Parses one of several words, each with its value.</summary>
    private protected bool ParseChoice<T>(Cursor cursor, ReadOnlySpan<(T Value, string Word)> choices, out T value, out Cursor rest)
        where T : struct
    {
        foreach (var (choice, word) in choices)
        {
            if (ParseWord(cursor, word, out rest))
            {
                value = choice;
                return true;
            }
        }

        value = default;
        rest = cursor;
        return false;
    }

    /// <summary>Tells whether a name begins here.</summary>
    private protected static bool BeginsName(Cursor cursor) => char.IsLetter(cursor.Current) || cursor.Current == '_';

    /// <summary>Parses a name: a letter or underscore, then letters, digits, underscores, and hyphens before letters.</summary>
    protected bool ParseName(Cursor cursor, string expected, out string name, out Cursor rest)
    {
        name = "";
        rest = cursor;
        if (!BeginsName(cursor))
        {
            return Fail(cursor, expected);
        }

        if (cursor.Offset != _name.Offset)
        {
            var length = 1;
            while (IsNameCharacter(cursor.Peek(length)) || (cursor.Peek(length) == '-' && char.IsLetter(cursor.Peek(length + 1))))
            {
                length++;
            }

            // Calls one behind the other mostly are of the same function.
            var text = cursor.Rest[..length];
            _name = (cursor.Offset, text.SequenceEqual(_name.Text) ? _name.Text : text.ToString());
        }

        name = _name.Text;
        rest = cursor.Advance(name.Length);
        return true;
    }

    /// <summary>Parses a finite decimal number, independently of the culture.</summary>
    /// <exception cref="SourceException">The number is out of the range of a double.</exception>
    protected bool ParseNumber(Cursor cursor, out double number, out Cursor rest)
    {
        rest = cursor;
        if (!NumberReader.TryRead(cursor.Rest, out number, out var length))
        {
            return Fail(cursor, SyntaxFailure.Number);
        }

        rest = cursor.Advance(length);
        return double.IsFinite(number)
            ? true
            : throw Error(cursor, $"the number {Truncate(cursor.Rest[..length])} is beyond the range of a double");
    }

    /// <summary>Parses an integer without a sign; larger ones saturate at <see cref="int.MaxValue"/>.</summary>
    protected bool ParseInteger(Cursor cursor, string expected, out int number, out Cursor rest)
    {
        number = 0;
        rest = cursor;
        if (!char.IsAsciiDigit(cursor.Current))
        {
            return Fail(cursor, expected);
        }

        var length = 0;
        var value = 0L;
        for (; char.IsAsciiDigit(cursor.Peek(length)); length++)
        {
            value = Math.Min((value * 10) + (cursor.Peek(length) - '0'), int.MaxValue);
        }

        number = (int)value;
        rest = cursor.Advance(length);
        return true;
    }

    /// <summary>Returns the text between two positions, shortened for a message.</summary>
    protected static string TextBetween(Cursor start, Cursor end) => Truncate(start.Rest[..(end.Offset - start.Offset)]);

    /// <summary>Parses text between double quotes on one line; there are no escapes.</summary>
    protected bool ParseString(Cursor cursor, string expected, out string value, out Cursor rest)
    {
        value = "";
        rest = cursor;
        if (cursor.Current != '"')
        {
            return Fail(cursor, expected);
        }

        var length = cursor.Rest[1..].IndexOfAny('"', '\n', '\r');
        if (length < 0 || cursor.Peek(1 + length) != '"')
        {
            return Fail(cursor.Advance(1 + (length < 0 ? cursor.Rest.Length - 1 : length)), "'\"'");
        }

        value = cursor.Rest.Slice(1, length).ToString();
        rest = cursor.Advance(length + 2);
        return true;
    }

    /// <summary>Parses what separates the elements of a list: blanks, a comma, or both.</summary>
    protected bool ParseSeparator(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out rest);
        if (rest.Current == ',')
        {
            return ParseBlanks(rest.Advance(1), out rest);
        }

        return rest.Offset > cursor.Offset || Fail(cursor, "a blank or ','");
    }

    /// <summary>Parses a separator and the number behind it.</summary>
    protected bool ParseNextNumber(Cursor cursor, out double number, out Cursor rest)
    {
        number = 0;
        rest = cursor;
        // Where a value or a line ends, it is the number that is missing, not the separator before it.
        return IsAtEndOfLine(cursor) || cursor.Current == ')'
            ? Fail(cursor, SyntaxFailure.Number)
            : ParseSeparator(cursor, out var start) && ParseNumber(start, out number, out rest);
    }

    /// <summary>Parses three numbers with separators between them.</summary>
    protected bool ParseComponents(Cursor cursor, out Vector vector, out Cursor rest)
    {
        vector = default;
        return ParseNumber(cursor, out var x, out rest) && ParseNextNumber(rest, out var y, out rest)
            && ParseNextNumber(rest, out var z, out rest) && Set(ref vector, new(x, y, z));
    }

    /// <summary>Parses a vector in parentheses: <c>(x, y, z)</c>.</summary>
    protected bool ParseVector(Cursor cursor, out Vector vector, out Cursor rest)
    {
        vector = default;
        return ParseChar(cursor, '(', out rest) && ParseBlanks(rest, out rest)
            && ParseComponents(rest, out vector, out rest)
            && ParseBlanks(rest, out rest) && ParseChar(rest, ')', out rest);
    }

    /// <summary>Parses blanks and the end of the line or of the text. The rest begins with the next line.</summary>
    protected bool ParseEndOfLine(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out rest);
        if (!IsAtEndOfLine(rest))
        {
            return Fail(rest, SyntaxFailure.EndOfLine);
        }

        rest = SkipLineBreak(rest);
        return true;
    }

    /// <summary>Parses a comment that begins with '#', if there is one, and the end of the line.</summary>
    protected bool ParseCommentAndEndOfLine(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out rest);
        return rest.Current == '#' ? ParseComment(rest, out rest) : ParseEndOfLine(rest, out rest);
    }

    /// <summary>Parses a comment from its '#' to the end of the line. The rest begins with the next line.</summary>
    protected static bool ParseComment(Cursor cursor, out Cursor rest)
    {
        if (cursor.Current != '#')
        {
            rest = cursor;
            return false;
        }

        rest = SkipLine(cursor);
        return true;
    }

    /// <summary>
    /// Reads all text up to the end of the line or up to a comment, without the blanks at either end. Names may contain blanks; a
    /// '#' begins a comment only behind a blank.
    /// </summary>
    protected string ReadRestOfLine(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out var start);
        rest = start;
        while (!IsAtEndOfLine(rest) && !(rest.Current == '#' && rest.Offset > 0 && rest.Peek(-1) is ' ' or '\t'))
        {
            ParseBlanks(rest, out var next);
            rest = next.Offset > rest.Offset ? next : rest.Advance(1);
        }

        return start.Rest[..(rest.Offset - start.Offset)].Trim().ToString();
    }

    /// <summary>Parses a text of lines with one item each, between empty ones and comments.</summary>
    /// <exception cref="SourceException">A line holds something else.</exception>
    private protected ImmutableArray<T> ParseLines<T>(ItemParser<T> parseItem)
    {
        var items = ImmutableArray.CreateBuilder<T>();
        for (var cursor = Source.Start; !cursor.IsAtEnd;)
        {
            ParseBlanks(cursor, out cursor);
            if (!IsAtEndOfLine(cursor) && cursor.Current != '#')
            {
                items.Add(parseItem(cursor, out var item, out cursor) ? item : throw SyntaxError());
            }

            cursor = ParseCommentAndEndOfLine(cursor, out cursor) ? cursor : throw SyntaxError();
        }

        return items.ToImmutable();
    }

    /// <summary>Sets a variable, as the last step of a sequence. Always returns true.</summary>
    private protected static bool Set<T>(ref T variable, T value)
    {
        variable = value;
        return true;
    }

    /// <summary>Skips one line break of any system, if there is one.</summary>
    private static Cursor SkipLineBreak(Cursor cursor) => cursor.Advance(cursor.Current switch
    {
        '\r' when cursor.Peek(1) == '\n' => 2,
        '\r' or '\n' => 1,
        _ => 0,
    });

    /// <summary>Returns whether a line break or the end of the text follows.</summary>
    protected static bool IsAtEndOfLine(Cursor cursor) => cursor.IsAtEnd || cursor.Current is '\n' or '\r';

    /// <summary>Returns the start of the next line, or the end of the text.</summary>
    protected internal static Cursor SkipLine(Cursor cursor) => SkipLineBreak(cursor.Advance(cursor.RestOfLine.Length));

    private static string Truncate(ReadOnlySpan<char> text) => text.Length <= 40 ? text.ToString() : $"{text[..37]}...";

    private static bool IsNameCharacter(char character) => char.IsLetterOrDigit(character) || character == '_';
}
