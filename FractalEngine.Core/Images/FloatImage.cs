using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Images;

/// <summary>An image of linear light as plain data, 32-bit floats without a greatest value.</summary>
/// <param name="Width">Width of the image in pixels.</param>
/// <param name="Height">Height of the image in pixels.</param>
/// <param name="Pixels">Components of all pixels: red, green, blue; the top row first; [height × width × 3].</param>
public sealed record FloatImage(int Width, int Height, float[] Pixels)
{
    /// <summary>The light of one pixel: red, green, blue.</summary>
    /// <param name="x">From the left, from 0.</param>
    /// <param name="y">From the top, from 0.</param>
    public Vector this[int x, int y]
    {
        get => new(Pixels[3 * ((y * Width) + x)], Pixels[(3 * ((y * Width) + x)) + 1], Pixels[(3 * ((y * Width) + x)) + 2]);

        set
        {
            var target = Pixels.AsSpan(3 * ((y * Width) + x), 3);
            (target[0], target[1], target[2]) = ((float)value.X, (float)value.Y, (float)value.Z);
        }
    }
}
