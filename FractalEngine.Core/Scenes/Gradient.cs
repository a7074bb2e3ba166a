using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Scenes;

/// <summary>How the instances of a fractal differ in colour: from the object's own colour to another one.</summary>
/// <param name="Kind">What decides.</param>
/// <param name="EndColour">The other colour.</param>
public sealed record Gradient(GradientKind Kind, Colour EndColour);
