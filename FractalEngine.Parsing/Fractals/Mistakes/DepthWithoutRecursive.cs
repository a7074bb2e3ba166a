using System.Text.RegularExpressions;
using FractalEngine.Parsing.Text.Mistakes;

namespace FractalEngine.Parsing.Fractals.Mistakes;

/// <summary>A depth without the recursive before it, <c>&lt;$&gt;. 6</c>, or joined to it by a dot, <c>&lt;$&gt;. z.6</c>.</summary>
internal sealed partial class DepthWithoutRecursive : TypicalMistake
{
    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure)
    {
        if (failure.Expects(FractalParser.ObjectName) && char.IsAsciiDigit(failure.Position.Current))
        {
            return $"a depth follows the name of a recursive, as in 'z {failure.Position.Current}'";
        }

        var name = TrailingName().Match(failure.Before).Value;
        if (!failure.Expects(SyntaxFailure.EndOfLine) || name.Length == 0 || !DotAndDigits().IsMatch(failure.After))
        {
            return null;
        }

        return EndsLine().IsMatch(failure.After)
            ? $"a blank stands between a recursive and its depth, as in '{name} {failure.After.TrimEnd()[1..]}'"
            : $"calls stand in brackets, as in '[{name}.1] x'";
    }

    [GeneratedRegex(@"[\p{L}_]\w*$")]
    private static partial Regex TrailingName();

    [GeneratedRegex(@"^\.[0-9]+")]
    private static partial Regex DotAndDigits();

    [GeneratedRegex(@"^\.[0-9]+[ \t]*$")]
    private static partial Regex EndsLine();
}
