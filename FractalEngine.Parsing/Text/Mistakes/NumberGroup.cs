namespace FractalEngine.Parsing.Text.Mistakes;

/// <summary>The numbers that belong together where parsing failed: those in parentheses, or those of a line.</summary>
internal static class NumberGroup
{
    /// <summary>Returns the text of the group before a failure.</summary>
    public static string Before(SyntaxFailure failure)
    {
        var line = failure.Before;
        var parenthesis = line.LastIndexOfAny(['(', ')']);
        if (parenthesis >= 0)
        {
            return line[parenthesis] == '(' ? line[(parenthesis + 1)..] : "";
        }

        // A line of points is all numbers; a vector of a fractal file has its letter before them.
        var start = line.TrimStart();
        return start.StartsWith("v ", StringComparison.Ordinal) || start.StartsWith("v\t", StringComparison.Ordinal) ? start[2..] : start;
    }

    /// <summary>Returns the text of the group before and behind a failure.</summary>
    public static string Around(SyntaxFailure failure)
    {
        var rest = failure.After;
        var end = rest.IndexOfAny([')', '#']);
        return Before(failure) + (end < 0 ? rest : rest[..end]);
    }
}
