using System.Collections.Immutable;

namespace FractalEngine.Parsing.Editing;

/// <summary>A small fractal to begin with, whose numbers are then turned: files of the folder Templates.</summary>
/// <param name="Name">Name of the file that is proposed, without its ending.</param>
/// <param name="Help">What it is, for the user.</param>
public sealed record FractalTemplate(string Name, string Help)
{
    /// <summary>All templates, in the order of the question.</summary>
    public static readonly ImmutableArray<FractalTemplate> All =
    [
        new("tree", "a tree: a trunk with branches"),
        new("triangle", "a Sierpinski triangle: three halves of itself"),
        new("cubes", "cubes on the sides of cubes"),
    ];

    /// <summary>Reads the text of the fractal, which needs no other file.</summary>
    public string ReadText()
    {
        using var reader = new StreamReader(typeof(FractalTemplate).Assembly.GetManifestResourceStream($"Templates/{Name}.fdo")!);
        return reader.ReadToEnd();
    }
}
