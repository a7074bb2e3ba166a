using System.Text.RegularExpressions;

namespace FractalEngine.Parsing.Text.Mistakes;

/// <summary>A number with a comma as decimal point, which reads as two numbers: <c>(0,5 1 2)</c>.</summary>
internal sealed partial class CommaAsDecimalPoint : TypicalMistake
{
    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure) => (FindInVector(failure) ?? FindAtPosition(failure)) is { } number
        ? $"the decimal point is a point, so write {number.Replace(',', '.')} instead of {number}"
        : null;

    /// <summary>Finds such a number in a vector that has three numbers if the comma is a point.</summary>
    private static string? FindInVector(SyntaxFailure failure)
    {
        var numbers = WideSeparator().Split(NumberGroup.Around(failure).Trim());
        return numbers.Length == 3 && numbers.All(static number => AnyNumber().IsMatch(number))
            ? numbers.FirstOrDefault(static number => number.Contains(','))
            : null;
    }

    /// <summary>Finds such a number where one number ends the declaration.</summary>
    private static string? FindAtPosition(SyntaxFailure failure)
    {
        if (failure.Position.Current != ',' || !failure.Expects(SyntaxFailure.EndOfLine))
        {
            return null;
        }

        var integer = TrailingInteger().Match(failure.Before);
        var fraction = CommaAndDigits().Match(failure.After);
        return integer.Success && fraction.Success ? integer.Value + fraction.Value : null;
    }

    [GeneratedRegex(@",?[ \t]+")]
    private static partial Regex WideSeparator();

    [GeneratedRegex(@"^[-+]?[0-9]+([.,][0-9]+)?$")]
    private static partial Regex AnyNumber();

    [GeneratedRegex(@"(?<![0-9.,])[-+]?[0-9]+$")]
    private static partial Regex TrailingInteger();

    [GeneratedRegex(@"^,[0-9]+")]
    private static partial Regex CommaAndDigits();
}
