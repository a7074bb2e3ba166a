using System.Text.RegularExpressions;
using FractalEngine.Parsing.Text.Mistakes;

namespace FractalEngine.Parsing.Fractals.Mistakes;

/// <summary>The name of a mesh without its quotes: <c>x. cube.obj</c>.</summary>
internal sealed partial class FileNameWithoutQuotes : TypicalMistake
{
    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure) =>
        failure.Expects(SyntaxFailure.EndOfLine) && MeshEnding().IsMatch(failure.After) ? "the name of a file stands in quotes" : null;

    [GeneratedRegex(@"^[-\w./\\]*\.(obj|gz|ply|stl)[ \t]*$", RegexOptions.IgnoreCase)]
    private static partial Regex MeshEnding();
}
