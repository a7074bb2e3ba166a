using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App;

/// <summary>Parses cameras and vectors of the command line by the grammar of scene files, so that both never differ.</summary>
internal static class CameraText
{
    /// <summary>Parses what follows <c>c</c> in a scene: <c>(x, y, z) (pitch, yaw, roll) fov</c>, or with <c>look-at</c>.</summary>
    /// <param name="name">Name of the text in messages, such as that of the option.</param>
    /// <param name="text">The camera.</param>
    /// <param name="handedness">That of the scene.</param>
    /// <exception cref="UsageException">The text is no camera.</exception>
    public static Camera ParseCamera(string name, string text, Handedness handedness)
    {
        var handed = handedness == Handedness.Right ? "handed right\n" : "";
        return Parse(name, $"{handed}c {text}", "(x, y, z) (pitch, yaw, roll) fov or (x, y, z) look-at (x, y, z) fov").Camera!;
    }

    /// <summary>Formats the camera of a scene as its line <c>c</c>, which reads back to the same bits.</summary>
    public static string Format(Camera camera) => SceneWriter.Write(new Scene { Camera = camera }).TrimEnd('\n');

    /// <summary>Parses a vector: <c>(x, y, z)</c>.</summary>
    /// <exception cref="UsageException">The text is no vector.</exception>
    public static Vector ParseVector(string name, string text) => Parse(name, $"gravity {text}", "(x, y, z)").Gravity;

    /// <summary>Parses a colour: <c>(r, g, b)</c>, each from 0 to 1.</summary>
    /// <exception cref="UsageException">The text is no colour.</exception>
    public static Core.Geometry.Colour ParseColour(string name, string text) =>
        Parse(name, $"background {text}", "(r, g, b) from 0 to 1, or transparent").Background!.Value;

    private static Scene Parse(string name, string declaration, string expected)
    {
        try
        {
            var parsed = SceneParser.Parse(new(name, declaration));
            foreach (var warning in parsed.Warnings)
            {
                Console.Error.WriteLine($"warning: {name}: {warning.Message}");
            }

            return parsed.Scene;
        }
        catch (SourceException exception)
        {
            throw new UsageException($"{name}: {exception.Diagnostic.Message}; expected {expected}");
        }
    }
}
