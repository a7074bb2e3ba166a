using System.Collections.Immutable;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Text.Grammar;

/// <content>Keeps the furthest failure and the hints, and makes messages of them.</content>
public abstract partial class Parser
{
    private readonly List<string> _expected = [];
    private readonly ImmutableArray<Diagnostic>.Builder _hints = ImmutableArray.CreateBuilder<Diagnostic>();
    private int _furthestFailure = -1;

    /// <summary>Hints about text that is valid but hardly meant so, in the order in which they were found.</summary>
    private protected ImmutableArray<Diagnostic> Hints => _hints.ToImmutable();

    /// <inheritdoc cref="CommonMistakes.Explain"/>
    private protected virtual string? Explain(SyntaxFailure failure) => CommonMistakes.Explain(failure);

    /// <summary>Creates an exception for text that is well-formed but has no valid meaning.</summary>
    /// <param name="cursor">Position of the faulty text.</param>
    /// <param name="message">One line of text without a full stop.</param>
    /// <param name="isLimitExceeded">True when the text is valid but exceeds a stated limit.</param>
    protected SourceException Error(Cursor cursor, string message, bool isLimitExceeded = false) =>
        Source.Error(cursor.Offset, message, isLimitExceeded);

    /// <summary>
    /// Creates the exception for the furthest failure: what was found there, and the mistake behind it, or else what was expected instead.
    /// </summary>
    protected SourceException SyntaxError()
    {
        var failure = new Cursor(Source.Text, Math.Max(_furthestFailure, 0));
        if (Explain(new SyntaxFailure(failure, _expected)) is { } explanation)
        {
            return Source.Error(failure.Offset, $"unexpected {Describe(failure)}: {explanation}");
        }

        var expected = _expected.Count switch
        {
            0 => "",
            1 => $", expected {_expected[0]}",
            _ => $", expected {string.Join(", ", _expected.SkipLast(1))} or {_expected[^1]}",
        };
        return Source.Error(failure.Offset, $"unexpected {Describe(failure)}{expected}");
    }

    /// <summary>
    /// Records a hint about valid text, which becomes a warning. The first of a file is enough: a mistake of units is in all its lines.
    /// </summary>
    private protected void Hint(Cursor cursor, string? message)
    {
        if (message is not null && _hints.Count == 0)
        {
            _hints.Add(Source.Diagnose(cursor.Offset, message, DiagnosticSeverity.Warning));
        }
    }

    /// <summary>Records what was expected at a position, for the error message. Always returns false.</summary>
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
}
