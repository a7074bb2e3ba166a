using FractalEngine.Core;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Mistakes that are made in fractal files. Of several rows the first one that fits explains a failure.</summary>
internal static class FractalMistakes
{
    /// <summary>The expectation of the name of a declared object.</summary>
    public const string ObjectName = "the name of an object";

    /// <summary>The expectation of the name of a declared transformation.</summary>
    public const string TransformationName = "the name of a transformation";

    /// <summary>The expectation of the number of a declared vector.</summary>
    public const string VectorNumber = "a vector number";

    /// <inheritdoc cref="CommonMistakes.Explain"/>
    public static string? Explain(SyntaxFailure failure) =>
        // v 1 2 3 # the corner
        failure.Explain(
            @"\n#", "a comment in a line begins with '//', since '#' within a declaration is a value", SyntaxFailure.EndOfLine)
        ?? CommonMistakes.ExplainNumbers(failure)
        // t.a. (a, #, 0.5)
        ?? failure.Explain(
            @"\n[-+.0-9]", "numbers stand in parentheses, as in '(0.5)' or '(0, 1, 0)', but for that of a vector", VectorNumber)
        // t. (1, #) or [((1, 0, 0), #)]
        ?? failure.Explain(
            @"\n\)", "a map has a position, a rotation and a scale, as in '((1, 0, 0), #, (0.5))'", "a blank or ','")
        // (0 1 0) as an output
        ?? failure.Explain(@"\([^()]*\n[-+.(0-9\p{L}]", "commas stand between the components of a vector, as in '(0, 1, 0)'", "','", "')'")
        // [t.^1.5]
        ?? failure.Explain(@"\^-?[0-9]+\n\.", "the power of a map is a whole number")
        // <$>. z k, or box ball
        ?? failure.Explain(
            @"\n(?<name>[\p{L}_][\p{L}0-9_]*)[ \t]*\z",
            "objects have a plus sign between them, as in '+ ${name}', and a depth that is computed has parentheses, as in '(${name})'",
            "a depth")
        // [t.1 2]
        ?? failure.Explain(
            @"(?<call>\w+(\.[0-9]+)+)\.?[ \t]*,?[ \t]*\n(?<digit>[0-9])",
            "the numbers of a call follow its name with dots and without blanks, as in '${call}.${digit}'", TransformationName)
        // [1, 2]
        ?? failure.Explain(@"\n[0-9]", "a set holds calls of transformations, as in 't.1', and '#'", TransformationName)
        // <$>. 6
        ?? failure.Explain(@"\n(?<digit>[0-9])", "a depth follows the name of a recursive, as in 'z ${digit}'", ObjectName)
        // <$>. z.6
        ?? failure.Explain(
            @"(?<name>[\p{L}_]\w*)\n\.(?<depth>[0-9]+)[ \t]*\z",
            "a blank stands between a recursive and its depth, as in '${name} ${depth}'", SyntaxFailure.EndOfLine)
        // y. t.1 x
        ?? failure.Explain(
            @"(?<name>[\p{L}_]\w*)\n\.[0-9]", "calls stand in brackets, as in '[${name}.1] x'", SyntaxFailure.EndOfLine)
        // <$>. z 3.5
        ?? failure.Explain(@"[\p{L}_]\w*[ \t]+[0-9]+\n\.", "a depth is a whole number", SyntaxFailure.EndOfLine)
        // v (0, 1, 0)
        ?? failure.Explain(
            @"^\s*v\s*\n\(", "the numbers of a vector stand without parentheses, as in 'v 0 1 0'", SyntaxFailure.Number)
        // x. cube.obj
        ?? failure.Explain(
            @"\n[-\w./\\]*\.(?i:obj|gz|ply|stl)[ \t]*\z", "the name of a file stands in quotes", SyntaxFailure.EndOfLine)
        // v1 2 3: any word can be the name of an object, so that parsing fails only behind it.
        ?? failure.Explain(
            @"^\s*([vV][0-9]*|[vV]ec(tor)?)\s*\n", "a vector is 'v', a blank and three numbers", "'.'", "'<'")
        ?? ExplainComposition(failure)
        // t.a (a, #, #)
        ?? failure.Explain(
            @"^[ \t]*\w+(\.\w+)*\.(?<parameter>\w+)[ \t]*\n\(",
            "a dot is missing behind '${parameter}': each parameter of a transformation ends with one, as in 't.a.'")
        // [t]
        ?? failure.Explain(
            @"\[[^\[\]]*?(?<name><\$>|<\w+>|\w+)\n",
            "a dot is missing behind '${name}': a call has the numbers of its vectors behind dots, as in '${name}.1'", "'.'")
        // x "cube.obj" or <$> z
        ?? failure.Explain(@"(?<name><\$>|<\w+>|\w+)\n", "a dot is missing behind '${name}'", "'.'")
        ?? CommonMistakes.ExplainKeyword(failure);

    private static string? ExplainComposition(SyntaxFailure failure) =>
        failure.Expects("'.'") && failure.Expects("'<'") && NameSuggestion.Find(failure.Before.Trim(), ["composition"]) is { } keyword
            ? $"did you mean '{keyword}'?"
            : null;
}
