using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>A thing in a scene: a file and where its contents stand (paper §4.1.5).</summary>
/// <param name="File">As the scene names it: relative to the scene's file.</param>
/// <param name="Placement">The paper's global matrix m.</param>
public record SceneObject(string File, Transformation Placement)
{
    /// <summary>A name to tell objects of the same file apart; null for none.</summary>
    public string? Name { get; init; }

    /// <summary>The object's colour; null for the default.</summary>
    public Colour? Colour { get; init; }

    /// <summary>How the instances of a fractal differ in colour; null for not at all.</summary>
    public Gradient? Gradient { get; init; }
}
