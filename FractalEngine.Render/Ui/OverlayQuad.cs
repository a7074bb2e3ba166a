using System.Runtime.InteropServices;

namespace FractalEngine.Render.Ui;

/// <summary>
/// A rectangle of the overlay: a glyph, or a plain one with round corners. The layout is that of overlay.vert's attributes.
/// </summary>
/// <param name="X">Pixels from the left.</param>
/// <param name="Y">Pixels from the top.</param>
/// <param name="Width">Pixels.</param>
/// <param name="Height">Pixels.</param>
/// <param name="Colour">sRGB and opacity.</param>
/// <param name="Glyph">The glyph's number, or −1 for a plain rectangle.</param>
/// <param name="CornerRadius">Of the corners of a plain rectangle, pixels.</param>
[StructLayout(LayoutKind.Sequential)]
internal readonly record struct OverlayQuad(
    float X, float Y, float Width, float Height, (float Red, float Green, float Blue, float Alpha) Colour, float Glyph, float CornerRadius)
{
    /// <summary>Floats of one quad.</summary>
    public const int FloatsPerQuad = 10;
}
