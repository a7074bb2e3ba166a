using FractalEngine.Parsing.Text.Mistakes;

namespace FractalEngine.Parsing.Fractals.Mistakes;

/// <summary>Parentheses around a declared vector: <c>v (0, 1, 0)</c>.</summary>
internal sealed class VectorInParentheses : TypicalMistake
{
    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure) =>
        failure.Expects(SyntaxFailure.Number) && failure.Position.Current == '(' && failure.Before.Trim() == "v"
            ? "the numbers of a vector stand without parentheses, as in 'v 0 1 0'"
            : null;
}
