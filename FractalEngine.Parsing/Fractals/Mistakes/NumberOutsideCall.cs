using System.Text.RegularExpressions;
using FractalEngine.Parsing.Text.Mistakes;

namespace FractalEngine.Parsing.Fractals.Mistakes;

/// <summary>A blank in place of a dot within a call: <c>[t.1 2]</c>, or a vector number alone: <c>[1, 2]</c>.</summary>
internal sealed partial class NumberOutsideCall : TypicalMistake
{
    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure)
    {
        if (!failure.Expects(FractalParser.TransformationName) || !char.IsAsciiDigit(failure.Position.Current))
        {
            return null;
        }

        var call = TrailingCall().Match(failure.Before);
        var example = $"{call.Groups[1].Value}.{failure.Position.Current}";
        return call.Success
            ? $"the numbers of a call follow its name with dots and without blanks, as in '{example}'"
            : "a set holds calls of transformations, as in 't.1', and '#'";
    }

    [GeneratedRegex(@"(\w+(?:\.[0-9]+)+)\.?[ \t]*,?[ \t]*$")]
    private static partial Regex TrailingCall();
}
