namespace FractalEngine.Parsing.Text.Grammar;

/// <summary>Keeps the furthest failure of a parser. Those before it are of ways that were given up.</summary>
internal sealed class FailureLog
{
    private readonly List<string> _expected = [];
    private int _offset = -1;

    /// <summary>Records what was expected at a position. Always returns false.</summary>
    public bool Add(Cursor cursor, string expected)
    {
        if (cursor.Offset > _offset)
        {
            _offset = cursor.Offset;
            _expected.Clear();
        }

        if (cursor.Offset == _offset && !_expected.Contains(expected))
        {
            _expected.Add(expected);
        }

        return false;
    }

    /// <summary>Returns the furthest failure, with all that was expected there.</summary>
    /// <param name="text">The text that the parser reads.</param>
    public SyntaxFailure Furthest(string text) => new(new(text, Math.Max(_offset, 0)), _expected);
}
