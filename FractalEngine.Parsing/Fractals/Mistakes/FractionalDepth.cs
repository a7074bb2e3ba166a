using System.Text.RegularExpressions;
using FractalEngine.Parsing.Text.Mistakes;

namespace FractalEngine.Parsing.Fractals.Mistakes;

/// <summary>A depth with a fraction: <c>&lt;$&gt;. z 3.5</c>.</summary>
internal sealed partial class FractionalDepth : TypicalMistake
{
    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure) =>
        failure.Expects(SyntaxFailure.EndOfLine) && failure.Position.Current == '.' && Depth().IsMatch(failure.Before)
            ? "a depth is a whole number"
            : null;

    [GeneratedRegex(@"[\p{L}_]\w*[ \t]+[0-9]+$")]
    private static partial Regex Depth();
}
