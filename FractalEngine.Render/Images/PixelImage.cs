namespace FractalEngine.Render.Images;

/// <summary>A picture as plain data: sRGB, 8 bits a component.</summary>
/// <param name="Width">Pixels.</param>
/// <param name="Height">Pixels.</param>
/// <param name="Pixels">Red, green, blue, alpha; the top row first; [height × width × 4].</param>
public sealed record PixelImage(int Width, int Height, byte[] Pixels)
{
    /// <summary>One pixel.</summary>
    /// <param name="x">From the left, from 0.</param>
    /// <param name="y">From the top, from 0.</param>
    public (byte Red, byte Green, byte Blue, byte Alpha) this[int x, int y] => (4 * ((y * Width) + x)) switch
    {
        var start => (Pixels[start], Pixels[start + 1], Pixels[start + 2], Pixels[start + 3]),
    };

    /// <summary>From rows in GL's order, the bottom one first.</summary>
    internal static PixelImage FromBottomUp(int width, int height, byte[] rows)
    {
        var (pixels, stride) = (new byte[rows.Length], 4 * width);
        for (var y = 0; y < height; y++)
        {
            rows.AsSpan((height - 1 - y) * stride, stride).CopyTo(pixels.AsSpan(y * stride));
        }

        return new(width, height, pixels);
    }
}
