using System.Text.RegularExpressions;
using FractalEngine.Core;

namespace FractalEngine.Parsing.Text.Grammar;

/// <summary>Mistakes that are made in all kinds of files. Of several rows the first one that fits explains a failure.</summary>
internal static class CommonMistakes
{
    private const string Number = @"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?";

    // A line of points is all numbers; a vector of a fractal file has its letter before them.
    private const string BeforeNumbers = @"(?:^\s*(?:v[ \t])?|\()[ \t,]*";

    /// <summary>Explains a failure in a file that has no other typical mistakes.</summary>
    /// <returns>What to write instead, as one clause without a full stop; null where the text has another mistake.</returns>
    public static string? Explain(SyntaxFailure failure) => ExplainNumbers(failure) ?? ExplainKeyword(failure);

    /// <summary>Explains a failure among numbers.</summary>
    /// <inheritdoc cref="Explain"/>
    public static string? ExplainNumbers(SyntaxFailure failure) =>
        // v 1 2 3 # the corner
        failure.Explain(
            @"\n#", "a comment stands on a line of its own, since '#' within a declaration is a value", SyntaxFailure.EndOfLine)
        ?? ExplainDecimalComma(failure)
        // c # # 60,5
        ?? failure.Explain(
            @"(?<![0-9.,])(?<integer>[-+]?[0-9]+)\n,(?<fraction>[0-9]+)",
            "the decimal point is a point, so write ${integer}.${fraction} instead of ${integer},${fraction}", SyntaxFailure.EndOfLine)
        // (1, 2)
        ?? failure.Explain(
            $@"{BeforeNumbers}{Number}[ \t,]*\n([)#]|\z)", "a vector has three numbers, and this one has one", SyntaxFailure.Number)
        ?? failure.Explain(
            $@"{BeforeNumbers}{Number}[ \t,]+{Number}[ \t,]*\n([)#]|\z)", "a vector has three numbers, and this one has two",
            SyntaxFailure.Number);

    /// <summary>Explains a word that is nearly one of the expected keywords: <c>gravty</c>, or <c>Light</c>.</summary>
    /// <inheritdoc cref="Explain"/>
    public static string? ExplainKeyword(SyntaxFailure failure)
    {
        var word = new string([.. failure.After.TakeWhile(static character => char.IsLetterOrDigit(character) || character is '_' or '-')]);
        var keywords = failure.Expected
            .Where(static expected => expected.Length > 2 && expected[0] == '\'' && char.IsLetter(expected[1]))
            .Select(static expected => expected[1..^1]);
        return NameSuggestion.Find(word, keywords) is { } keyword ? $"did you mean '{keyword}'?" : null;
    }

    /// <summary>Explains numbers that are three if a comma is a decimal point: <c>(0,5 1 2)</c>, which reads as four numbers.</summary>
    private static string? ExplainDecimalComma(SyntaxFailure failure)
    {
        // The numbers that belong together around the failure: those in parentheses, or those of a line.
        var group = Regex.Match(
            failure.Line, @"(?:^\s*(?:v[ \t])?(?<before>[^()]*)|\((?<before>[^()]*)|\)[^()]*)\n(?<after>[^)#]*)").Groups;
        var numbers = Regex.Split((group["before"].Value + group["after"].Value).Trim(), @",?[ \t]+");
        var areThree = numbers.Length == 3 && Array.TrueForAll(numbers, static text => Regex.IsMatch(text, @"^[-+]?[0-9]+([.,][0-9]+)?$"));
        return areThree && Array.Find(numbers, static text => text.Contains(',')) is { } number
            ? $"the decimal point is a point, so write {number.Replace(',', '.')} instead of {number}"
            : null;
    }
}
