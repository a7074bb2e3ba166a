using System.Text.RegularExpressions;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Mistakes;

namespace FractalEngine.Parsing.Scenes.Mistakes;

/// <summary>An object without a placement, or with a position in place of one: <c>o "cube.obj" (0, 1, 0)</c>.</summary>
internal sealed partial class IncompletePlacement : TypicalMistake
{
    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure)
    {
        if (Placement().Match(failure.Before) is not { Success: true } line)
        {
            return null;
        }

        var isMissing = line.Groups["values"].Value.Length == 0 && failure.Expects("'('");
        var isTooShort = failure.Position.Current == ')' && !failure.Expects(SyntaxFailure.Number);
        var isPosition = NumberReader.TryRead(failure.After, out _, out _) && failure.Expects("'('");
        return isMissing || isTooShort || isPosition
            ? "a placement is '#' or three vectors in parentheses, (position, rotation, scale)"
            : null;
    }

    // From the name of the file to the failure, before any option.
    [GeneratedRegex("""^[ \t]*[op][ \t]+"[^"]*"[ \t,]*(?<values>[^"a-z]*)$""")]
    private static partial Regex Placement();
}
