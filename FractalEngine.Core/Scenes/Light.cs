using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Scenes;

/// <summary>A source of light. Intensities multiply the linear components of the colour; 1 shows a white surface white.</summary>
/// <param name="Colour">Colour of the light as the scene file writes it, in sRGB components.</param>
/// <param name="Intensity">Factor of the colour's linear components, not negative.</param>
public abstract record Light(Colour Colour, double Intensity);
