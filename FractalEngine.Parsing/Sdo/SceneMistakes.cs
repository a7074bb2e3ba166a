using FractalEngine.Core.Generation;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Sdo;

/// <summary>Mistakes that are made in scene files. Of several rows the first one that fits explains a failure.</summary>
internal static class SceneMistakes
{
    // An object to the end of its file's name, and what follows before any option.
    private const string FileOfObject = """^[ \t]*[op][ \t]+"[^"]*"[ \t,]*""";
    private const string Values = """[^"a-z]*""";

    private const string PlacementForm = "a placement is '#' or three vectors in parentheses, (position, rotation, scale)";

    /// <inheritdoc cref="CommonMistakes.Explain"/>
    public static string? Explain(SyntaxFailure failure) =>
        CommonMistakes.ExplainNumbers(failure)
        // o "cube.obj"
        ?? failure.Explain($@"{FileOfObject}\n", PlacementForm, "'('")
        // o "cube.obj" (0, 1, 0)
        ?? failure.Explain($@"{FileOfObject}{Values}\n[-+]?\.?[0-9]", PlacementForm, "'('")
        // o "cube.obj" (#, #)
        ?? (failure.Expects(SyntaxFailure.Number) ? null : failure.Explain($@"{FileOfObject}{Values}\n\)", PlacementForm))
        // o ball #
        ?? failure.Explain(
            $@"\n(?<shape>{string.Join('|', BaseShapes.Names)})\b",
            "a scene takes a shape from a fractal file, such as one with the line '<$$>. ${shape}'", "a file name in quotes")
        // light point (0, 1, 0) (1, 1, 1)
        ?? ExplainLight(failure, "point", "position, colour, intensity and range")
        ?? ExplainLight(failure, "spot", "position, direction, angle, colour, intensity and range")
        ?? ExplainLight(failure, "ball", "position, radius, colour, intensity and range")
        ?? ExplainLight(failure, "quad", "position, direction, width, height, colour, intensity and range")
        // c (0, 0, -5) #, of whole vectors only: within one, the failure is that of the vector.
        ?? failure.Explain(
            @"^[ \t]*c([ \t,]*(#|look-at|up|\([^()]*\)))+[ \t,]*\n", "a camera ends with its vertical angle of view in degrees",
            SyntaxFailure.Number)
        // p "a.obj" #
        ?? failure.Explain(
            """^[ \t]*p[ \t]+"[^"]*"[ \t,]*(#|\(([^()]|\([^()]*\))*\))[ \t,]*\n""",
            "the placement of a physics object is followed by its restitution, from 0 to 1", SyntaxFailure.Number)
        // camera (0, 0, -5) # 60
        ?? failure.Explain(@"\n(?i:camera)", "a camera is declared by 'c'", "'gravity'")
        ?? failure.Explain(@"\n(?i:object|model|mesh)", "an object is declared by 'o'", "'gravity'")
        ?? failure.Explain(@"\n(?i:physics|body)", "a physics object is declared by 'p'", "'gravity'")
        ?? CommonMistakes.ExplainKeyword(failure);

    private static string? ExplainLight(SyntaxFailure failure, string kind, string parts) => failure.Explain(
        $@"^[ \t]*light[ \t]+{kind}\b([^()]*\([^()]*\))*[^()]*\n\z", $"a {kind} light is its {parts}");
}
