using FractalEngine.Core.Generation;

namespace FractalEngine.Parsing.Fdo;

/// <summary>The name of what a fractal is made of: a mesh, another fractal, or a shape.</summary>
/// <param name="File">Name of the file, relative to the fractal file, or one of the <see cref="BaseShapes"/>.</param>
/// <param name="Offset">Offset of the name in the text, in characters, for messages about the file.</param>
public readonly record struct BaseReference(string File, int Offset)
{
    /// <summary>The material that all faces have; null for those of the file.</summary>
    public MaterialReference? Material { get; init; }
}
