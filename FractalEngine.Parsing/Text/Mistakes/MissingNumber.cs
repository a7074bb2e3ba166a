namespace FractalEngine.Parsing.Text.Mistakes;

/// <summary>A vector with one or two numbers: <c>(1, 2)</c>.</summary>
internal sealed class MissingNumber : TypicalMistake
{
    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure)
    {
        if (!failure.Expects(SyntaxFailure.Number) || !(failure.IsAtEndOfLine || failure.Position.Current is ')' or '#'))
        {
            return null;
        }

        var numbers = NumberGroup.Before(failure).Split([' ', '\t', ','], StringSplitOptions.RemoveEmptyEntries);
        return numbers.Length is 1 or 2 && numbers.All(IsNumber)
            ? $"a vector has three numbers, and this one has {(numbers.Length == 1 ? "one" : "two")}"
            : null;
    }

    private static bool IsNumber(string text) => NumberReader.TryRead(text, out _, out var length) && length == text.Length;
}
