using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Render;

/// <summary>A line over a picture, in front of everything.</summary>
/// <param name="From">World space.</param>
/// <param name="To">World space.</param>
/// <param name="Colour">sRGB.</param>
public readonly record struct LineSegment(Vector From, Vector To, Colour Colour);
