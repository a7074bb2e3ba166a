using FractalEngine.Core;

namespace FractalEngine.Parsing.Text.Mistakes;

/// <summary>A word that is nearly one of the expected keywords: <c>gravty</c>, or <c>Light</c>.</summary>
internal sealed class MisspelledKeyword : TypicalMistake
{
    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure)
    {
        var word = new string([.. failure.After.TakeWhile(static character => char.IsLetterOrDigit(character) || character is '_' or '-')]);
        var keywords = failure.Expected
            .Where(static expected => expected.Length > 2 && expected[0] == '\'' && char.IsLetter(expected[1]))
            .Select(static expected => expected[1..^1]);
        return NameSuggestion.Find(word, keywords) is { } keyword ? $"did you mean '{keyword}'?" : null;
    }
}
