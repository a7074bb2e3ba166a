using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>Parallel light from infinitely far away, such as sunlight.</summary>
/// <param name="Direction">The direction in which the light travels, world space, of any length but 0.</param>
/// <param name="Colour">sRGB.</param>
/// <param name="Intensity">Not negative.</param>
public sealed record DirectionalLight(Vector Direction, Colour Colour, double Intensity) : Light(Colour, Intensity);
