using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Scenes;

/// <summary>A source of light. Intensities multiply the linear components of the colour; 1 shows a white surface white.</summary>
/// <param name="Colour">As the file writes it, sRGB.</param>
/// <param name="Intensity">Not negative.</param>
public abstract record Light(Colour Colour, double Intensity);
