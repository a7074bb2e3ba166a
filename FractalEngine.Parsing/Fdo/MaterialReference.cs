namespace FractalEngine.Parsing.Fdo;

/// <summary>The material that a fractal file gives to a mesh or shape.</summary>
/// <param name="File">Name of the material file, relative to the fractal file.</param>
/// <param name="Name">Name of the material within it; null for the only one.</param>
/// <param name="Offset">Offset of the file's name in the text, in characters, for messages.</param>
public sealed record MaterialReference(string File, string? Name, int Offset);
