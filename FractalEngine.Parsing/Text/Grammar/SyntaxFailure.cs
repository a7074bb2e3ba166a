using System.Text.RegularExpressions;

namespace FractalEngine.Parsing.Text.Grammar;

/// <summary>The furthest position that a parser reached in a faulty text, and what it expected there.</summary>
/// <param name="Position">Position of the first text that does not fit.</param>
/// <param name="Expected">Descriptions of what would have fitted, as in messages: keywords and characters stand in quotes.</param>
internal sealed record SyntaxFailure(Cursor Position, IReadOnlyList<string> Expected)
{
    /// <summary>The expectation that a declaration ends.</summary>
    public const string EndOfLine = "the end of the line";

    /// <summary>The expectation of a number.</summary>
    public const string Number = "a number";

    // A typical mistake is near; the rest of an enormous line is not read.
    private const int MaxContext = 200;

    /// <summary>The text of the line before the position, at most 200 characters of it.</summary>
    public string Before
    {
        get
        {
            var start = Math.Max(0, Position.Offset - MaxContext);
            var text = Position.Text.AsSpan(start, Position.Offset - start);
            return text[(text.LastIndexOfAny('\n', '\r') + 1)..].ToString();
        }
    }

    /// <summary>The text of the line from the position on, at most 200 characters of it.</summary>
    public string After
    {
        get
        {
            var text = Position.Rest[..Math.Min(MaxContext, Position.Rest.Length)];
            var length = text.IndexOfAny('\n', '\r');
            return (length < 0 ? text : text[..length]).ToString();
        }
    }

    /// <summary>Both, with a line feed between them.</summary>
    public string Line => $"{Before}\n{After}";

    /// <summary>What was expected, as the end of a message.</summary>
    public string Expectation => Expected.Count switch
    {
        0 => "",
        1 => $", expected {Expected[0]}",
        _ => $", expected {string.Join(", ", Expected.SkipLast(1))} or {Expected[^1]}",
    };

    /// <summary>Returns whether something was expected at the position.</summary>
    public bool Expects(string expected) => Expected.Contains(expected);

    /// <summary>Explains the failure by a mistake, if that is the one.</summary>
    /// <param name="pattern">Regular expression of <see cref="Line"/> with this mistake: <c>\n</c> is the position.</param>
    /// <param name="message">What to write instead, with groups of the pattern as <c>${name}</c>.</param>
    /// <param name="expected">What was expected at the position.</param>
    /// <returns>The message; null for any other failure.</returns>
    public string? Explain(string pattern, string message, params string[] expected)
    {
        if (!Array.TrueForAll(expected, Expects))
        {
            return null;
        }

        var match = Regex.Match(Line, pattern, RegexOptions.CultureInvariant);
        return match.Success ? match.Result(message) : null;
    }
}
