using System.Text.RegularExpressions;
using FractalEngine.Parsing.Text.Mistakes;

namespace FractalEngine.Parsing.Scenes.Mistakes;

/// <summary>
/// A missing number at the end of a declaration: <c>c (0, 0, -5) #</c>, <c>p "a.obj" #</c>, <c>light point (0, 1, 0) (1, 1, 1)</c>.
/// </summary>
internal sealed partial class MissingValue : TypicalMistake
{
    /// <inheritdoc/>
    public override string? Explain(SyntaxFailure failure)
    {
        if (Light().Match(failure.Before) is { Success: true } light && failure.IsAtEndOfLine)
        {
            var angle = light.Groups["kind"].Value == "spot" ? "direction, angle, " : "";
            return $"a {light.Groups["kind"].Value} light is its position, {angle}colour, intensity and range";
        }

        if (!failure.Expects(SyntaxFailure.Number))
        {
            return null;
        }

        return Camera().IsMatch(failure.Before) ? "a camera ends with its vertical angle of view in degrees"
            : PhysicsObject().IsMatch(failure.Before) ? "the placement of a physics object is followed by its restitution, from 0 to 1"
            : null;
    }

    // Whole vectors only: within one, the failure is that of the vector.
    [GeneratedRegex(@"^[ \t]*c([ \t,]*(#|look-at|up|\([^()]*\)))+[ \t,]*$")]
    private static partial Regex Camera();

    [GeneratedRegex("""^[ \t]*p[ \t]+"[^"]*"[ \t,]*(#|\(([^()]|\([^()]*\))*\))[ \t,]*$""")]
    private static partial Regex PhysicsObject();

    [GeneratedRegex(@"^[ \t]*light[ \t]+(?<kind>point|spot)\b([^()]*\([^()]*\))*[^()]*$")]
    private static partial Regex Light();
}
