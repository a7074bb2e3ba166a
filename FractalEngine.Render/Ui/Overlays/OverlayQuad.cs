using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Render.Ui.Overlays;

/// <summary>
/// A rectangle of the overlay: a glyph, or a plain one with round corners. Its layout is that of the attributes in overlay.vert.
/// </summary>
/// <param name="X">Left edge, pixels from the left of the frame.</param>
/// <param name="Y">Top edge, pixels from the top of the frame.</param>
/// <param name="Width">Width in pixels.</param>
/// <param name="Height">Height in pixels.</param>
/// <param name="Colour">Colour in sRGB, and opacity.</param>
/// <param name="Glyph">Index of the glyph; −1 for a plain rectangle.</param>
/// <param name="CornerRadius">Radius of a plain rectangle's corners, pixels.</param>
[StructLayout(LayoutKind.Sequential)]
internal readonly record struct OverlayQuad(
    float X, float Y, float Width, float Height, (float Red, float Green, float Blue, float Alpha) Colour, float Glyph, float CornerRadius)
{
    /// <summary>Number of floats of one quad.</summary>
    public const int FloatsPerQuad = 10;

    /// <summary>Returns an opaque colour as a rectangle has it.</summary>
    public static (float Red, float Green, float Blue, float Alpha) Tint(Colour colour) =>
        ((float)colour.Red, (float)colour.Green, (float)colour.Blue, 1);
}
