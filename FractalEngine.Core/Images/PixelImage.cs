namespace FractalEngine.Core.Images;

/// <summary>An image as plain data: sRGB, 8 bits a component.</summary>
/// <param name="Width">Width of the image in pixels.</param>
/// <param name="Height">Height of the image in pixels.</param>
/// <param name="Pixels">Components of all pixels: red, green, blue, alpha; the top row first; [height × width × 4].</param>
public sealed record PixelImage(int Width, int Height, byte[] Pixels)
{
    /// <summary>The components of one pixel.</summary>
    /// <param name="x">From the left, from 0.</param>
    /// <param name="y">From the top, from 0.</param>
    public (byte Red, byte Green, byte Blue, byte Alpha) this[int x, int y]
    {
        get
        {
            var start = 4 * ((y * Width) + x);
            return (Pixels[start], Pixels[start + 1], Pixels[start + 2], Pixels[start + 3]);
        }
    }

    /// <summary>Makes an image of rows in OpenGL's order.</summary>
    /// <param name="width">Width of the image in pixels.</param>
    /// <param name="height">Height of the image in pixels.</param>
    /// <param name="rows">As <see cref="Pixels"/>, but the bottom row first; copied.</param>
    public static PixelImage FromBottomUp(int width, int height, byte[] rows)
    {
        ArgumentNullException.ThrowIfNull(rows);
        var pixels = new byte[rows.Length];
        var stride = 4 * width;
        for (var y = 0; y < height; y++)
        {
            rows.AsSpan((height - 1 - y) * stride, stride).CopyTo(pixels.AsSpan(y * stride));
        }

        return new(width, height, pixels);
    }
}
