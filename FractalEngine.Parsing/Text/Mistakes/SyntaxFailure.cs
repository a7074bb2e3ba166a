namespace FractalEngine.Parsing.Text.Mistakes;

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

    /// <summary>True where the line or the text ends at the position.</summary>
    public bool IsAtEndOfLine => Position.IsAtEnd || Position.Current is '\n' or '\r';

    /// <summary>Returns whether something was expected at the position.</summary>
    public bool Expects(string expected) => Expected.Contains(expected);
}
