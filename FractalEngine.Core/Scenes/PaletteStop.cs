using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Scenes;

/// <summary>One of the colours between which a palette blends.</summary>
/// <param name="Position">Where the palette has the colour, from 0 to 1.</param>
/// <param name="Colour">The colour, sRGB.</param>
public readonly record struct PaletteStop(double Position, Colour Colour);
