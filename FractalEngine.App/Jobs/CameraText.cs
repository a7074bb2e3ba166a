using FractalEngine.App.Shell;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Films;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Cameras;

namespace FractalEngine.App.Jobs;

/// <summary>Parses cameras and vectors of the command line by the grammar of scene files, so that both never differ.</summary>
internal static class CameraText
{
    private const string CameraForms = "(x, y, z) (pitch, yaw, roll) fov or (x, y, z) look-at (x, y, z) fov";

    /// <summary>Parses what follows <c>c</c> in a scene: <c>(x, y, z) (pitch, yaw, roll) fov</c>, or with <c>look-at</c>.</summary>
    /// <exception cref="UsageException">The text is no camera.</exception>
    public static Camera ParseCamera(string option, string text, Handedness handedness) =>
        ParseOption(option, "c ", text, CameraForms, handedness).Camera!;

    /// <summary>
    /// Reads a list: a camera a line, as <c>--camera</c> takes it. A leading <c>c</c> is allowed, and <c>#</c> starts a comment.
    /// </summary>
    /// <exception cref="SourceException">The file can't be read, or a line is no camera, or one beyond the limit.</exception>
    /// <exception cref="UsageException">There are fewer than two cameras.</exception>
    public static CameraPath ReadPath(string path, Handedness handedness)
    {
        var source = StandardInput.ReadOrFile(path, ParsingLimits.DescriptionBytes.Value);
        Camera[] cameras =
        [
            .. source.Text.ReplaceLineEndings("\n").Split('\n')
                .Select(static (line, index) => (Text: line.TrimEnd(), Number: index + 1))
                .Where(static line => line.Text.Length > 0 && !line.Text.TrimStart().StartsWith('#'))
                .Select(line => ParseCameraLine(path, line.Number, line.Text, handedness)),
        ];
        return cameras.Length >= 2 ? new(cameras, handedness) : throw new UsageException($"{path} has fewer than two cameras");
    }

    internal static Camera ParseCameraLine(string file, int line, string text, Handedness handedness)
    {
        var start = text.Length - text.TrimStart().Length;
        start += text.AsSpan(start).StartsWith("c ") ? 2 : 0;
        var (scene, warnings) = Parse(
            "c ", text[start..], handedness,
            diagnostic => diagnostic with { File = file, Line = line, Column = start + diagnostic.Column, SourceLine = text });
        foreach (var warning in warnings)
        {
            Console.Error.WriteLine(warning);
        }

        return scene.Camera!.Position.MaxAbsComponent() <= CameraKey.MaxCoordinate ? scene.Camera : throw new SourceException(
            new(file, line, 1, DiagnosticSeverity.Error, "the camera of a path is beyond the limit of 1e150") { IsLimitExceeded = true });
    }

    /// <summary>Formats the camera of a scene as its line <c>c</c>, which reads back to the same bits.</summary>
    public static string Format(Camera camera) => SceneWriter.Write(new Scene { Camera = camera }).TrimEnd('\n');

    /// <summary>Parses a vector: <c>(x, y, z)</c>.</summary>
    /// <exception cref="UsageException">The text is no vector.</exception>
    public static Vector ParseVector(string option, string text) =>
        ParseOption(option, "gravity ", text, "(x, y, z)", Handedness.Left).Gravity;

    /// <summary>Parses a colour: <c>(r, g, b)</c>, each from 0 to 1.</summary>
    /// <exception cref="UsageException">The text is no colour.</exception>
    public static Core.Geometry.Colour ParseColour(string option, string text) =>
        ParseOption(option, "background ", text, "(r, g, b) from 0 to 1, or transparent", Handedness.Left).Background!.Value;

    private static Scene ParseOption(string option, string keyword, string text, string expected, Handedness handedness)
    {
        var line = text.ReplaceLineEndings(" ");
        try
        {
            var (scene, warnings) = Parse(keyword, line, handedness, diagnostic => diagnostic with { SourceLine = line });
            foreach (var warning in warnings)
            {
                Console.Error.WriteLine($"warning: {option}: {warning.Message}\n{Excerpt(warning)}");
            }

            return scene;
        }
        catch (SourceException exception)
        {
            var diagnostic = exception.Diagnostic;
            throw new UsageException($"{option}: {diagnostic.Message}; expected {expected}", Excerpt(diagnostic));
        }
    }

    /// <summary>Returns the source line of a diagnostic with the caret below.</summary>
    private static string? Excerpt(Diagnostic diagnostic) => diagnostic.ToString().Split('\n', 2).ElementAtOrDefault(1);

    /// <summary>Parses the rest of a declaration.</summary>
    /// <param name="keyword">The beginning of the declaration.</param>
    /// <param name="text">The rest, one line.</param>
    /// <param name="handedness">That of the scene.</param>
    /// <param name="locate">Completes a diagnostic, whose column is that in the text.</param>
    /// <exception cref="SourceException">The text is faulty.</exception>
    private static (Scene Scene, Diagnostic[] Warnings) Parse(
        string keyword, string text, Handedness handedness, Func<Diagnostic, Diagnostic> locate)
    {
        try
        {
            var handed = handedness == Handedness.Right ? "handed right" : "handed left";
            var parsed = SceneParser.Parse(new("", $"{keyword}{text}\n{handed}\n"));
            return (parsed.Scene, [.. parsed.Warnings.Select(Complete)]);
        }
        catch (SourceException exception)
        {
            throw new SourceException(Complete(exception.Diagnostic));
        }

        Diagnostic Complete(Diagnostic diagnostic) =>
            locate(diagnostic with { Column = Math.Max(1, diagnostic.Column - keyword.Length) });
    }
}
