namespace FractalEngine.Parsing.Text.Mistakes;

/// <summary>A comment behind a declaration, where <c>#</c> would be a value: <c>v 1 2 3 # the corner</c>.</summary>
internal sealed class CommentBehindDeclaration : TypicalMistake
{
    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure) =>
        failure.Position.Current == '#' && failure.Expects(SyntaxFailure.EndOfLine)
            ? "a comment stands on a line of its own, since '#' within a declaration is a value"
            : null;
}
