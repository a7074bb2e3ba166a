using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>A source of light. Intensities multiply the linear components of the colour; 1 shows a white surface white.</summary>
/// <param name="Colour">As the file writes it, sRGB.</param>
/// <param name="Intensity">Not negative.</param>
public abstract record Light(Colour Colour, double Intensity);

/// <summary>Light from everywhere.</summary>
public sealed record AmbientLight(Colour Colour, double Intensity) : Light(Colour, Intensity);

/// <summary>Parallel light from infinitely far away.</summary>
/// <param name="Direction">The way the light travels, of any length but 0.</param>
/// <param name="Colour">sRGB.</param>
/// <param name="Intensity">Not negative.</param>
public sealed record DirectionalLight(Vector Direction, Colour Colour, double Intensity) : Light(Colour, Intensity);

/// <summary>Light from a point; it falls with the square of the distance and smoothly ends at its range.</summary>
/// <param name="Position">World space.</param>
/// <param name="Colour">sRGB.</param>
/// <param name="Intensity">The light that falls on a surface at a tenth of the range.</param>
/// <param name="Range">Scene units; nothing farther away is lit.</param>
public record PointLight(Vector Position, Colour Colour, double Intensity, double Range) : Light(Colour, Intensity);

/// <summary>A point light that shines into a cone, with a soft edge over the outer tenth of its angle.</summary>
/// <param name="Position">World space.</param>
/// <param name="Direction">The cone's axis, away from the light.</param>
/// <param name="Angle">The cone's full angle in degrees, between 0 and 180.</param>
/// <param name="Colour">sRGB.</param>
/// <param name="Intensity">As for a point light.</param>
/// <param name="Range">As for a point light.</param>
public sealed record SpotLight(Vector Position, Vector Direction, double Angle, Colour Colour, double Intensity, double Range)
    : PointLight(Position, Colour, Intensity, Range);
