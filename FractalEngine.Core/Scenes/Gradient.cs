using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Scenes;

/// <summary>How the instances of a fractal differ in colour: from the object's own colour to another one.</summary>
/// <param name="Kind">What the colour depends on.</param>
/// <param name="EndColour">The colour at the far end of the gradient.</param>
public sealed record Gradient(GradientKind Kind, Colour EndColour);
