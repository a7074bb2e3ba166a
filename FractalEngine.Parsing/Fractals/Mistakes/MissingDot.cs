using System.Text.RegularExpressions;
using FractalEngine.Parsing.Text.Mistakes;

namespace FractalEngine.Parsing.Fractals.Mistakes;

/// <summary>A missing dot behind a name: <c>x "cube.obj"</c>, <c>t.a (a, #, #)</c>, <c>[t]</c> or <c>&lt;$&gt; z</c>.</summary>
internal sealed partial class MissingDot : TypicalMistake
{
    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure)
    {
        if (failure.Position.Current == '(' && UnfinishedParameter().Match(failure.Before) is { Success: true } unfinished)
        {
            var parameter = unfinished.Groups[1].Value;
            return $"a dot is missing behind '{parameter}': each parameter of a transformation ends with one, as in 't.a.'";
        }

        var name = TrailingName().Match(failure.Before).Value;
        if (!failure.Expects("'.'") || name.Length == 0)
        {
            return null;
        }

        var isInSet = failure.Before.LastIndexOfAny(['[', ']']) is >= 0 and var bracket && failure.Before[bracket] == '[';
        return isInSet
            ? $"a dot is missing behind '{name}': a call has the numbers of its vectors behind dots, as in '{name}.1'"
            : $"a dot is missing behind '{name}'";
    }

    [GeneratedRegex(@"^[ \t]*\w+(?:\.\w+)*\.(\w+)[ \t]*$")]
    private static partial Regex UnfinishedParameter();

    [GeneratedRegex(@"(<\$>|<\w+>|\w+)$")]
    private static partial Regex TrailingName();
}
