using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>Even haze between the eye and surfaces.</summary>
/// <param name="Density">
/// Share of light that is lost in a unit of distance, where that is small: after d units, e^(−density·d) of it are left.
/// </param>
/// <param name="Colour">Colour of what replaces it, sRGB; null for the sky's horizon, or the background without a sky.</param>
public sealed record Fog(double Density, Colour? Colour = null);
