using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Lights;

/// <summary>Converts colours to light.</summary>
internal static class ColourExtensions
{
    /// <summary>Converts a colour to linear light: red, green, blue.</summary>
    public static Vector ToLinearVector(this Colour colour)
    {
        var (red, green, blue) = colour.ToLinear();
        return new(red, green, blue);
    }
}
