using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Views;

/// <summary>A line that is drawn over a frame, in front of all surfaces.</summary>
/// <param name="From">Start of the line, frame of the view.</param>
/// <param name="To">End of the line, frame of the view.</param>
/// <param name="Colour">Colour of the line, sRGB.</param>
public readonly record struct LineSegment(Vector From, Vector To, Colour Colour);
