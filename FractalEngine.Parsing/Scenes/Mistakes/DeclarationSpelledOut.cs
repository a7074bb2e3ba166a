using FractalEngine.Parsing.Text.Mistakes;

namespace FractalEngine.Parsing.Scenes.Mistakes;

/// <summary>A whole word where a declaration has one letter: <c>camera (0, 0, -5) # 60</c>.</summary>
internal sealed class DeclarationSpelledOut : TypicalMistake
{
    private static readonly (string Word, string Letter, string Meaning)[] Words =
    [
        ("camera", "c", "a camera"), ("object", "o", "an object"), ("model", "o", "an object"), ("mesh", "o", "an object"),
        ("physics", "p", "a physics object"), ("body", "p", "a physics object"),
    ];

    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure)
    {
        if (!failure.Expects("'gravity'"))
        {
            return null;
        }

        foreach (var (word, letter, meaning) in Words)
        {
            if (failure.After.StartsWith(word, StringComparison.OrdinalIgnoreCase))
            {
                return $"{meaning} is declared by '{letter}'";
            }
        }

        return null;
    }
}
