using System.Text.RegularExpressions;
using FractalEngine.Core;
using FractalEngine.Parsing.Text.Mistakes;

namespace FractalEngine.Parsing.Fractals.Mistakes;

/// <summary>
/// A misspelt <c>v</c> or <c>composition</c>. Any word can be the name of an object, so that parsing fails only behind it.
/// </summary>
internal sealed partial class MisspelledDeclaration : TypicalMistake
{
    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure)
    {
        var word = failure.Before.Trim();
        if (!failure.Expects("'.'") || !failure.Expects("'<'"))
        {
            return null;
        }

        return VectorWord().IsMatch(word) ? "a vector is 'v', a blank and three numbers"
            : NameSuggestion.Find(word, ["composition"]) is { } keyword ? $"did you mean '{keyword}'?"
            : null;
    }

    [GeneratedRegex("^([vV][0-9]*|[vV]ec(tor)?|V)$")]
    private static partial Regex VectorWord();
}
