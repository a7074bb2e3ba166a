using System.Collections.Immutable;
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

    /// <summary>How a map is written, for messages.</summary>
    public const string MapExample = "'((1, 0, 0), #, (0.5))'";

    private const string Name = @"[\p{L}_][\p{L}0-9_]*";

    // Text before and after the failure with a line feed between them, what to say, and what was expected there.
    private static readonly ImmutableArray<(string Pattern, string Message, string Expected)> Rows =
    [
        // t. (#, #, #) color (1, 0, 0) 0.5
        (@"\n(?i:colou?r)\b", "a colour is written as 'colour (1, 0, 0) 0.5', behind the three outputs of a map", ""),
        // seed 1.5
        (@"^[ \t]*seed[ \t]+[0-9]*\n[-.]", "a seed is a whole number that is not negative", ""),
        // <$>. box | ball
        (@"\n\|", "what stands there by chance has weights, as in '1: box | 1: ball'", ""),
        // [t.] 1: box | 2: ball
        (@"\][ \t]*\n[0-9.]+[ \t]*:", "a choice behind a set stands in parentheses, as in '[t.] (1: box | 2: ball)'", ""),
        // 1 box | 1 ball
        (@"\n(?<weight>[0-9.]+)[ \t]+[\p{L}_(\[][^|]*\|", "a weight has a colon behind it, as in '${weight}: box'", ObjectName),
        // z 4 until 0.2
        (@"\nuntil[ \t]", "a recursive ends by its depth or by its size, as in 'z until 0.02'", SyntaxFailure.EndOfLine),
        // t.a. (a, #, 0.5)
        (@"\n[-+.0-9]", "numbers stand in parentheses, as in '(0.5)' or '(0, 1, 0)', but for that of a vector", VectorNumber),
        // t. (1, #) or [((1, 0, 0), #)]
        (@"\n\)", $"a map has a position, a rotation and a scale, as in {MapExample}", "a blank or ','"),
        // (0 1 0) as an output
        (@"\([^()]*\n[-+.(0-9\p{L}]", "commas stand between the components of a vector, as in '(0, 1, 0)'", "','"),
        // [(a., b.)^2]
        (@"\.[ \t]*\n[\p{L},]", "maps in parentheses have '*' between them, as in '(a. * b.)'", "')'"),
        // ((1, 0), #, #)
        (@",[^()]*\n\)", "a vector has three components, or one in place of three equal ones", "','"),
        // (1, 0, 0, 1)
        (@"\([^(),#]+,[^(),#]+,[^(),#]+\n,", "a vector has three components", "')'"),
        // a = ((1, 0, 0), #, (0.5))
        ($@"^[ \t]*(?<name>{Name})[ \t]*=[ \t]*\(\(.*\n", $"a map is declared with a dot, as in '${{name}}. ((1, 0, 0), #, (0.5))'", "')'"),
        // ((1, 0, 0), #, #, #)
        (@"\n[,(#]", $"a map has a position, a rotation and a scale, as in {MapExample}", "')'"),
        // [t.^1.5]
        (@"\^-?[0-9]+\n[.eE][0-9]", "the power of a map is a whole number", ""),
        // [t.^0,9], [t.^0:9], [t.^0-9], [t.^0...9] or [t.^(0..9)]
        (
            @"\^(?<from>-?[0-9]+)([ \t]*\n[ \t]*[:.-]+|[ \t]*,[ \t]*\n|\.\.\n\.)[ \t]*(?<to>-?[0-9]+)",
            "a range of powers is written as '^${from}..${to}'", ""),
        (@"\^\((?<from>[^().\n]*)\.*\n\.*(?<to>[^().\n]*)\)", "a range of powers is written as '^(${from})..(${to})'", ""),
        (@"\.\.[ \t]*\n(?<to>[\p{L}_][^],]*)", "a range of powers has expressions in parentheses, as in '..(${to})'", ""),
        // [t. ^2]
        (@"[ \t]\n\^", "no blanks stand within a power, as in 't.^0..9'", TransformationName),
        // <$>. z k, or box ball
        (
            $@"\n(?<name>{Name})[ \t]*\z",
            "objects have a plus sign between them, as in '+ ${name}', and a depth that is computed has parentheses, as in '(${name})'",
            "a depth"),
        // box - ball
        (@"\n-", "nothing is cut out of objects: they are added, as in 'box + ball'", "a depth"),
        // [t.1 2]
        (
            @"(?<call>\w+(\.[0-9]+)+)\.?[ \t]*,?[ \t]*\n(?<digit>[0-9])",
            "the numbers of a call follow its name with dots and without blanks, as in '${call}.${digit}'", TransformationName),
        // [10 * t.]
        (@"\n(?<count>[0-9]+)[ \t]*\*", "copies one behind the other are powers, as in 't.^0..${count}'", TransformationName),
        (@"\*[ \t]*\n[0-9]", "copies one behind the other are powers, as in 't.^0..9'", TransformationName),
        // [1, 2]
        (@"\n[0-9]", "a set holds calls of transformations, as in 't.1', and '#'", TransformationName),
        // 10 * { x 1 } box
        (
            @"\n(?<count>[0-9]+)[ \t]*(\*|[\p{L}_(])", "copies are powers of a map in a set, as in '[((1, 0, 0), #, #)^0..9] box'",
            ObjectName),
        // <$>. 6
        (@"\n(?<digit>[0-9])", "a depth follows the name of a recursive, as in 'z ${digit}'", ObjectName),
        // [t.]^3 box
        (@"\]\n\^", "a set has no power: 'z<box>. [t., u.] box' repeats it, as in 'z 3'", ObjectName),
        // step. { x 1 }
        (@"\n\{", $"braces mean nothing here: a map is written as {MapExample}, and sets of maps as '[t., u.]'", ""),
        // x. cube.obj
        (@"\n[-\w./\\]*\.(?i:obj|gz|ply|stl|fdo)[ \t]*\z", "the name of a file stands in quotes", SyntaxFailure.EndOfLine),
        // <$>. z.6
        (
            @"(?<name>[\p{L}_]\w*)\n\.(?<depth>[0-9]+)[ \t]*\z",
            "a blank stands between a recursive and its depth, as in '${name} ${depth}'", SyntaxFailure.EndOfLine),
        // y. t.1 x
        (@"(?<name>[\p{L}_]\w*)\n\.[0-9]", "calls stand in brackets, as in '[${name}.1] x'", SyntaxFailure.EndOfLine),
        // c. a. * b.
        (
            @"(?<name>[\p{L}_]\w*)\n\.", "calls and products of maps stand in brackets before an object, as in '[${name}.] box'",
            SyntaxFailure.EndOfLine),
        // <$>. z^3
        (
            @"(?<name>[\p{L}_]\w*)\n\^(?<depth>[0-9]+)", "the depth of a recursive has a blank, as in '${name} ${depth}'",
            SyntaxFailure.EndOfLine),
        // c. ((1, 0, 0), #, #) * b.
        (@"\n[*^]", "products and powers of maps stand in the sets that use them, as in '[a. * b.^2] box'", SyntaxFailure.EndOfLine),
        // <$>. z 3.5
        (@"[\p{L}_]\w*[ \t]+[0-9]+\n\.", "a depth is a whole number", SyntaxFailure.EndOfLine),
        // a = 1;
        (@"\n;", "a declaration ends with its line, without a semicolon", ""),
        // a = 1 /* … */
        (@"\n/\*|/\n\*", "a comment begins with '//' and ends with its line", ""),
        // z<box>. [
        (@"[\[(][ \t]*\n\z", "a declaration is one line", ""),
        // a = 2pi
        (@"[0-9]\n(?<name>[\p{L}(])", "products have a sign, as in '2*pi'", ""),
        // a = 90°
        (@"[0-9][ \t]*\n[°%]", "numbers stand without a unit: angles are degrees, and 50 % is 0.5", ""),
        // a = 2**3
        (@"\*\n\*", "a power is written as '2^3'", ""),
        // a = sin 30
        (
            $@"\b(?<name>{string.Join('|', FractalFunctions.Names)})\n[ \t]",
            "the arguments of a function stand in parentheses, as in '${name}(30)'", "'('"),
        // a = 30 in 0..90
        (
            $@"(?<name>{Name})[ \t]*=[ \t]*(?<value>[-0-9.]+)[ \t]*\n[(\[i]",
            "a slider is written as '${name} = ${value} from 0 to 90'", "'from'"),
        // p = 1, 0, 0
        ($@"(?<name>{Name})[ \t]*=[^=(]*\n,", "a vector stands in parentheses, as in '${name} = (1, 0, 0)'", "'from'"),
        // v (0, 1, 0)
        (@"^\s*v\s*\n\(", "the numbers of a vector stand without parentheses, as in 'v 0 1 0'", SyntaxFailure.Number),
        // v1 2 3: any word can be the name of an object, so that parsing fails only behind it.
        (@"^\s*([vV][0-9]*|[vV]ec(tor)?)\s*\n", "a vector is 'v', a blank and three numbers", "'<'"),
        // rule r { … }
        (
            @"^\s*(?<word>rule|shape|startshape|axiom|set|translate|scale|rotate|for|module)\n",
            "there is no '${word}': objects are declared as 'name. …', and recursives as 'name<base>. …'", "'.'"),
        // tree(box). …
        (
            @"^\s*(?<name>\w+)[ \t]*\n[ \t]*\(\w+\)",
            "a recursive has the name of its base in angle brackets, as in '${name}<box>. …'", "'.'"),
        // tree <box>. …
        (@"^\s*(?<name>\w+)\n[ \t]+(?<base><\w+>)", "no blank stands before the base of a recursive, as in '${name}${base}'", "'.'"),
        // tree 5
        (@"^\s*(?<name>\w+)\n[ \t]+(?<depth>[0-9]+)[ \t]*\z", "the result is declared, as in '<$$>. ${name} ${depth}'", "'.'"),
        // my tree. …
        (@"^\s*(?<first>\w+)\n[ \t]+(?<second>\w+)[ \t]*[.<]", "names have no blanks, as in '${first}-${second}'", "'.'"),
        // left-1. …
        (@"^\s*(?<first>\w+)\n-(?<second>[0-9]\w*)", "in names, hyphens stand before letters only", "'.'"),
        // t.a (a, #, #)
        (
            @"^[ \t]*\w+(\.\w+)*\.(?<parameter>\w+)[ \t]*\n\(",
            "a dot is missing behind '${parameter}': each parameter of a transformation ends with one, as in 't.a.'", ""),
        // [t]
        (
            @"\[[^\[\]]*?(?<name><\$>|<\w+>|\w+)\n",
            "a dot is missing behind '${name}': a call has the numbers of its vectors behind dots, as in '${name}.1'", "'.'"),
        // x "cube.obj" or <$> z
        (@"(?<name><\$>|<\w+>|\w+)\n", "a dot is missing behind '${name}'", "'.'"),
    ];

    /// <inheritdoc cref="CommonMistakes.Explain"/>
    public static string? Explain(SyntaxFailure failure) =>
        // v 1 2 3 # the corner
        failure.Explain(
            @"\n#", "a comment in a line begins with '//', since '#' within a declaration is a value", SyntaxFailure.EndOfLine)
        ?? CommonMistakes.ExplainNumbers(failure)
        ?? ExplainComposition(failure)
        ?? Rows.Select(row => failure.Explain(row.Pattern, row.Message, row.Expected is "" ? [] : [row.Expected]))
            .FirstOrDefault(static message => message is not null)
        ?? CommonMistakes.ExplainKeyword(failure);

    private static string? ExplainComposition(SyntaxFailure failure) =>
        failure.Expects("'.'") && failure.Expects("'<'") && NameSuggestion.Find(failure.Before.Trim(), ["composition"]) is { } keyword
            ? $"did you mean '{keyword}'?"
            : null;
}
