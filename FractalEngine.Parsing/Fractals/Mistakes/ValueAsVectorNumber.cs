using FractalEngine.Parsing.Text.Mistakes;

namespace FractalEngine.Parsing.Fractals.Mistakes;

/// <summary>A value where the number of a vector stands: <c>t.a. (a, #, 0.5)</c>, or <c>t. ((1, 2, 3), #, #)</c>.</summary>
internal sealed class ValueAsVectorNumber : TypicalMistake
{
    /// <summary>The expectation of the number of a declared vector.</summary>
    public const string VectorNumber = "a vector number";

    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure) =>
        failure.Expects(VectorNumber) && failure.Position.Current is (>= '0' and <= '9') or '(' or '-' or '+' or '.'
            ? "values stand in a vector 'v x y z', and here stands the number of that vector"
            : null;
}
